"""`ial bounce run`: where a robot is that has seen a stream of bumps."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from ial.cli.bounce.observed import ClockError, LogFile, Speed, SpeedError, StreamBits, StreamFile, TurnTime, observations, timing
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
    log: LogFile = None,
    speed: Speed = None,
    turn_time: TurnTime = None,
    clock_error: ClockError = None,
    speed_error: SpeedError = None,
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
        times = timing(speed, turn_time, clock_error, speed_error)
        localized = _run_log(filter_path, log, times, (restart, world == "closed", until_localized), follow, as_json)
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


def _run_log(filter_path: Path, log: Path, times: "BumpTiming", choices: tuple[bool, bool, bool], follow: bool, as_json: bool) -> bool:
    """Follow the robots of a log, and say what is known about them; return whether each of them was localized."""
    from ial.bouncing.filters.filter_file import read_filter
    from ial.cli.bounce.log_outcome import lines, record
    from ial.cli.bounce.log_run import LogRun

    made = read_filter(filter_path)
    run = LogRun(made, times, *choices)
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
