// Half of a footing on a rectangle of soil, surface at y = 0. Cells shrink towards the edge of the footing, where the stress
// is singular, and towards the surface. `cells` are those under the half width; the others follow.
DefineConstant[ half_width = {1.0, Name "half_width"}, width = {4.5, Name "width"}, depth = {2.5, Name "depth"},
                cells = {8, Name "cells"}, ratio = {10, Name "ratio"}, triangles = {0, Name "triangles"} ];
beside = Round(1.5*cells);
down = Round(1.5*cells);
Point(1) = {0, -depth, 0};
Point(2) = {half_width, -depth, 0};
Point(3) = {width, -depth, 0};
Point(4) = {width, 0, 0};
Point(5) = {half_width, 0, 0};
Point(6) = {0, 0, 0};
Line(1) = {2, 1};
Line(2) = {2, 3};
Line(3) = {4, 3};
Line(4) = {5, 4};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {5, 2};
Curve Loop(1) = {-1, -7, 5, 6};
Curve Loop(2) = {2, -3, -4, 7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve {1, 5} = cells + 1 Using Progression ratio^(1/(cells - 1));
Transfinite Curve {2, 4} = beside + 1 Using Progression (3*ratio)^(1/(beside - 1));
Transfinite Curve {3, 6, 7} = down + 1 Using Progression (2*ratio)^(1/(down - 1));
Transfinite Surface {1, 2} Alternate;
If (triangles == 0)
  Recombine Surface {1, 2};
EndIf
Physical Surface("soil") = {1, 2};
Physical Curve("footing") = {5};
Physical Curve("surface") = {4};
Physical Curve("symmetry") = {6};
Physical Curve("far side") = {3};
Physical Curve("base") = {1, 2};
