"""The one warning of this package."""


class MapWarning(UserWarning):
    """A map was read, but something in it probably means something else to the person who made it."""
