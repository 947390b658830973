"""An estimate stream on disk: trajectory, enclosures, events, summary, configuration, picture and a recording to look at.

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.results.config_record import config_record as config_record
    from ial.results.enclosures import Enclosure as Enclosure
    from ial.results.enclosures import EnclosuresFile as EnclosuresFile
    from ial.results.enclosures import read_enclosures as read_enclosures
    from ial.results.events import EventsFile as EventsFile
    from ial.results.picture import Picture as Picture
    from ial.results.recording_mcap import RecordingFile as RecordingFile
    from ial.results.result_folder import ResultFolder as ResultFolder
    from ial.results.sink import Sink as Sink
    from ial.results.summary import Summary as Summary
    from ial.results.trajectory import TrajectoryFile as TrajectoryFile
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "config_record": ("config_record",),
            "enclosures": ("Enclosure", "EnclosuresFile", "read_enclosures"),
            "events": ("EventsFile",),
            "picture": ("Picture",),
            "recording_mcap": ("RecordingFile",),
            "result_folder": ("ResultFolder",),
            "sink": ("Sink",),
            "summary": ("Summary",),
            "trajectory": ("TrajectoryFile",),
        },
    )
