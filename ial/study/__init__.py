"""Measures of a run: the guarantee held against a reference trajectory.

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.study.containment import Containment as Containment
    from ial.study.domain import Domain as Domain
    from ial.study.good_beams import bad_beams as bad_beams
    from ial.study.good_beams import consistent as consistent
    from ial.study.obstacles import Obstacles as Obstacles
    from ial.study.used_beams import UsedBeams as UsedBeams
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "containment": ("Containment",),
            "domain": ("Domain",),
            "good_beams": ("bad_beams", "consistent"),
            "obstacles": ("Obstacles",),
            "used_beams": ("UsedBeams",),
        },
    )
