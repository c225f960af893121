// A slope of 1 : 2 with its toe at (0, 0), on soil down to `base` below the toe. Behind the crest the soil reaches
// `behind`, before the toe `before`. With a base of 0 the soil ends at the toe.
DefineConstant[ size = {1.0, Name "size"}, height = {10.0, Name "height"}, base = {0.0, Name "base"},
                behind = {12.0, Name "behind"}, before = {20.0, Name "before"} ];
Point(1) = {0, 0, 0, size};
Point(2) = {2*height, height, 0, size};
Point(3) = {2*height + behind, height, 0, size};
Point(4) = {2*height + behind, -base, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
If (base > 0)
  Point(5) = {-before, -base, 0, size};
  Point(6) = {-before, 0, 0, size};
  Line(4) = {4, 5};
  Line(5) = {5, 6};
  Line(6) = {6, 1};
  Curve Loop(1) = {1:6};
  Physical Curve("sides") = {3, 5};
  Physical Curve("surface") = {1, 2, 6};
Else
  Line(4) = {4, 1};
  Curve Loop(1) = {1:4};
  Physical Curve("sides") = {3};
  Physical Curve("surface") = {1, 2};
EndIf
Plane Surface(1) = {1};
Physical Surface("soil") = {1};
Physical Curve("base") = {4};
