"""Measures of a run: the guarantee held against a reference trajectory.

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.study.blocked_rays import blocked_rays as blocked_rays
    from ial.study.containment import Containment as Containment
    from ial.study.good_beams import bad_beams as bad_beams
    from ial.study.good_beams import good_beams as good_beams
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "containment": ("Containment",),
            "blocked_rays": ("blocked_rays",),
            "good_beams": ("bad_beams", "good_beams"),
        },
    )
