"""An estimate stream on disk: trajectory, enclosures, events, summary, picture and a recording to look at.

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.results.lidar.enclosures import Enclosure as Enclosure
    from ial.results.lidar.enclosures import EnclosuresFile as EnclosuresFile
    from ial.results.lidar.enclosures import read_enclosures as read_enclosures
    from ial.results.lidar.events import EventsFile as EventsFile
    from ial.results.lidar.picture import Picture as Picture
    from ial.results.lidar.recording_mcap import RecordingFile as RecordingFile
    from ial.results.lidar.result_folder import ResultFolder as ResultFolder
    from ial.results.lidar.sink import Sink as Sink
    from ial.results.lidar.summary import Summary as Summary
    from ial.results.lidar.trajectory import TrajectoryFile as TrajectoryFile
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "lidar.enclosures": ("Enclosure", "EnclosuresFile", "read_enclosures"),
            "lidar.events": ("EventsFile",),
            "lidar.picture": ("Picture",),
            "lidar.recording_mcap": ("RecordingFile",),
            "lidar.result_folder": ("ResultFolder",),
            "lidar.sink": ("Sink",),
            "lidar.summary": ("Summary",),
            "lidar.trajectory": ("TrajectoryFile",),
        },
    )
