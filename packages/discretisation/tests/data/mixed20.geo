Mesh.SecondOrderIncomplete = 1;
Include "mixed.geo";
