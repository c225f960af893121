// Soil around a cone that is pushed in from the surface: half-plane r >= 0, z <= 0, axisymmetric.
DefineConstant[ diameter = {0.1, Name "diameter"} ];
DefineConstant[ fine = {0.004, Name "fine"} ];      // element size at the tip [m]
DefineConstant[ coarse = {0.08, Name "coarse"} ];      // element size at the far boundary [m]
DefineConstant[ width = {0.8, Name "width"} ];
DefineConstant[ depth = {1.0, Name "depth"} ];
near = 0.65 * diameter;                    // the part of the surface that the cone may touch

Point(1) = {0, 0, 0, fine};
Point(2) = {near, 0, 0, 1.6 * fine};
Point(3) = {width, 0, 0, coarse};
Point(4) = {width, -depth, 0, coarse};
Point(5) = {0, -depth, 0, coarse};
Point(6) = {0, -1.3 * diameter, 0, 2 * fine};
Line(1) = {1, 6};
Line(2) = {6, 5};
Line(3) = {5, 4};
Line(4) = {4, 3};
Line(5) = {3, 2};
Line(6) = {2, 1};
// A diagonal from the corner of axis and surface, so that several elements meet there: one alone would have nearly all
// its nodes guided by axis and cone, and its corner pressure would be undetermined.
Point(7) = {5 * fine, -5 * fine, 0, fine};
Line(7) = {1, 7};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
Curve{7} In Surface{1};

Physical Surface("clay") = {1};
Physical Curve("axis") = {1, 2};
Physical Curve("base") = {3};
Physical Curve("far side") = {4};
Physical Curve("surface") = {5, 6};
