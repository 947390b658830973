"""What a robot has observed, from an option, a file or standard input: a stream, or a log with times."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ial.cli.bounce.options import number
from ial.errors import StreamError

if TYPE_CHECKING:
    from ial.bouncing.bump_timing import BumpTiming

StreamBits = Annotated[
    str | None, typer.Option("--stream", metavar="BITS", help="The observations: 1 for a bump, 0 for a step without one.")
]
StreamFile = Annotated[Path | None, typer.Option("--file", metavar="FILE", help="A file with the observations; - for standard input.")]

LogFile = Annotated[
    Path | None, typer.Option("--log", metavar="FILE", help="A log of bumps with times, .csv or .jsonl; - for standard input.")
]
Speed = Annotated[str | None, typer.Option("--speed", metavar="M/S", help="With --log: how fast the robot drives.")]
TurnTime = Annotated[str | None, typer.Option("--turn-time", metavar="S", help="With --log: how long a turn takes.")]
ClockError = Annotated[
    str | None, typer.Option("--clock-error", metavar="S", help="With --log: bound of the error of the time driven between bumps.")
]
SpeedError = Annotated[
    str | None,
    typer.Option(
        "--speed-error",
        metavar="PART",
        help="With --log: bound of the error of the speed, as a part of it; refused if the filter has less.",
    ),
]


def timing(speed: str | None, turn_time: str | None, clock_error: str | None, speed_error: str | None) -> "BumpTiming":
    """Return what the times of a log tell.

    Raises
    ------
    StreamError
        If an option is missing that says so.
    ConfigError
        If one cannot be meant.
    """
    from ial.bouncing.bump_timing import BumpTiming

    if speed is None:
        raise StreamError("a log has times, and only the speed of the robot makes ways of them; give --speed, in metres per second")
    if turn_time is None or clock_error is None:
        raise StreamError(
            "a log has times: say with --turn-time how many seconds a turn takes, and with --clock-error by how many the time driven "
            "between bumps may be wrong; 0 only if it is so, since wrong ones lead to wrong places"
        )
    more = {"--turn-time": turn_time, "--clock-error": clock_error, "--speed-error": speed_error}
    return BumpTiming(number(speed, "--speed"), *(number(text or "0", option) for option, text in more.items()))


def observations(stream: str | None, file: Path | None) -> list[int]:
    """Return the observations of `--stream`, else of `--file`, else of standard input.

    Raises
    ------
    StreamError
        If they cannot be read, or there is another symbol.
    """
    from ial.bouncing.stream import parse_stream

    return parse_stream(_read(file) if stream is None else stream)


def _read(file: Path | None) -> str:
    if file is None or str(file) == "-":
        return sys.stdin.read()
    try:
        return file.read_text(encoding="ascii")
    except OSError as error:
        raise StreamError(f"{file}: the stream cannot be read ({error.strerror or error}); check the path") from None
    except UnicodeDecodeError:
        raise StreamError(f"{file}: the stream is no text; give a file of 0 and 1") from None
