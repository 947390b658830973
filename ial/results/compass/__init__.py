"""Pictures of robots with a compass."""
