"""Comparators: what is not guaranteed, to compare with."""
