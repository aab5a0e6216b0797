SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 0.2, 0.04};                        // a plank along x, in metres
Cylinder(2) = {0.4, 0.1, 0, 0, 0, 0.04, 0.04};           // a knot through it
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Physical Volume("knot") = {2};
Physical Volume("wood") = {3};
Physical Surface("wall") = Surface In BoundingBox{-0.01, -1, -1, 0.01, 1, 1};
Physical Surface("top") = Surface In BoundingBox{-1, -1, 0.03, 2, 1, 0.05};
Mesh.MeshSizeMax = 0.02;
