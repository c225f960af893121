// Two cylinders of 1 m radius that touch at the origin: a quarter of each, x >= 0. Circles around (0, -1) and (0, 1).
DefineConstant[ size = {0.0016, Name "size"} ];    // of the sides that touch [m]
DefineConstant[ zone = {0.02, Name "zone"} ];      // [rad] where they have that size
DefineConstant[ ratio = {0.77, Name "ratio"} ];    // of the upper one's sizes
coarse = 0.2;

Point(1) = {0, -1, 0, coarse};
Point(2) = {0, 0, 0, size};
Point(3) = {Sin(zone), Cos(zone) - 1, 0, size};
Point(4) = {1, -1, 0, coarse};
Circle(1) = {4, 1, 3};
Circle(2) = {3, 1, 2};
Line(3) = {2, 1};
Line(4) = {1, 4};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Point(5) = {0, 1, 0, coarse};
Point(6) = {0, 0, 0, ratio * size};
Point(7) = {Sin(zone), 1 - Cos(zone), 0, ratio * size};
Point(8) = {1, 1, 0, coarse};
Circle(5) = {6, 5, 7};
Circle(6) = {7, 5, 8};
Line(7) = {8, 5};
Line(8) = {5, 6};
Curve Loop(2) = {5, 6, 7, 8};
Plane Surface(2) = {2};

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("lower face") = {2};
Physical Curve("upper face") = {5};
Physical Curve("base") = {4};
Physical Curve("top") = {7};
Physical Curve("axis") = {3, 8};
