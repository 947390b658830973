"""Occupancy grids: their files and messages, tables of their cells, ray casting, symmetry and floor plans."""
