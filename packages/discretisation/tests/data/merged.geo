Merge "cone_22.msh";
