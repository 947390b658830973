"""The one family of errors. A message says what was found, where, and what to do about it."""


class IalError(Exception):
    """Any error that ial raises on purpose."""


class ConfigError(IalError):
    """A configuration that cannot be used: an unknown key, a negative bound, a value that is not finite."""


class MapError(IalError):
    """A map that cannot be read or cannot serve for localization."""


class RecordingError(IalError):
    """A recording that cannot be read or holds nothing to localize with."""


class TrajectoryError(IalError):
    """A trajectory file that cannot be read."""


class OutputError(IalError):
    """A result that cannot be written."""


class PavingError(IalError):
    """A file that holds no paving."""


class FilterError(IalError):
    """A filter that cannot be built, or a file that holds none."""


class SequenceError(IalError):
    """A localizing sequence that was not found, or a file that holds none."""


class StreamError(IalError):
    """A stream of observations that cannot be read, or that a closed world cannot produce."""


class ImpossibleError(IalError):
    """Something that no program can do, by a theorem that the message names."""


class RoundingModeError(IalError):
    """The processor does not round to nearest, or flushes subnormal numbers to zero: no bound could be trusted.

    Whatever computes a bound raises it, on every thread that works on it: see `ial.contractors.check_rounding`. So the docstrings of such
    functions do not say it again.
    """
