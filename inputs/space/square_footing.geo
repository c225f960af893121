// Quarter of a square footing on a block of soil, surface at z = 0, in tetrahedra or, with corners = 6 or 8, in wedges
// or hexahedra. Cells shrink towards the edge of the footing, where the stress is singular, and towards the surface.
// `cells` are those along the half width of the footing; the others follow.
SetFactory("Built-in");
DefineConstant[ half_width = {1.0, Name "half_width"}, width = {2.6, Name "width"}, depth = {1.5, Name "depth"},
                cells = {5, Name "cells"}, ratio = {12, Name "ratio"}, corners = {4, Name "corners"} ];
beside = Round(1.25*cells);
down = Round(1.5*cells);
a = half_width;
b = width;
Point(1) = {0, 0, 0};
Point(2) = {a, 0, 0};
Point(3) = {b, 0, 0};
Point(4) = {0, a, 0};
Point(5) = {a, a, 0};
Point(6) = {b, a, 0};
Point(7) = {0, b, 0};
Point(8) = {a, b, 0};
Point(9) = {b, b, 0};
// all lines begin at the edge of the footing
Line(1) = {2, 1};
Line(2) = {5, 4};
Line(3) = {8, 7};
Line(4) = {2, 3};
Line(5) = {5, 6};
Line(6) = {8, 9};
Line(7) = {4, 1};
Line(8) = {5, 2};
Line(9) = {6, 3};
Line(10) = {4, 7};
Line(11) = {5, 8};
Line(12) = {6, 9};
Curve Loop(1) = {-1, -8, 2, 7};
Curve Loop(2) = {4, -9, -5, 8};
Curve Loop(3) = {-2, 11, 3, -10};
Curve Loop(4) = {5, 12, -6, -11};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Plane Surface(4) = {4};
Transfinite Curve {1, 2, 3, 7, 8, 9} = cells + 1 Using Progression ratio^(1/(cells - 1));
Transfinite Curve {4, 5, 6, 10, 11, 12} = beside + 1 Using Progression (2*ratio)^(1/(beside - 1));
Transfinite Surface {1:4} Alternate;
// layers that grow downwards
growth = ratio^(1/(down - 1));
counts() = {};
depths() = {};
sum = 0;
For i In {0:down - 1}
  sum += growth^i;
EndFor
at = 0;
For i In {0:down - 1}
  at += growth^i/sum;
  counts() += {1};
  depths() += {at};
EndFor
If (corners == 8)
  Recombine Surface{1:4};
EndIf
If (corners == 4)
  below() = Extrude {0, 0, -depth} { Surface{1:4}; Layers{counts(), depths()}; };
Else
  below() = Extrude {0, 0, -depth} { Surface{1:4}; Layers{counts(), depths()}; Recombine; };
EndIf
// of each extruded surface: its lower end, the volume, then the faces of its curve loop
Physical Volume("clay") = {below(1), below(7), below(13), below(19)};
Physical Surface("footing") = {1};
Physical Surface("surface") = {2, 3, 4};
Physical Surface("base") = {below(0), below(6), below(12), below(18)};
Physical Surface("y = 0") = {below(2), below(8)};
Physical Surface("x = 0") = {below(5), below(17)};
Physical Surface("far side") = {below(9), below(16), below(21), below(22)};
