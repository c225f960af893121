// Two bars of 1 m on one line, a gap apart, of 1e-4 m2 each in a metre of depth.
DefineConstant[ cells = {100, Name "cells"} ];
DefineConstant[ gap = {0.01, Name "gap"} ];
height = 1e-4;

Point(1) = {-1 - gap / 2, 0, 0};
Point(2) = {-gap / 2, 0, 0};
Point(3) = {-gap / 2, height, 0};
Point(4) = {-1 - gap / 2, height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Point(5) = {gap / 2, 0, 0};
Point(6) = {1 + gap / 2, 0, 0};
Point(7) = {1 + gap / 2, height, 0};
Point(8) = {gap / 2, height, 0};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 5};
Curve Loop(2) = {5, 6, 7, 8};
Plane Surface(2) = {2};

Transfinite Curve {1, 3, 5, 7} = cells + 1;
Transfinite Curve {2, 4, 6, 8} = 2;
Transfinite Surface {1, 2};
Recombine Surface {1, 2};

Physical Surface("left bar") = {1};
Physical Surface("right bar") = {2};
Physical Curve("left flanks") = {1, 3};
Physical Curve("right flanks") = {5, 7};
Physical Curve("left face") = {2};
Physical Curve("right face") = {8};
