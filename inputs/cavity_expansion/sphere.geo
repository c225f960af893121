// A quarter ring about the axis x = 0: rings of cells whose height grows with the radius. At four radii a cell of the
// wall is 16 times thinner and four times longer: rings too thin for their length (30 rings, 3 sectors) end in cells that turn over.
DefineConstant[ radius = {1.0, Name "radius"}, outer = {200.0, Name "outer"}, rings = {20, Name "rings"}, sectors = {4, Name "sectors"},
                triangles = {0, Name "triangles"} ];
Point(1) = {0, 0, 0};
Point(2) = {radius, 0, 0};
Point(3) = {outer, 0, 0};
Point(4) = {0, outer, 0};
Point(5) = {0, radius, 0};
Line(1) = {2, 3};
Circle(2) = {3, 1, 4};
Line(3) = {5, 4};
Circle(4) = {2, 1, 5};
Curve Loop(1) = {1, 2, -3, -4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = rings + 1 Using Progression (outer/radius)^(1/rings);
Transfinite Curve {2, 4} = sectors + 1;
Transfinite Surface {1} Alternate;
If (triangles == 0)
  Recombine Surface {1};
EndIf
Physical Surface("soil") = {1};
Physical Curve("equator") = {1};
Physical Curve("axis") = {3};
Physical Curve("far") = {2};
Physical Curve("cavity") = {4};
