// Half section of a disc of ground about a well on the axis x = 0: clay over sand, with the screen of the well along
// the axis.
DefineConstant[ radius = {100, Name "radius"}, clay = {4, Name "clay"}, depth = {12, Name "depth"},
                screen_top = {6, Name "screen_top"}, screen_end = {10, Name "screen_end"},
                fine = {0.3, Name "fine"}, coarse = {5, Name "coarse"} ];
Point(1) = {0, -depth, 0, 2*fine};
Point(2) = {0, -screen_end, 0, fine};
Point(3) = {0, -screen_top, 0, fine};
Point(4) = {0, -clay, 0, fine};
Point(5) = {0, 0, 0, 2*fine};
Point(6) = {radius, -depth, 0, coarse};
Point(7) = {radius, -clay, 0, coarse};
Point(8) = {radius, 0, 0, coarse};
Line(1) = {2, 1};
Line(2) = {3, 2};
Line(3) = {4, 3};
Line(4) = {5, 4};
Line(5) = {1, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 5};
Line(9) = {4, 7};
Curve Loop(1) = {3, 2, 1, 5, 6, -9};
Curve Loop(2) = {4, 9, 7, 8};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Physical Surface("sand") = {1};
Physical Surface("clay") = {2};
Physical Curve("screen") = {2};
Physical Curve("axis") = {1, 2, 3, 4};
Physical Curve("base") = {5};
Physical Curve("far sand") = {6};
Physical Curve("far side") = {6, 7};
Physical Curve("surface") = {8};
