"""The commands about bouncing robots: `ial bounce`."""
