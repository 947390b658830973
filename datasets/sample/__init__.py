"""The embedded sample: a real recording with a map, so that a fresh installation has something to localize.

MRPT's localization demo: a robot of the University of Málaga with a SICK LMS, 37 scans of 361 beams on 20 January 2006, and a map that was
drawn from another day's run. Licence: BSD-3, see LICENSE-MRPT.
"""

from importlib.resources import files
from pathlib import Path

from ial.datasets.opening import open_recording
from ial.datasets.recording import Recording
from ial.maps.grids.map_file import read_map
from ial.maps.grids.occupancy_grid import OccupancyGrid

_FOLDER = Path(str(files(__name__)))


def sample_recording_path() -> Path:
    """Return the path of the embedded recording."""
    return _FOLDER / "sample.mcap"


def sample_map_path() -> Path:
    """Return the path of the embedded map's YAML file."""
    return _FOLDER / "map.yaml"


def sample_recording() -> Recording:
    """Return the embedded recording."""
    return open_recording(sample_recording_path())


def sample_grid() -> OccupancyGrid:
    """Return the embedded map."""
    return read_map(sample_map_path())
