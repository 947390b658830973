"""Interval operations: kernels on pairs of bounds, and `Interval`."""
