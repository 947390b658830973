"""Environments as polygons with holes, in exact coordinates: their files, their walls, and what a beam among these may hit."""
