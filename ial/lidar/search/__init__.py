"""How the poses that a scan allows are enclosed: a lattice of cells, the tables of a map, and the kernels that try cells by the batch."""
