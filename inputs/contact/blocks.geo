// Two blocks of 1 m, one on the other, whose meshes do not match.
DefineConstant[ lower_cells = {3, Name "lower_cells"} ];
DefineConstant[ upper_cells = {5, Name "upper_cells"} ];

Point(1) = {0, -1, 0, 1 / lower_cells};
Point(2) = {1, -1, 0, 1.2 / lower_cells};
Point(3) = {1, 0, 0, 0.8 / lower_cells};
Point(4) = {0, 0, 0, 1 / lower_cells};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Point(5) = {0, 0, 0, 1.1 / upper_cells};
Point(6) = {1, 0, 0, 0.9 / upper_cells};
Point(7) = {1, 1, 0, 1 / upper_cells};
Point(8) = {0, 1, 0, 1.3 / upper_cells};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 5};
Curve Loop(2) = {5, 6, 7, 8};
Plane Surface(2) = {2};

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("base") = {1};
Physical Curve("lower top") = {3};
Physical Curve("upper bottom") = {5};
Physical Curve("top") = {7};
Physical Curve("left") = {4, 8};
Physical Curve("right") = {2, 6};
