// Soil around a thin tube that stands on the axis, for a cone that is guided by it (guide_tube.xml): half-plane r >= tube, z <= 0,
// axisymmetric. The sides on the tube become the wall of the hole; they grow downwards, away from where the cone starts.
DefineConstant[ tube = {0.001785, Name "tube"} ];        // radius of the tube [m]
DefineConstant[ fine = {0.0016, Name "fine"} ];          // sides at its upper end [m]
DefineConstant[ coarse = {0.06, Name "coarse"} ];        // at its lower end and at the far boundary [m]
DefineConstant[ width = {0.36, Name "width"} ];
DefineConstant[ depth = {0.72, Name "depth"} ];

Point(1) = {tube, 0, 0, fine};
Point(2) = {tube, -25 * fine, 0, fine};
Point(3) = {tube, -depth, 0, coarse};
Point(4) = {width, -depth, 0, coarse};
Point(5) = {width, 0, 0, coarse};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};

Physical Surface("clay") = {1};
Physical Curve("base") = {3};
Physical Curve("far side") = {4};
Physical Curve("seabed") = {5};
Physical Curve("surface") = {1, 2, 5};
