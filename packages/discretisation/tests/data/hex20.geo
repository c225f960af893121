Mesh.SecondOrderIncomplete = 1;
Include "bricks.geo";
