"""Pictures of what a robot with odometers knows."""
