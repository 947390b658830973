"""The commands about recordings and maps."""
