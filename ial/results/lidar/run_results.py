"""`RunResults`: the files that every run of the lidar localizer leaves in its folder, fed scan by scan."""

from collections.abc import Callable, Mapping
from typing import Any

from ial.datasets.recording import Step
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.configuration.config_record import config_yaml
from ial.lidar.estimate import Estimate
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from ial.results.lidar.enclosures import EnclosuresFile
from ial.results.lidar.events import EventsFile
from ial.results.lidar.picture import Picture
from ial.results.lidar.recording_mcap import RecordingFile
from ial.results.lidar.result_folder import ResultFolder
from ial.results.lidar.summary import Source, Summary
from ial.results.lidar.trajectory import TrajectoryFile

FILES = ("summary.json", "config.yaml", "enclosures.jsonl", "events.jsonl", "picture.png", "result.mcap", "trajectory.tum")
"""What a run writes, its record first."""


class RunResults:
    """The results of one run.

    Parameters
    ----------
    folder
        Where they are written.
    summary
        The numbers of the run.
    recording
        What is localized.
    grid
        The map.
    config
        The configuration of the localizer.
    reference
        Returns ``T_map_base`` of a reference at a scan, or None where it has none; None if there is no reference.

    Attributes
    ----------
    events
        What happened, for what only the caller can know.
    """

    def __init__(
        self,
        folder: ResultFolder,
        summary: Summary,
        recording: Source,
        grid: OccupancyGrid,
        config: LocalizerConfig,
        reference: Callable[[Step], Pose | None] | None = None,
    ) -> None:
        self._folder, self._config = folder, config
        self.summary = summary
        self.events = EventsFile(folder.place("events.jsonl"))
        walls_m = config.bounds.range_error_m + config.bounds.map_error_m
        folder.attach(
            TrajectoryFile(folder.place("trajectory.tum")),
            EnclosuresFile(folder.place("enclosures.jsonl")),
            self.events,
            RecordingFile(folder.place("result.mcap"), grid),
            Picture(folder.place("picture.png"), grid, recording.name, walls_m, reference),
        )

    def __repr__(self) -> str:
        return f"<RunResults in {self._folder.path}>"

    def add(self, step: Step, estimate: Estimate) -> None:
        """Take one scan and what it left of the possible poses.

        Raises
        ------
        OutputError
            If a file cannot be written.
        """
        self._folder.add(step, estimate)
        self.summary.add(step, estimate)

    def conclude(self, measures: Mapping[str, Any] | None, **more: Any) -> dict[str, Any]:
        """Complete all files, and return the record of the run as written.

        Parameters
        ----------
        measures
            The comparison with a reference, if there is one.
        more
            What else belongs to the record, as plain values that JSON can hold.

        Raises
        ------
        OutputError
            If a file cannot be written.
        """
        self._folder.close()
        self._folder.write("config.yaml", config_yaml(self._config))
        return self._folder.conclude(FILES[0], {**self.summary.as_dict(measures), **more})
