// Half of the seabed around a buried pipe, symmetric about x = 0; the seabed is y = 0.
DefineConstant[ radius = {0.25, Name "radius"}, depth = {1.25, Name "depth of the centre"}, width = {8, Name "width"},
                height = {8, Name "height"}, fine = {0.06, Name "fine"}, coarse = {0.8, Name "coarse"} ];
Point(1) = {0, -height, 0, coarse};
Point(2) = {width, -height, 0, coarse};
Point(3) = {width, 0, 0, coarse};
Point(4) = {0, 0, 0, 3*fine};
Point(5) = {0, -depth + radius, 0, fine};
Point(6) = {0, -depth, 0, fine};
Point(7) = {radius, -depth, 0, fine};
Point(8) = {0, -depth - radius, 0, fine};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Circle(5) = {5, 6, 7};
Circle(6) = {7, 6, 8};
Line(7) = {8, 1};
Curve Loop(1) = {1:7};
Plane Surface(1) = {1};
Physical Surface("clay") = {1};
Physical Curve("base") = {1};
Physical Curve("side") = {2};
Physical Curve("seabed") = {3};
Physical Curve("symmetry") = {4, 7};
Physical Curve("pipe") = {5, 6};
