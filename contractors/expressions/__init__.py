"""Expressions, constraints and functions of boxes."""
