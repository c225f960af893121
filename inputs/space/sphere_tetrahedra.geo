// Octant of a sphere of 1 m radius for Cryer's problem, finer towards the drained surface.
SetFactory("Built-in");
DefineConstant[ inner = {0.14, Name "inner"}, outer = {0.14, Name "outer"} ];  // element sizes [m]
Point(1) = {0, 0, 0, inner};
Point(2) = {1, 0, 0, outer};
Point(3) = {0, 1, 0, outer};
Point(4) = {0, 0, 1, outer};
Line(1) = {1, 2};
Line(2) = {1, 3};
Line(3) = {1, 4};
Circle(4) = {2, 1, 3};
Circle(5) = {3, 1, 4};
Circle(6) = {4, 1, 2};
Curve Loop(1) = {1, 4, -2};
Plane Surface(1) = {1};
Curve Loop(2) = {2, 5, -3};
Plane Surface(2) = {2};
Curve Loop(3) = {3, 6, -1};
Plane Surface(3) = {3};
Curve Loop(4) = {4, 5, 6};
Surface(4) = {4};
Surface Loop(1) = {1, 2, 3, 4};
Volume(1) = {1};
Physical Volume("soil") = {1};
Physical Surface("z = 0") = {1};
Physical Surface("x = 0") = {2};
Physical Surface("y = 0") = {3};
Physical Surface("surface") = {4};
