Merge "shared.msh";
