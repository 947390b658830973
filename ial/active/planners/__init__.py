"""What chooses where a robot drives next: the planner of two stages, and those it is compared with."""
