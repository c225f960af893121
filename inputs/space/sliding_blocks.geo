// A small block on a large one; both have nodes of their own.
SetFactory("OpenCASCADE");
DefineConstant[ size = {0.25, Name "size"} ];  // [m] of a cell
Box(1) = {0, 0, -0.5, 2, 1.5, 0.5};
Box(2) = {0.3, 0.3, 0, 0.6, 0.6, 0.4};
MeshSize {:} = size;
little = 1e-3;
Physical Surface("lower bottom") = Surface In BoundingBox {-little, -little, -0.5 - little, 2 + little, 1.5 + little, -0.5 + little};
Physical Surface("lower top") = {6};
Physical Surface("upper bottom") = {11};
Physical Surface("upper top") = {12};
Physical Volume("lower") = {1};
Physical Volume("upper") = {2};
