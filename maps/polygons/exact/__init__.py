"""Exact geometry among walls, in rational numbers: where a ray ends, what is seen, shortest ways, symmetries."""
