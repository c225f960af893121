SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Rectangle(20) = {3, 0, 0, 1, 1};
Physical Volume("soil") = {1};
Physical Surface("afar") = {20};
