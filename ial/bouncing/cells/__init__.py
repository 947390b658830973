"""A bouncing robot in the cells of its configuration space: where it can go from each, and the sparse set filter on that."""
