// A quarter of clay around a square plate with rounded edges, wished in place.
SetFactory("OpenCASCADE");
DefineConstant[ side = {0.4, Name "side"}, thickness = {0.1, Name "thickness"} ];  // [m]
DefineConstant[ rounding = {0.04, Name "rounding"} ];
DefineConstant[ start = {0.8, Name "start"} ];         // depth of the plate's middle [m]
DefineConstant[ fine = {0.03, Name "fine"} ];          // cells at the plate's edge
DefineConstant[ coarse = {0.5, Name "coarse"} ];
DefineConstant[ width = {2.0, Name "width"}, depth = {2.4, Name "depth"} ];
Box(1) = {0, 0, -depth, width, width, depth};
Box(2) = {-0.5 * side, -0.5 * side, -start - 0.5 * thickness, side, side, thickness};
edges() = Unique(Abs(Boundary{ Surface{ Unique(Abs(Boundary{ Volume{2}; }))}; }));
Fillet{2}{edges()}{rounding}
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
e = 1e-4;
left() = Surface In BoundingBox {-e, -e, -depth - e, e, width + e, e};
front() = Surface In BoundingBox {-e, -e, -depth - e, width + e, e, e};
top() = Surface In BoundingBox {-e, -e, -e, width + e, width + e, e};
bottom() = Surface In BoundingBox {-e, -e, -depth - e, width + e, width + e, -depth + e};
far() = Surface In BoundingBox {width - e, -e, -depth - e, width + e, width + e, e};
far() += Surface In BoundingBox {-e, width - e, -depth - e, width + e, width + e, e};
plate() = Surface In BoundingBox {-e, -e, -start - 0.5 * thickness - e, 0.5 * side + e, 0.5 * side + e, -start + 0.5 * thickness + e};
plate() -= left();
plate() -= front();
Physical Surface("x = 0") = left();
Physical Surface("y = 0") = front();
Physical Surface("seabed") = top();
Physical Surface("base") = bottom();
Physical Surface("far") = far();
Physical Surface("plate") = plate();
Physical Volume("clay") = Volume{:};
// fine at the plate's edge, less so over its faces
half = 0.5 * side;
Field[1] = MathEval;
Field[1].F = Sprintf("%g + 0.3*Max(0, Sqrt((Max(0, Max(x, y) - %g))^2 + (Max(0, Abs(z + %g) - %g))^2) - 0.02) + 0.15*Max(0, %g - Max(x, y))", fine, half, start, 0.5 * thickness, half);
Field[2] = MathEval;
Field[2].F = Sprintf("%g", coarse);
Field[3] = Min;
Field[3].FieldsList = {1, 2};
Background Field = 3;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Optimize = 1;
