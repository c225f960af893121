// Plan of a quarter of the ground around a pile of 1 m radius that is pushed along x; cells grow outwards from the pile.
SetFactory("Built-in");
DefineConstant[ radius = {1.0, Name "radius"}, width = {5.0, Name "width"}, around = {28, Name "around"},
                out = {18, Name "out"}, growth = {1.3, Name "growth"} ];
Point(1) = {0, 0, 0};
Point(2) = {radius, 0, 0};
Point(3) = {width, 0, 0};
Point(4) = {0, width, 0};
Point(5) = {0, radius, 0};
Line(1) = {2, 3};
Circle(2) = {3, 1, 4};
Line(3) = {5, 4};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, -3, 4};
Plane Surface(1) = {1};
Transfinite Curve {2, 4} = around + 1;
Transfinite Curve {1, 3} = out + 1 Using Progression growth;
Transfinite Surface {1} Alternate;
Physical Surface("clay") = {1};
Physical Curve("y = 0") = {1};
Physical Curve("far side") = {2};
Physical Curve("x = 0") = {3};
Physical Curve("pile") = {4};
