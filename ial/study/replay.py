"""`replay`: a recording at the speed at which it was recorded, to see whether a machine keeps up."""

import time
from dataclasses import dataclass

from ial.datasets.recording import Recording, steps
from ial.lidar.latencies import Latencies
from ial.lidar.localizer import Localizer


@dataclass(frozen=True)
class Replay:
    """How a machine kept up.

    Parameters
    ----------
    scans
        How many were localized.
    recorded_s
        Time between the first and the last of them in the recording.
    latencies
        From the moment a scan was due to its answer: waiting for the scans before included.
    late
        How many answers came after the next scan was due.
    limited
        How many answers were made coarser by a limit.
    """

    scans: int
    recorded_s: float
    latencies: Latencies
    late: int
    limited: int


def replay(recording: Recording, localizer: Localizer, speed: float | None = 1.0) -> Replay:
    """Localize a recording as it would arrive.

    Parameters
    ----------
    recording
        What to replay.
    localizer
        What localizes.
    speed
        How much faster than recorded; None for as fast as the machine can: each scan is then due when the one before is answered.

    Raises
    ------
    RecordingError
        If the recording cannot be read.
    """
    latencies = Latencies()
    late = limited = scans = 0
    first = last = 0
    answered = begun = time.monotonic()
    for step in steps(recording, localizer.config.bounds.motion, no_return=localizer.config.free_space.no_return):
        if not scans:
            first, begun = step.stamp_ns, time.monotonic()
        due = time.monotonic() if speed is None else begun + 1e-9 * (step.stamp_ns - first) / speed
        late += bool(scans) and speed is not None and answered > due
        time.sleep(max(0.0, due - time.monotonic()))
        limited += bool(localizer.update(step.motion, step.scan).limited)
        answered = time.monotonic()
        latencies.add(answered - due)
        last = step.stamp_ns
        scans += 1
    return Replay(scans, 1e-9 * (last - first), latencies, late, limited)
