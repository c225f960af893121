// Elastic half plane y <= 0 under a line contact: equal columns below the contact, growing ones beside it and downwards.
DefineConstant[ half = {0.025, Name "half"} ];      // half width of the equal columns [m]
DefineConstant[ cells = {36, Name "cells"} ];       // equal columns
DefineConstant[ size = {0.6, Name "size"} ];        // distance of the far boundary [m]
DefineConstant[ outer = {13, Name "outer"} ];       // columns on each side
DefineConstant[ rows = {18, Name "rows"} ];
DefineConstant[ growth = {1.3, Name "growth"} ];    // of neighbouring columns and rows

Point(1) = {-size, 0, 0};
Point(2) = {-half, 0, 0};
Point(3) = {half, 0, 0};
Point(4) = {size, 0, 0};
Point(5) = {-size, -size, 0};
Point(6) = {-half, -size, 0};
Point(7) = {half, -size, 0};
Point(8) = {size, -size, 0};
Line(1) = {2, 1};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {6, 5};
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {1, 5};
Line(8) = {2, 6};
Line(9) = {3, 7};
Line(10) = {4, 8};
Curve Loop(1) = {-1, 8, 4, -7};
Plane Surface(1) = {1};
Curve Loop(2) = {2, 9, -5, -8};
Plane Surface(2) = {2};
Curve Loop(3) = {3, 10, -6, -9};
Plane Surface(3) = {3};
Transfinite Curve{1, 3, 4, 6} = outer + 1 Using Progression growth;
Transfinite Curve{2, 5} = cells + 1;
Transfinite Curve{7, 8, 9, 10} = rows + 1 Using Progression growth;
Transfinite Surface{1, 2, 3};
Recombine Surface{1, 2, 3};

Physical Surface("soil") = {1, 2, 3};
Physical Curve("surface") = {1, 2, 3};
Physical Curve("far boundary") = {4, 5, 6, 7, 10};
