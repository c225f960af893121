// Quarter of a circle for Cryer's sphere, finer towards the drained surface.
SetFactory("Built-in");
DefineConstant[ inner = {0.03, Name "inner"}, outer = {0.035, Name "outer"} ];  // element sizes [m]
Point(1) = {0, 0, 0, inner};
Point(2) = {1, 0, 0, outer};
Point(3) = {0, 1, 0, outer};
Line(1) = {1, 2};
Circle(2) = {2, 1, 3};
Line(3) = {3, 1};
Curve Loop(1) = {1, 2, 3};
Plane Surface(1) = {1};
Physical Surface("soil") = {1};
Physical Curve("equator") = {1};
Physical Curve("surface") = {2};
Physical Curve("axis") = {3};
