"""The robot with a compass and a contact sensor: motions after which it is in one place (O'Kane 2005, O'Kane and LaValle 2007).

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.compass.bounded_model import BoundedCompassModel as BoundedCompassModel
    from ial.compass.bounded_state import BoundedState as BoundedState
    from ial.compass.example import example_polygon as example_polygon
    from ial.compass.model import CompassModel as CompassModel
    from ial.compass.planning import localizing_sequence as localizing_sequence
    from ial.compass.robot import CompassRobot as CompassRobot
    from ial.compass.rounding import rounded_share as rounded_share
    from ial.compass.sequence import Sequence as Sequence
    from ial.compass.sequence_file import read_sequence as read_sequence
    from ial.compass.sequence_file import write_sequence as write_sequence
    from ial.compass.state import InformationState as InformationState
    from ial.compass.transition import Transition as Transition
    from ial.compass.verifier import verify as verify
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "bounded_model": ("BoundedCompassModel",),
            "bounded_state": ("BoundedState",),
            "example": ("example_polygon",),
            "model": ("CompassModel",),
            "planning": ("localizing_sequence",),
            "robot": ("CompassRobot",),
            "rounding": ("rounded_share",),
            "sequence": ("Sequence",),
            "sequence_file": ("read_sequence", "write_sequence"),
            "state": ("InformationState",),
            "transition": ("Transition",),
            "verifier": ("verify",),
        },
    )
