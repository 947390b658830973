"""Pictures of filters and of what a bouncing robot knows."""
