"""Streams of observations: 1 for a step that ended in a bump, 0 for one that did not."""

from ial.errors import StreamError

_LETTERS = {ord("0"): 0, ord("1"): 1}


def parse_stream(text: str) -> list[int]:
    """Return the observations of a text of 0 and 1; white space between them is left out.

    Raises
    ------
    StreamError
        If there is another symbol.
    """
    observations = []
    for at, symbol in enumerate("".join(text.split()), 1):
        if ord(symbol) not in _LETTERS:
            raise StreamError(f"symbol {at} of the stream is {symbol!r}; only 0 (a step) and 1 (a bump) are observations")
        observations.append(_LETTERS[ord(symbol)])
    return observations
