// A column of one triangle pair per layer. Every edge of the mesh is a line of the geometry, so that one set, "skeleton",
// holds all nodes.
DefineConstant[ layers = {40, Name "layers"}, width = {0.1, Name "width"} ];
edges() = {};
triangles() = {};
For i In {0 : layers}
  Point(2*i + 1) = {0, i/layers, 0, 10};
  Point(2*i + 2) = {width, i/layers, 0, 10};
  Line(5*i + 1) = {2*i + 1, 2*i + 2};
  edges() += {5*i + 1};
  If (i > 0)
    Line(5*i + 2) = {2*i, 2*i + 2};      // right
    Line(5*i + 3) = {2*i + 1, 2*i - 1};  // left
    Line(5*i + 4) = {2*i - 1, 2*i + 2};  // diagonal
    Curve Loop(2*i) = {5*i - 4, 5*i + 2, -(5*i + 4)};
    Plane Surface(2*i) = {2*i};
    Curve Loop(2*i + 1) = {5*i + 4, -(5*i + 1), 5*i + 3};
    Plane Surface(2*i + 1) = {2*i + 1};
    edges() += {5*i + 2, 5*i + 3, 5*i + 4};
    triangles() += {2*i, 2*i + 1};
  EndIf
EndFor
Transfinite Curve {edges()} = 2;
Physical Surface("soil") = {triangles()};
Physical Curve("skeleton") = {edges()};
Physical Curve("top") = {5*layers + 1};
