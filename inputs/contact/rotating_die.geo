// A slab with a fine top under a ring whose rim has 24 sides and a node at its lowest point.
DefineConstant[ sides = {24, Name "sides"} ];
DefineConstant[ cells = {96, Name "cells"} ];   // along the slab's top

Point(1) = {-1.5, -1, 0};
Point(2) = {1.5, -1, 0};
Point(3) = {1.5, 0, 0};
Point(4) = {-1.5, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = cells + 1;
Transfinite Curve {2, 4} = 25;
Transfinite Surface {1};
Recombine Surface {1};

inner = 0.7;
Point(10) = {0, 1, 0};
For i In {0:3}
  angle = -Pi / 2 + i * Pi / 2;
  Point(11 + i) = {Cos(angle), 1 + Sin(angle), 0};
  Point(21 + i) = {inner * Cos(angle), 1 + inner * Sin(angle), 0};
EndFor
For i In {0:3}
  next = (i + 1) % 4;
  Circle(11 + i) = {11 + i, 10, 11 + next};
  Circle(21 + i) = {21 + i, 10, 21 + next};
  Line(31 + i) = {21 + i, 11 + i};
EndFor
For i In {0:3}
  next = (i + 1) % 4;
  Curve Loop(11 + i) = {31 + i, 11 + i, -(31 + next), -(21 + i)};
  Plane Surface(11 + i) = {11 + i};
EndFor
Transfinite Curve {11:14, 21:24} = sides / 4 + 1;
Transfinite Curve {31:34} = 4;
Transfinite Surface {11:14};
Recombine Surface {11:14};

Physical Surface("slab") = {1};
Physical Surface("die") = {11:14};
Physical Curve("base") = {1};
Physical Curve("slab top") = {3};
Physical Curve("rim") = {11:14};
Physical Curve("hub") = {21:24};
