"""Measures of a run: the guarantee held against a reference trajectory.

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.study.containment import Containment as Containment
    from ial.study.good_beams import good_beams as good_beams
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "containment": ("Containment",),
            "good_beams": ("good_beams",),
        },
    )
