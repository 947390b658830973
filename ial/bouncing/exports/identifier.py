"""`check_identifier`: names that C, C++ and Verilog all accept as the beginning of longer ones."""

import re

from ial.errors import ConfigError


def check_identifier(prefix: str) -> None:
    """Refuse what cannot begin the names of an export.

    Raises
    ------
    ConfigError
        If it is no ASCII letter followed by letters, digits and underscores. A leading underscore is left to compilers.
    """
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", prefix):
        raise ConfigError(f"the prefix {prefix!r} is no identifier; give a letter, followed by letters, digits and underscores")
