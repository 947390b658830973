"""Everything a robot needs to localize itself by bumps: built from environments, kept in a file, run for one or several of them."""
