"""`ial bounce run`: where a robot is that has seen a stream of bumps."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from ial.cli.bounce.observed import StreamBits, StreamFile, observations
from ial.cli.bounce.options import number
from ial.cli.shell.options import Json
from ial.cli.shell.terminal import say, say_json, say_json_line
from ial.errors import StreamError

if TYPE_CHECKING:
    from ial.bouncing.bump_timing import BumpTiming

NEVER_LOCALIZED = 3
_MOST_PLACES = 12


def run(
    filter_path: Annotated[Path, typer.Argument(metavar="FILTER", help="What `ial bounce build` has written.")],
    stream: StreamBits = None,
    file: StreamFile = None,
    log: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="A log of bumps with times, .csv or .jsonl; - for standard input."),
    ] = None,
    speed: Annotated[str | None, typer.Option(metavar="M/S", help="With --log: how fast the robot drives.")] = None,
    turn_time: Annotated[str | None, typer.Option(metavar="S", help="With --log: how long a turn takes.")] = None,
    clock_error: Annotated[
        str | None, typer.Option(metavar="S", help="With --log: bound of the error of the time driven between bumps.")
    ] = None,
    speed_error: Annotated[
        str | None,
        typer.Option(metavar="PART", help="With --log: bound of the error of the speed, as a part of it; refused if the filter has less."),
    ] = None,
    follow: Annotated[bool, typer.Option("--follow", help="With --log: wait for more, and print a line for each bump.")] = False,
    until_localized: Annotated[
        bool, typer.Option("--until-localized", help="With --log: follow each robot only until it is localized.")
    ] = False,
    world: Annotated[Literal["open", "closed"], typer.Option(help="May the robot be elsewhere? If closed, that is an error.")] = "open",
    restart: Annotated[bool, typer.Option("--restart", help="Begin anew after a rejection: the robot may have been carried.")] = False,
    as_json: Json = False,
) -> None:
    """Say where a robot is, or prove that it is in none of the environments."""
    if sum(each is not None for each in (stream, file, log)) != 1:
        raise StreamError("give the observations as one of --stream BITS, --file FILE and --log FILE")
    if log is not None:
        timing = _timing(speed, turn_time, clock_error, speed_error)
        localized = _run_log(filter_path, log, timing, (restart, world == "closed", until_localized), follow, as_json)
        if not localized:
            raise typer.Exit(NEVER_LOCALIZED)
        return
    if follow or until_localized or any(each is not None for each in (speed, turn_time, clock_error, speed_error)):
        raise StreamError("--speed, --turn-time, --clock-error, --speed-error, --follow and --until-localized are for a --log with times")
    from ial.bouncing.filters.filter_file import read_filter
    from ial.bouncing.filters.piece_filter import PieceFilter
    from ial.cli.bounce import outcome, piece_outcome

    made = read_filter(filter_path)
    if restart and not isinstance(made, PieceFilter):
        made.setting.check_restart()
    observed = observations(stream, file)
    record: dict[str, Any]
    if isinstance(made, PieceFilter):
        record = piece_outcome.outcome(made, observed, restart)
        if world == "closed" and record["rejected_at"]:
            raise StreamError(
                f"observation {record['rejected_at'][0]} of the stream fits no place of the environment, but the world is closed; check "
                "the map, the bouncing angle and the bounds of errors, or use the open world"
            )
        said = piece_outcome.lines(record)
    else:
        table = made.table.restarting() if restart else made.table
        record = outcome.outcome(made, table.run_closed(observed) if world == "closed" else table.run(observed))
        said = outcome.lines(record, _MOST_PLACES)
    if as_json:
        say_json(record)
    else:
        for line in said:
            say(line)
    if record["localized_at"] is None:
        raise typer.Exit(NEVER_LOCALIZED)


def _timing(speed: str | None, turn_time: str | None, clock_error: str | None, speed_error: str | None) -> "BumpTiming":
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


def _run_log(filter_path: Path, log: Path, timing: "BumpTiming", choices: tuple[bool, bool, bool], follow: bool, as_json: bool) -> bool:
    """Follow the robots of a log, and say what is known about them; return whether each of them was localized."""
    from ial.bouncing.filters.filter_file import read_filter
    from ial.cli.bounce.log_outcome import lines, record
    from ial.cli.bounce.log_run import LogRun

    made = read_filter(filter_path)
    run = LogRun(made, timing, *choices)
    if follow:
        run.follow(log, as_json)
    else:
        run.read(log)
    records = [record(made, robot, tracker) for robot, tracker in run.robots.items()]
    if as_json and follow:
        say_json_line({"robots": records})
    elif as_json:
        say_json({"robots": records})
    else:
        for told in records:
            for line in lines(made, told, _MOST_PLACES):
                say(line)
    return bool(records) and all(told["localized_at"] is not None for told in records)
