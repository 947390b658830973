"""The commands about the localizer."""
