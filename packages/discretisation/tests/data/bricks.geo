// 4 x 3 x 2 bricks of hexahedra, swept downwards: Gmsh's elements have negative volumes.
Point(1) = {0, 0, 0};
line[] = Extrude {4, 0, 0} { Point{1}; Layers{4}; };
floor[] = Extrude {0, 3, 0} { Line{line[1]}; Layers{3}; Recombine; };
block[] = Extrude {0, 0, -2} { Surface{floor[1]}; Layers{2}; Recombine; };
Physical Volume(1) = {block[1]};
Physical Surface("top") = {floor[1]};
Physical Surface("bottom") = {block[0]};
