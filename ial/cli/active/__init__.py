"""`ial explore`: a robot that drives in order to be localized."""
