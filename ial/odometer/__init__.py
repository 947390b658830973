"""A robot with a linear and an angular odometer: localization from the lengths of its drives (O'Kane and LaValle 2007, robot R1).

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.odometer.belief import OdometerBelief as OdometerBelief
    from ial.odometer.command import Command as Command
    from ial.odometer.commanded_robot import CommandedRobot as CommandedRobot
    from ial.odometer.configurations import Configurations as Configurations
    from ial.odometer.estimate import OdometerEstimate as OdometerEstimate
    from ial.odometer.hypotheses import Hypothesis as Hypothesis
    from ial.odometer.localization import Localization as Localization
    from ial.odometer.localization import Session as Session
    from ial.odometer.localization import localize as localize
    from ial.odometer.model import OdometerModel as OdometerModel
    from ial.odometer.odometer_bounds import OdometerBounds as OdometerBounds
    from ial.odometer.pilot import Pilot as Pilot
    from ial.odometer.robot import OdometerRobot as OdometerRobot
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "belief": ("OdometerBelief",),
            "command": ("Command",),
            "commanded_robot": ("CommandedRobot",),
            "configurations": ("Configurations",),
            "estimate": ("OdometerEstimate",),
            "hypotheses": ("Hypothesis",),
            "localization": ("Localization", "Session", "localize"),
            "model": ("OdometerModel",),
            "odometer_bounds": ("OdometerBounds",),
            "pilot": ("Pilot",),
            "robot": ("OdometerRobot",),
        },
    )
