"""Intervals, boxes, contractors and the paver: set computation with outward rounding, which knows no robot."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.contractors.boxes import Boxes as Boxes
    from ial.contractors.contractor import Contractor as Contractor
    from ial.contractors.contractor import Intersection as Intersection
    from ial.contractors.contractor import Union as Union
    from ial.contractors.geometry import Polar as Polar
    from ial.contractors.interval import Interval as Interval
    from ial.contractors.paver import Paving as Paving
    from ial.contractors.paver import pave as pave
    from ial.contractors.relaxed import Relaxed as Relaxed
    from ial.contractors.relaxed import relaxed_intersection as relaxed_intersection
    from ial.contractors.rounding import check_rounding as check_rounding
    from ial.contractors.threads import get_threads as get_threads
    from ial.contractors.threads import set_threads as set_threads
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "boxes": ("Boxes",),
            "contractor": ("Contractor", "Intersection", "Union"),
            "geometry": ("Polar",),
            "interval": ("Interval",),
            "paver": ("Paving", "pave"),
            "relaxed": ("Relaxed", "relaxed_intersection"),
            "rounding": ("check_rounding",),
            "threads": ("get_threads", "set_threads"),
        },
    )
