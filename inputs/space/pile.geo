// Ground around a flat pile of round section that stands in it, its hole filled by it: a half, y >= 0, turned from the section x >= 0 (`angle`
// of 180 degrees; 90 for a quarter). The contour is that of the body 'flat pile', whose base is at z = -start.
SetFactory("OpenCASCADE");
DefineConstant[ diameter = {0.4, Name "diameter"}, corner = {0.08, Name "corner"} ];   // [m]
DefineConstant[ start = {0.8, Name "start"} ];         // depth of the base [m]
DefineConstant[ fine = {0.055, Name "fine"} ];         // cells at the base
DefineConstant[ wall = {0.12, Name "wall"} ];          // at the mudline
DefineConstant[ coarse = {0.6, Name "coarse"} ];       // at the far boundary
DefineConstant[ width = {2.0, Name "width"}, depth = {2.6, Name "depth"} ];
DefineConstant[ angle = {180, Name "angle"} ];
radius = 0.5 * diameter;

Point(1) = {0, 0, -start};
Point(2) = {radius - corner, 0, -start};
Point(3) = {radius - corner, 0, -start + corner};
Point(4) = {radius, 0, -start + corner};
Point(5) = {radius, 0, 0};
Point(6) = {width, 0, 0};
Point(7) = {width, 0, -depth};
Point(8) = {0, 0, -depth};
Line(1) = {1, 2};
Circle(2) = {2, 3, 4};
Line(3) = {4, 5};
Line(4) = {5, 6};
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {8, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Plane Surface(1) = {1};
Extrude {{0, 0, 1}, {0, 0, 0}, angle * Pi / 180} { Surface{1}; }

// from the base outwards, and along the wall upwards
Field[1] = MathEval;
Field[1].F = Sprintf("%g + 0.3*Max(0, Sqrt((Max(0, Sqrt(x^2 + y^2) - %g))^2 + (Max(0, Abs(z + %g) - %g))^2))", fine, radius, start, corner);
Field[2] = MathEval;
Field[2].F = Sprintf("%g + 0.35*Abs(Sqrt(x^2 + y^2) - %g) + 2*Max(0, -z - %g)", wall, radius, start);
Field[3] = Min;
Field[3].FieldsList = {1, 2};
Field[4] = MathEval;
Field[4].F = Sprintf("%g", coarse);
Field[5] = Min;
Field[5].FieldsList = {3, 4};
Background Field = 5;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Optimize = 1;

e = 1e-3;
Physical Volume("clay") = {1};
rest[] = Surface In BoundingBox {-width - e, -width - e, -depth - e, width + e, width + e, e};
symmetry[] = Surface In BoundingBox {-width - e, -e, -depth - e, width + e, e, e};
rest[] -= symmetry[];
If (angle < 180)
  across[] = Surface In BoundingBox {-e, -e, -depth - e, e, width + e, e};
  rest[] -= across[];
  Physical Surface("x = 0") = across[];
EndIf
pile[] = Surface In BoundingBox {-radius - e, -e, -start - e, radius + e, radius + e, e};
rest[] -= pile[];
seabed[] = Surface In BoundingBox {-width - e, -e, -e, width + e, width + e, e};
rest[] -= seabed[];
Physical Surface("symmetry") = symmetry[];
Physical Surface("pile") = pile[];
Physical Surface("seabed") = seabed[];
Physical Surface("far side") = rest[];
