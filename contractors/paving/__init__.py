"""The paver, and what it returns."""
