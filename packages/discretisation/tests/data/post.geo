// A post of 0.5 m radius and 2 m height from a CAD file in millimetres.
SetFactory("OpenCASCADE");
Geometry.OCCTargetUnit = "M";
Merge "post.step";
MeshSize{:} = 0.3;
Physical Volume("post") = {1};
Physical Surface("skin") = {1, 2, 3};
