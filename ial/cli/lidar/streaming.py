"""`Streaming`: what `ial stream` was asked to do, and the doing of it. Nothing here imports what only results and recordings need."""

import os
import sys
from collections import Counter
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from ial.cli.lidar.answer_file import AnswerFile
from ial.cli.shell.ending import Ending
from ial.cli.shell.inputs import Inputs
from ial.cli.shell.terminal import remark
from ial.datasets.recording import Recording
from ial.datasets.scan_stream import ScanStream
from ial.errors import OutputError
from ial.lidar.checkpoint import Checkpoint, fingerprint
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.latencies import Latencies
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.lidar.warming import warm
from ial.results.lidar.enclosures import enclosure_line


@dataclass(frozen=True)
class Streaming:
    """One run of the localizer over a stream.

    Parameters
    ----------
    inputs
        The recording, standard input if it names none, and the map.
    config
        The configuration of the localizer.
    out
        The file to write to; standard output if there is none.
    state
        The file of the checkpoint, if one is kept.
    overwrite
        Whether a run that begins may replace the file to write to.
    """

    inputs: Inputs
    config: LocalizerConfig
    out: Path | None = None
    state: Path | None = None
    overwrite: bool = False

    def run(self) -> None:
        """Write one line for each scan until the input ends, or the process is asked to end.

        Raises
        ------
        IalError
            If an input cannot be used or the lines cannot be written.
        """
        times = Latencies()
        statuses: Counter[str] = Counter()
        vanishing = 0
        with ExitStack() as stack:
            ending = stack.enter_context(Ending())
            localizer = Localizer(self.inputs.grid(), config=self.config)
            checkpoint = None if self.state is None else Checkpoint.load(self.state, localizer)
            if checkpoint is not None:
                localizer.resume(checkpoint.poses, same_start=True)
            out = self._out(checkpoint)
            warm(self.config)
            mine = fingerprint(localizer)
            if checkpoint is not None:
                remark("note", f"goes on after scan {checkpoint.mark.index}, as {self.state} says", "cyan")
            if out is not None:
                stack.enter_context(out)
            source = self._source(ending)
            for step, estimate in localize(source, localizer, after=None if checkpoint is None else checkpoint.mark):
                line = enclosure_line(step, estimate, timed=False)
                if out is None:  # the line comes first: after a kill it may come twice, but is never lost
                    _print(line)
                if self.state is not None:
                    Checkpoint(step.mark, localizer.poses, None if out is None else out.before(line), mine).save(self.state)
                if out is not None:  # the state comes first: after a kill it knows what is missing
                    out.append(line.encode())
                times.add(estimate.elapsed_s)
                statuses[estimate.status] += 1
                vanishing += estimate.vanishing
                if ending.wanted:
                    break
        _close(source, statuses, vanishing, times)

    def _source(self, ending: Ending) -> Recording:
        if self.inputs.recording is not None:
            return self.inputs.source()
        return ScanStream(ending.lines(sys.stdin.buffer), "standard input", self.inputs.mounting)

    def _out(self, checkpoint: Checkpoint | None) -> AnswerFile | None:
        """Return the file to write to, which is the one that the checkpoint belongs to; None for standard output."""
        known = None if checkpoint is None else checkpoint.output
        if checkpoint is not None and (known is None) != (self.out is None):
            belongs = "standard output" if known is None else known.path
            raise OutputError(
                f"{self.state}: this state belongs to a run that wrote to {belongs}; go on there, or begin anew with another --state"
            )
        return None if self.out is None else AnswerFile(self.out, known, self.overwrite)


def _print(line: str) -> None:
    try:
        sys.stdout.buffer.write(line.encode())
        sys.stdout.buffer.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what closes at exit shall not fail again
        raise OutputError("nobody reads the lines any more; the state, if one is kept, is that before this line") from None
    except OSError as error:
        raise OutputError(f"standard output: cannot be written ({error.strerror or error}); is the disk full?") from None


def _close(source: Recording, statuses: Counter[str], vanishing: int, times: Latencies) -> None:
    """Say on stderr what came in, and how long it took."""
    for counts, kind in ((source.skipped, "skipped"), (source.repaired, "repaired")):
        for reason, count in counts.items():
            remark(kind, f"{count} × {reason}", "yellow")
    scans = sum(statuses.values())
    words = ", ".join(f"{count} {status}" for status, count in statuses.most_common())
    words += f"; {vanishing} of them vanishing" if vanishing else ""
    remark("note", f"{scans} scans: {words}; {times}" if scans else "no scan came", "cyan")
