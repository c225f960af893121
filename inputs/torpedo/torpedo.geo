// Soil under and around a torpedo anchor whose ogive tip stands in the seabed up to its shoulder: half-plane r >= 0, axisymmetric.
// A body that hits at several metres per second throws the soft surface aside like water; this start leaves the splash out.
// The sides along the tip become the path along the whole hole, so they are many and short.
DefineConstant[ diameter = {1.07, Name "diameter"} ];     // of the anchor [m]
DefineConstant[ tip = {2.14, Name "tip"} ];               // length of the ogive, an arc tangent to the shaft
DefineConstant[ fine = {0.05, Name "fine"} ];             // sides at the tip; twice as long at the shoulder
DefineConstant[ coarse = {2.0, Name "coarse"} ];          // at the far boundary
DefineConstant[ width = {12.0, Name "width"} ];
DefineConstant[ depth = {48.0, Name "depth"} ];
radius = 0.5 * diameter;
arc = (radius * radius + tip * tip) / (2 * radius);

Point(1) = {0, -tip, 0, fine};
Point(2) = {radius, 0, 0, 2 * fine};
Point(3) = {width, 0, 0, coarse};
Point(4) = {width, -depth, 0, coarse};
Point(5) = {0, -depth, 0, coarse};
Point(6) = {radius - arc, 0, 0, fine};
Line(1) = {1, 5};
Line(2) = {5, 4};
Line(3) = {4, 3};
Line(4) = {3, 2};
Circle(5) = {2, 6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};

Physical Surface("clay") = {1};
Physical Curve("axis") = {1};
Physical Curve("base") = {2};
Physical Curve("far side") = {3};
Physical Curve("seabed") = {4};
Physical Curve("along the tip") = {5};
Physical Curve("surface") = {4, 5};
