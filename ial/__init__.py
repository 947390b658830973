"""Guaranteed robot localization with interval analysis.

``import ial`` costs almost nothing: the rooms of the house (`ial.contractors`, `ial.maps`, `ial.datasets`, `ial.lidar`, …) and the names
below are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial import bouncing as bouncing
    from ial import contractors as contractors
    from ial import datasets as datasets
    from ial import lidar as lidar
    from ial import maps as maps
    from ial import odometer as odometer
    from ial import particles as particles
    from ial import results as results
    from ial.errors import ConfigError as ConfigError
    from ial.errors import FilterError as FilterError
    from ial.errors import IalError as IalError
    from ial.errors import ImpossibleError as ImpossibleError
    from ial.errors import MapError as MapError
    from ial.errors import OutputError as OutputError
    from ial.errors import PavingError as PavingError
    from ial.errors import RecordingError as RecordingError
    from ial.errors import RoundingModeError as RoundingModeError
    from ial.errors import SequenceError as SequenceError
    from ial.errors import StreamError as StreamError
    from ial.errors import TrajectoryError as TrajectoryError
    from ial.pose import Pose as Pose
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "bouncing": (),
            "contractors": (),
            "datasets": (),
            "lidar": (),
            "maps": (),
            "odometer": (),
            "particles": (),
            "results": (),
            "errors": (
                "ConfigError",
                "FilterError",
                "IalError",
                "ImpossibleError",
                "MapError",
                "OutputError",
                "PavingError",
                "RecordingError",
                "RoundingModeError",
                "SequenceError",
                "StreamError",
                "TrajectoryError",
            ),
            "pose": ("Pose",),
        },
    )
