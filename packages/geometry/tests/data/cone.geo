// Half of a cone penetrometer with rounded apex and shoulder, tip at (2, 3), drawn in no particular order and direction.
SetFactory("Built-in");
DefineConstant[ diameter = {1, Name "diameter"} ];
a = Pi / 6;
r = 0.1;   // of the apex
s = 0.3;   // of the shoulder
xt = r * Cos(a);
yt = r * (1 - Sin(a));
ys = yt + (diameter / 2 - xt) / Tan(a);
t = s * Tan(a / 2);
Point(1) = {2, 3, 0};
Point(2) = {2, 3 + r, 0};
Point(3) = {2 + xt, 3 + yt, 0};
Point(4) = {2 + diameter / 2 - t * Sin(a), 3 + ys - t * Cos(a), 0};
Point(5) = {2 + diameter / 2 - s, 3 + ys + t, 0};
Point(6) = {2 + diameter / 2, 3 + ys + t, 0};
Point(7) = {2 + diameter / 2, 8, 0};
Line(4) = {7, 6};
Circle(1) = {1, 2, 3};
Circle(3) = {6, 5, 4};
Line(2) = {3, 4};
Physical Curve("cone") = {4, 1, 3, 2};
Physical Curve("flank") = {2};
Physical Curve("parts") = {1, 4};
