"""A localizer run over a recording."""

from collections.abc import Iterator

from ial.datasets.mark import Mark
from ial.datasets.recording import Recording, Step, steps
from ial.lidar.estimate import Estimate
from ial.lidar.localizer import Localizer


def localize(
    recording: Recording,
    localizer: Localizer,
    *,
    start: int = 0,
    stop: int | None = None,
    every: int = 1,
    static: bool = False,
    after: Mark | None = None,
) -> Iterator[tuple[Step, Estimate]]:
    """Yield each processed scan with its estimate.

    Parameters
    ----------
    recording
        Where the scans and the odometry come from.
    localizer
        What localizes; its bounds of motion are used.
    start, stop, every
        Which raw scans to process, like a slice; the motion in between is added up.
    static
        Localize each scan by itself.
    after
        Go on after this scan, with a localizer that has been there.

    Raises
    ------
    RecordingError
        If the recording cannot be read, or has no usable scan.
    """
    config = localizer.config
    for step in steps(recording, config.bounds.motion, start, stop, every, after, no_return=config.free_space.no_return):
        yield step, localizer.locate(step.scan) if static else localizer.update(step.motion, step.scan)
