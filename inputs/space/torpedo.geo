// Clay around a torpedo anchor that stands in its hole, a half of it, y >= 0: a round hull with a blunt cone as its tip and, with "fins" = 1, three fins (the
// two in the plane y = 0 are halves) with sharp edges. The hull's axis is that of z, its top at z = 0.
SetFactory("OpenCASCADE");
DefineConstant[ fins = {1, Name "fins"}, fine = {0.26, Name "fine"}, ends = {0.14, Name "ends"}, coarse = {2.0, Name "coarse"} ];
radius = 0.4; length = 6; tip = 0.8; blunt = 0.15; // of the hull; height and lower radius of its cone
span = 0.5; height = 2.4; thick = 0.12;      // of a fin, beyond the hull, and of its top below that of the hull
top = 0.3;
width = 5; above = 3; below = 4;             // of the clay

Cylinder(1) = {0, 0, -length - below, 0, 0, length + below + above, width, Pi};
Cylinder(2) = {0, 0, -length + tip, 0, 0, length - tip, radius};
Cone(3) = {0, 0, -length, 0, 0, tip, blunt, radius};
tools[] = {2, 3};
If (fins > 0)
  Box(4) = {-radius - span, -thick/2, -top - height, 2*(radius + span), thick, height};
  Box(5) = {-thick/2, 0, -top - height, thick, radius + span, height};
  tools[] += {4, 5};
EndIf
BooleanDifference(10) = { Volume{1}; Delete; }{ Volume{tools[]}; Delete; };

Field[1] = Box;
Field[1].VIn = fine;
Field[1].VOut = coarse;
Field[1].XMin = -radius; Field[1].XMax = radius; Field[1].YMin = 0; Field[1].YMax = radius; Field[1].ZMin = -length; Field[1].ZMax = 0;
Field[1].Thickness = 3.5;
// both ends bear
Field[2] = MathEval;
Field[2].F = Sprintf("%g + 0.35*Max(0, Sqrt(x^2 + y^2 + (z + %g)^2) - 0.5)", ends, length);
Field[4] = MathEval;
Field[4].F = Sprintf("%g + 0.35*Max(0, Sqrt(x^2 + y^2 + z^2) - 0.5)", ends);
Field[3] = Min;
Field[3].FieldsList = {1, 2, 4};
Background Field = 3;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Optimize = 1;

e = 1e-3;
Physical Volume("clay") = {10};
all[] = Surface In BoundingBox {-width - e, -e, -length - below - e, width + e, width + e, above + e};
symmetry[] = Surface In BoundingBox {-width - e, -e, -length - below - e, width + e, e, above + e};
hull[] = Surface In BoundingBox {-radius - span - e, -e, -length - e, radius + span + e, radius + span + e, e};
hull[] -= symmetry[];
all[] -= symmetry[];
all[] -= hull[];
Physical Surface("symmetry") = symmetry[];
Physical Surface("hull") = hull[];
Physical Surface("far side") = all[];
