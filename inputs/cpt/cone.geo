// Soil around a cone penetrometer that stands in the ground, its hole open above it: half-plane r >= 0, axisymmetric. The contour is that
// of the body 'cone' (60 degrees, tip and shoulder rounded), its lowest point at the depth `start`.
// The sides on cone and wall become the path along the whole hole; they grow with the distance from the cone.
DefineConstant[ diameter = {0.0357, Name "diameter"} ];
DefineConstant[ tip_radius = {0.004, Name "tip_radius"}, shoulder_radius = {0.006, Name "shoulder_radius"} ];
DefineConstant[ start = {0.0714, Name "start"} ];        // depth of the tip [m]
DefineConstant[ fine = {0.0018, Name "fine"} ];          // sides on the cone
DefineConstant[ wall = {0.004, Name "wall"} ];           // sides at the mudline
DefineConstant[ coarse = {0.1, Name "coarse"} ];         // at the far boundary
DefineConstant[ width = {0.72, Name "width"} ];
DefineConstant[ depth = {0.9, Name "depth"} ];
radius = 0.5 * diameter;
half = Pi / 6;
apex = -start - tip_radius * (1 / Sin(half) - 1);        // of the sharp cone
corner = apex + radius / Tan(half);
cut = shoulder_radius * Tan(0.5 * half);                 // of the flank, for the shoulder's fillet

Point(1) = {0, -start, 0, fine};
Point(2) = {0, -start + tip_radius, 0, fine};
Point(3) = {tip_radius * Cos(half), -start + tip_radius * (1 - Sin(half)), 0, fine};
Point(4) = {radius - cut * Sin(half), corner - cut * Cos(half), 0, fine};
Point(5) = {radius - shoulder_radius, corner + cut, 0, fine};
Point(6) = {radius, corner + cut, 0, fine};
Point(7) = {radius, 0, 0, wall};
Point(8) = {width, 0, 0, coarse};
Point(9) = {width, -depth, 0, coarse};
Point(10) = {0, -depth, 0, coarse};
Line(1) = {1, 10};
Line(2) = {10, 9};
Line(3) = {9, 8};
Line(4) = {8, 7};
Line(5) = {7, 6};
Circle(6) = {6, 5, 4};
Line(7) = {4, 3};
Circle(8) = {3, 2, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8};
Plane Surface(1) = {1};

Physical Surface("clay") = {1};
Physical Curve("axis") = {1};
Physical Curve("base") = {2};
Physical Curve("far side") = {3};
Physical Curve("seabed") = {4};
Physical Curve("hole") = {5, 6, 7, 8};
Physical Curve("surface") = {4, 5, 6, 7, 8};
