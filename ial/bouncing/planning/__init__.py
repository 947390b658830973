"""Which angle, or sequence of angles, localizes best."""
