"""A bouncing robot with real geometry: where it can be, as pieces of walls with intervals of headings."""
