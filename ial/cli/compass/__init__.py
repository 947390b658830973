"""The commands about robots with a compass: `ial compass`."""
