"""`ial compass run`: a simulated robot carries out a sequence."""

from typing import Annotated

import typer

from ial.cli.compass.surroundings import place
from ial.cli.compass.verify import SequencePath, prove
from ial.cli.shell.options import Json
from ial.cli.shell.terminal import say, say_json


def run(
    sequence_path: SequencePath,
    start: Annotated[str, typer.Option(metavar="X,Y", help="Where the robot starts, in metres: 1.5,2 or 3/2,2.")],
    as_json: Json = False,
) -> None:
    """Verify a sequence, drive a simulated robot, exactly, and say where it is after each motion; the robot itself knows it at the end."""
    from ial.compass.robot import CompassRobot
    from ial.compass.sequence_file import read_sequence

    sequence = read_sequence(sequence_path)
    robot = CompassRobot(sequence.polygon, place(start))
    prove(sequence, sequence_path)
    places = [robot.place, *(robot.drive(*direction) for direction in sequence.directions)]
    if robot.place != sequence.end:
        raise AssertionError("a proved sequence leads everywhere to its end")
    if as_json:
        steps = [
            {"direction": [str(each) for each in direction], "place_m": [float(x), float(y)]}
            for direction, (x, y) in zip(sequence.directions, places[1:], strict=True)
        ]
        say_json({"start_m": [float(each) for each in places[0]], "steps": steps, "localized": True})
    else:
        width = len(str(len(sequence)))
        for step, (direction, (x, y)) in enumerate(zip(sequence.directions, places[1:], strict=True), 1):
            say(f"{step:>{width}}  ({direction[0]}, {direction[1]})  to x {float(x):.6g} m, y {float(y):.6g} m")
        say("localized: the robot is where every robot is after this sequence, exactly; that was proved first")
