"""`Job`: what `ial localize` was asked to do, and the doing of it."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ial.cli.shell.inputs import Inputs
from ial.cli.shell.terminal import progress
from ial.contractors.boxes import Boxes
from ial.contractors.threads import get_threads
from ial.datasets.trajectory import read_tum
from ial.errors import ConfigError
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.results.lidar.result_folder import ResultFolder
from ial.results.lidar.run_results import RunResults
from ial.results.lidar.summary import Summary
from ial.study.containment import Containment
from ial.study.reference import TruthFrame


@dataclass(frozen=True)
class Job:
    """One run of the localizer over a recording, with its results in a folder.

    Parameters
    ----------
    inputs
        What to localize, and in which map.
    config
        The configuration of the localizer.
    out
        The folder of the results.
    start, stop, every
        Which raw scans to process, like a slice.
    static
        Whether each scan is localized by itself.
    truth, truth_frame
        A reference trajectory, and whose poses it holds.
    initial, initial_radius
        Pose x, y, θ (m, m, rad) at the start, and how far off the position (m, along x and along y) and the heading (rad) may be.
    """

    inputs: Inputs
    config: LocalizerConfig
    out: Path
    start: int = 0
    stop: int | None = None
    every: int = 1
    static: bool = False
    truth: Path | None = None
    truth_frame: TruthFrame = "base"
    initial: tuple[float, float, float] | None = None
    initial_radius: tuple[float, float] | None = None

    def run(self) -> tuple[Summary, dict[str, Any]]:
        """Localize and write all results; return the summary, as it is and as written.

        Raises
        ------
        IalError
            If an input cannot be used or the results cannot be written; nothing is then left under the name of a result.
        """
        with ResultFolder(self.out) as folder:
            truth = None if self.truth is None else read_tum(self.truth)
            recording, grid = self.inputs.source(), self.inputs.grid()
            localizer = Localizer(grid, config=self.config, initial=self._region())
            containment = None if truth is None else Containment(localizer, truth, self.truth_frame, static=self.static)
            summary = Summary(recording, grid, self.config, self._options())
            reference = None if containment is None else containment.reference
            results = RunResults(folder, summary, recording, grid, self.config, reference)
            scans = localize(recording, localizer, start=self.start, stop=self.stop, every=self.every, static=self.static)
            for step, estimate in progress(scans, self._total, Path(recording.name).name):
                results.add(step, estimate)
                if containment is not None:
                    containment.add(step, estimate)
            record = results.conclude(_measures(containment))
        return summary, record

    @property
    def _total(self) -> int | None:
        """How many scans will be processed, if that is known."""
        return None if self.stop is None else len(range(self.start, self.stop, self.every))

    def _region(self) -> Boxes | None:
        """Return the box in which the search starts, rounded outward; None for the whole map."""
        if self.initial is None or self.initial_radius is None:
            return None
        x, y, theta = self.initial
        position, heading = self.initial_radius
        if not (abs(np.array([*self.initial, *self.initial_radius])) < 1e9).all() or min(self.initial_radius) < 0.0:
            raise ConfigError(
                f"--initial {x:g} {y:g} {theta:g} --initial-radius {position:g} {heading:g} is no region; give finite numbers, and "
                "radii that are not negative"
            )
        return Boxes.around([self.initial], [position, position, heading])

    def _options(self) -> dict[str, Any]:
        """Return what was asked for, under the names of the options, as plain values that JSON can hold."""
        inputs = self.inputs
        return {
            "recording": _text(inputs.recording),
            "map": _text(inputs.map_path),
            "map_semantics": inputs.semantics,
            "map_topic": inputs.map_topic,
            "scan_topics": list(inputs.scan_topics or ()),
            "odom_topic": inputs.odom_topic,
            "laser_pose": None if inputs.laser_pose is None else list(inputs.laser_pose),
            "static": self.static,
            "from": self.start,
            "to": self.stop,
            "every": self.every,
            "truth": _text(self.truth),
            "truth_frame": self.truth_frame,
            "initial": self.initial,
            "initial_radius": self.initial_radius,
            "out": str(self.out),
            "threads": get_threads(),
        }


def _text(path: Path | None) -> str | None:
    return None if path is None else str(path)


def _measures(containment: Containment | None) -> dict[str, Any] | None:
    return None if containment is None else {**containment.summary(), "misses": containment.misses}
