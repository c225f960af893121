// Ground under a body of revolution that goes in from its flat surface: a quarter, x, y >= 0, turned from the section x >= 0. The disc "cone" under the body, a little
// wider than it, becomes the wall of the hole.
SetFactory("OpenCASCADE");
DefineConstant[ diameter = {0.0357, Name "diameter"} ];                             // of the body [m]
DefineConstant[ tip = {0.002, Name "tip"}, fine = {0.003, Name "fine"} ];          // cells at the axis, at the rim of the disc
DefineConstant[ coarse = {0.055, Name "coarse"} ];                                  // at the far boundary
DefineConstant[ width = {0.14, Name "width"}, depth = {0.18, Name "depth"} ];
rim = 0.52 * diameter;

Point(1) = {0, 0, 0};
Point(2) = {rim, 0, 0};
Point(3) = {width, 0, 0};
Point(4) = {width, 0, -depth};
Point(5) = {0, 0, -depth};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Extrude {{0, 0, 1}, {0, 0, 0}, Pi / 2} { Surface{1}; }

Field[1] = MathEval;
Field[1].F = Sprintf("Min(%g, %g + %g*Min(Sqrt(x^2 + y^2 + z^2), %g) + 0.3*Max(0, Sqrt(x^2 + y^2 + z^2) - %g))", coarse, tip, (fine - tip) / rim, rim, rim);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Optimize = 1;

e = 1e-5;
Physical Volume("clay") = {1};
rest[] = Surface In BoundingBox {-e, -e, -depth - e, width + e, width + e, e};
symmetry[] = Surface In BoundingBox {-e, -e, -depth - e, width + e, e, e};
rest[] -= symmetry[];
across[] = Surface In BoundingBox {-e, -e, -depth - e, e, width + e, e};
rest[] -= across[];
cone[] = Surface In BoundingBox {-e, -e, -e, rim + e, rim + e, e};
rest[] -= cone[];
seabed[] = Surface In BoundingBox {-e, -e, -e, width + e, width + e, e};
seabed[] -= cone[];
rest[] -= seabed[];
Physical Surface("y = 0") = symmetry[];
Physical Surface("x = 0") = across[];
Physical Surface("cone") = cone[];
Physical Surface("seabed") = seabed[];
Physical Surface("far side") = rest[];
