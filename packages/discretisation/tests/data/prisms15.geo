Mesh.SecondOrderIncomplete = 1;
Include "prisms.geo";
