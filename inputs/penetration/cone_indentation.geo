// Soil around a cone that is pushed in from the surface: half-plane r >= 0, z <= 0, axisymmetric.
// The sides under the cone (r < 1.04 radius) become the path from the tip up the whole face and shaft.
DefineConstant[ diameter = {0.1, Name "diameter"} ];   // of the cone [m]
DefineConstant[ fine = {0.002, Name "fine"} ];         // sides under the cone [m]
DefineConstant[ coarse = {0.1, Name "coarse"} ];      // at the far boundary [m]
DefineConstant[ width = {0.8, Name "width"} ];
DefineConstant[ depth = {1.0, Name "depth"} ];
edge = 0.52 * diameter;

Point(1) = {0, 0, 0, fine};
Point(2) = {edge, 0, 0, fine};
Point(3) = {width, 0, 0, coarse};
Point(4) = {width, -depth, 0, coarse};
Point(5) = {0, -depth, 0, coarse};
Line(1) = {1, 5};
Line(2) = {5, 4};
Line(3) = {4, 3};
Line(4) = {3, 2};
Line(5) = {2, 1};
// A diagonal from the corner of axis and surface, so that several elements meet there: one alone would have nearly all
// its nodes guided by axis and cone, and its corner pressure would be undetermined.
Point(6) = {5 * fine, -5 * fine, 0, 1.5 * fine};
Line(6) = {1, 6};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Curve{6} In Surface{1};

Physical Surface("clay") = {1};
Physical Curve("axis") = {1};
Physical Curve("base") = {2};
Physical Curve("far side") = {3};
Physical Curve("seabed") = {4};
Physical Curve("under the cone") = {5};
Physical Curve("surface") = {4, 5};
