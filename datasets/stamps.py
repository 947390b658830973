"""Stamps: integer nanoseconds, read from decimals without a rounding error."""

from decimal import Decimal, InvalidOperation

_NANOSECONDS = Decimal(10**9)
_DIGITS = 11  # seconds beyond 10^11 do not fit into 64 bits of nanoseconds


def parse_stamp(text: str) -> int:
    """Return seconds, written as a decimal, in nanoseconds; digits below a nanosecond are rounded.

    Raises
    ------
    ValueError
        If the text is no number, not finite, or too large for a 64-bit stamp.
    """
    try:
        seconds = Decimal(text)
    except InvalidOperation:
        raise ValueError(f"{text!r} is not a time in seconds") from None
    if not seconds.is_finite() or seconds.adjusted() > _DIGITS or not -(2**63) <= seconds * _NANOSECONDS < 2**63:
        raise ValueError(f"{text!r} is not a time in seconds that 64 bits of nanoseconds can hold")
    return int((seconds * _NANOSECONDS).to_integral_value())


def format_stamp(stamp_ns: int) -> str:
    """Return nanoseconds as seconds with nine decimals."""
    sign = "-" if stamp_ns < 0 else ""
    return f"{sign}{abs(stamp_ns) // 10**9}.{abs(stamp_ns) % 10**9:09d}"
