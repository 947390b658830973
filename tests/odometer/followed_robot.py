"""`FollowedRobot`: a simulated robot that remembers its last way, by which sets are asked whether they hold it."""

import math

from ial.odometer import Command, OdometerRobot
from ial.odometer.model import Chord, States


class FollowedRobot:
    """Obeys commands as the robot itself does.

    A chord is held against the way that was driven, which is what a chord says. The boxes around its curve take a hundred times as long to
    compute, and are tried in `test_model.py`.
    """

    def __init__(self, driven: OdometerRobot) -> None:
        self.driven = driven
        self._way: tuple[float, float] | None = None  # by how much x and y changed in the last drive that moved it

    def execute(self, command: Command) -> float:
        x, y = self.driven.x, self.driven.y
        reading = self.driven.execute(command)
        if reading > 0.0:
            self._way = self.driven.x - x, self.driven.y - y
        return reading

    def is_in(self, states: States) -> bool:
        if not isinstance(states, Chord):
            return states.holds(self.driven.x, self.driven.y, self.driven.heading_rad)
        assert self._way is not None
        dx, dy = self._way
        turned = math.remainder(self.driven.heading_rad - math.atan2(dy, dx) - 0.5 * sum(states.turn), 2.0 * math.pi)
        length = math.hypot(dx, dy)
        near_m, near_rad = 1e-14 * states.model.walls.size, 1e-14 * states.model.walls.size / length  # coordinates are rounded
        half = 0.5 * (states.turn[1] - states.turn[0]) + 1e-14
        return states.length[0] - near_m <= length <= states.length[1] + near_m and abs(turned) <= half + near_rad
