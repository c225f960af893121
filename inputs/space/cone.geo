// Ground around a cone penetrometer that stands in it, its hole filled by it: a half, y >= 0, turned from the section x >= 0 (`angle` of 180
// degrees; 90 for a quarter). The contour is that of the body 'cone' (60 degrees, tip and shoulder rounded), its lowest point at z = -start.
SetFactory("OpenCASCADE");
DefineConstant[ diameter = {0.0357, Name "diameter"} ];  // [m]
DefineConstant[ tip_radius = {0.006, Name "tip_radius"}, shoulder_radius = {0.008, Name "shoulder_radius"} ];
DefineConstant[ start = {0.0714, Name "start"} ];        // depth of the tip [m]
DefineConstant[ tip = {0.0025, Name "tip"} ];            // cells at the tip
DefineConstant[ fine = {0.004, Name "fine"} ];           // at the cone
DefineConstant[ wall = {0.01, Name "wall"} ];            // at the mudline
DefineConstant[ coarse = {0.055, Name "coarse"} ];       // at the far boundary
DefineConstant[ width = {0.18, Name "width"}, depth = {0.26, Name "depth"} ];
DefineConstant[ angle = {180, Name "angle"} ];
radius = 0.5 * diameter;
half = Pi / 6;
apex = -start - tip_radius * (1 / Sin(half) - 1);        // of the sharp cone
corner = apex + radius / Tan(half);
cut = shoulder_radius * Tan(0.5 * half);                 // of the flank, for the shoulder's fillet

Point(1) = {0, 0, -start};
Point(2) = {0, 0, -start + tip_radius};
Point(3) = {tip_radius * Cos(half), 0, -start + tip_radius * (1 - Sin(half))};
Point(4) = {radius - cut * Sin(half), 0, corner - cut * Cos(half)};
Point(5) = {radius - shoulder_radius, 0, corner + cut};
Point(6) = {radius, 0, corner + cut};
Point(7) = {radius, 0, 0};
Point(8) = {width, 0, 0};
Point(9) = {width, 0, -depth};
Point(10) = {0, 0, -depth};
Circle(1) = {1, 2, 3};
Line(2) = {3, 4};
Circle(3) = {4, 5, 6};
Line(4) = {6, 7};
Line(5) = {7, 8};
Line(6) = {8, 9};
Line(7) = {9, 10};
Line(8) = {10, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8};
Plane Surface(1) = {1};
Extrude {{0, 0, 1}, {0, 0, 0}, angle * Pi / 180} { Surface{1}; }

// from the cone outwards, and along the wall upwards
high = 0.5 * (corner + start);
Field[1] = MathEval;
Field[1].F = Sprintf("%g + 0.3*Max(0, Sqrt((Max(0, Sqrt(x^2 + y^2) - %g))^2 + (Max(0, Abs(z + %g) - %g))^2))", fine, radius, start - high, high);
Field[2] = MathEval;
Field[2].F = Sprintf("%g + 0.35*Abs(Sqrt(x^2 + y^2) - %g) + 2*Max(0, -z - %g)", wall, radius, start);
Field[3] = MathEval;
Field[3].F = Sprintf("%g", coarse);
Field[4] = MathEval;
Field[4].F = Sprintf("%g + 0.3*Max(0, Sqrt(x^2 + y^2 + (z + %g)^2) - %g)", tip, start - tip_radius, tip_radius);
Field[5] = Min;
Field[5].FieldsList = {1, 2, 3, 4};
Background Field = 5;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Optimize = 1;

e = 1e-5;
Physical Volume("clay") = {1};
rest[] = Surface In BoundingBox {-width - e, -width - e, -depth - e, width + e, width + e, e};
symmetry[] = Surface In BoundingBox {-width - e, -e, -depth - e, width + e, e, e};
rest[] -= symmetry[];
If (angle < 180)
  across[] = Surface In BoundingBox {-e, -e, -depth - e, e, width + e, e};
  rest[] -= across[];
  Physical Surface("x = 0") = across[];
EndIf
cone[] = Surface In BoundingBox {-radius - e, -e, -start - e, radius + e, radius + e, e};
rest[] -= cone[];
seabed[] = Surface In BoundingBox {-width - e, -e, -e, width + e, width + e, e};
rest[] -= seabed[];
Physical Surface("symmetry") = symmetry[];
Physical Surface("cone") = cone[];
Physical Surface("seabed") = seabed[];
Physical Surface("far side") = rest[];
