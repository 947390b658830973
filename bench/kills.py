"""`ial stream` killed again and again: its answers are those of an uninterrupted run, and every other file is left alone."""

import io
import json
import os
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from onboard import LOG, MAP
from report import Report, options

from ial.datasets.conversion import convert_to_lines
from ial.datasets.opening import open_recording
from ial.lidar.output_end import OutputEnd

ABOUT = """\
`ial stream --state --out`, fed from its beginning at each start, and ended by SIGKILL: *at a touch*, when it is about to open, rename or
remove a file of its own for the nth time (before the first state, between that and the first line, while a state is written), or *at a
moment*, by the clock. Where a kill has left a whole last line, every second time a random part of it is cut off, as a kill within the write
would have left it. Each round ends with a run to the end, whose file is compared with that of an uninterrupted run. Meanwhile each round
tries to make the state go on in files that are not its own; *changed* counts what was no longer as before."""
START = "from ial.cli.entry import main; main()"
KILLER = f"""
import os, signal, sys
left, own = int(sys.argv.pop(1)), {{'out.jsonl', 'state', '.state.ial-part'}}
def killer(event, arguments):
    global left
    if event in ('open', 'os.rename', 'os.remove'):
        names = {{os.path.basename(os.fsdecode(each)) for each in arguments[:2] if isinstance(each, (str, bytes, os.PathLike))}}
        left -= bool(names & own)
        if not left:
            os.kill(os.getpid(), signal.SIGKILL)
sys.addaudithook(killer)
{START}"""


@dataclass
class Round:
    """A folder in which one run is killed several times.

    Parameters
    ----------
    folder
        An empty folder.
    fed
        The file with the input.
    whole
        What an uninterrupted run writes.
    chance
        Where random numbers come from.
    """

    folder: Path
    fed: Path
    whole: bytes
    chance: random.Random
    counts: Counter[str] = field(default_factory=Counter)

    def __post_init__(self) -> None:
        self.folder.mkdir()
        self.out, self.state = self.folder / "out.jsonl", self.folder / "state"
        self.foreign = {self.folder / name: content for name, content in self._foreign().items()}
        for path, content in self.foreign.items():
            path.write_bytes(content)

    def _foreign(self) -> dict[str, bytes]:
        first = self.whole.splitlines(keepends=True)[0]
        return {
            "notes.txt": b"x" * 1000,
            "recording.jsonl": self.fed.read_bytes(),
            "other.jsonl": self.whole[7:],
            "first.jsonl": first[:-9],
        }

    def start(self, *before: str, out: Path | None = None) -> "subprocess.Popen[bytes]":
        """Start a run on one core."""
        core = {max(os.sched_getaffinity(0))}
        command = [sys.executable, "-c", *(before or (START,)), "stream", "--map", str(Path(os.environ["IAL_DATA"]) / MAP)]
        with self.fed.open("rb") as source:
            return subprocess.Popen(
                [*command, "--out", str(out or self.out), "--state", str(self.state)],
                stdin=source,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                preexec_fn=lambda: os.sched_setaffinity(0, core),
            )

    def kill_at_touch(self, touch: int) -> None:
        """Kill a run at its nth touch of its files."""
        running = self.start(KILLER, str(touch))
        running.wait()
        self.counts["at a touch"] += running.returncode == -9
        self._tear()

    def kill_at_moment(self) -> None:
        """Kill a run at a random moment: while it starts, or at some later line."""
        running = self.start()
        goal = self._written() + self.chance.randrange(1, len(self.whole) // 8)
        until = time.monotonic() + self.chance.choice((0.3, 1.0, 3.0, 30.0))
        while time.monotonic() < until and self._written() < goal and running.poll() is None:
            time.sleep(0.0005)
        time.sleep(self.chance.uniform(0.0, 0.01))
        running.kill()
        running.wait()
        self.counts["at a moment"] += running.returncode == -9
        self._tear()

    def try_others(self) -> None:
        """Let the state go on in files of others; each must be refused."""
        for path in (*self.foreign, self.state):
            self.counts["refused"] += self.start(out=path).wait() == 2

    def finish(self) -> None:
        """Run to the end, and compare."""
        assert self.start().wait() == 0
        self.counts["the same, byte for byte" if self.out.read_bytes() == self.whole else "✗ different"] += 1
        self.counts["changed"] += sum(path.read_bytes() != content for path, content in self.foreign.items())
        self.counts["left behind"] += len({*self.folder.iterdir()} - {self.out, self.state, *self.foreign})

    def _written(self) -> int:
        return self.out.stat().st_size if self.out.exists() else 0

    def _tear(self) -> None:
        """Cut a part of the last line off, if it is the one that the state says was about to be written."""
        if not self.state.exists() or not self.out.exists() or self.chance.random() < 0.5:
            return
        with np.load(self.state) as content:
            known = OutputEnd(**json.loads(content["about"].tobytes())["output"])
        if self._written() == known.length + len(known.line.encode()):
            os.truncate(self.out, known.length + self.chance.randrange(len(known.line.encode())))
            self.counts["torn"] += 1


def _first(scans: int) -> Iterator[bytes]:
    """Yield the lines of a recording up to its nth scan."""
    content = io.StringIO()
    convert_to_lines(open_recording(Path(os.environ["IAL_DATA"]) / LOG), content)
    for line in content.getvalue().encode().splitlines(keepends=True):
        scans -= line.startswith(b'{"scan"')
        if scans < 0:
            return
        yield line


def rounds(kills: int, scans: int, each: int, folder: Path) -> Iterator[Iterator[object]]:
    """Yield the lines of the table."""
    fed, whole = folder / "fed.jsonl", folder / "whole.jsonl"
    fed.write_bytes(b"".join(_first(scans)))
    first = Round(folder / "whole", fed, b"\n", random.Random(0))
    assert first.start(out=whole).wait() == 0
    total: Counter[str] = Counter()
    names = ("at a touch", "at a moment", "torn", "the same, byte for byte", "✗ different", "refused", "changed", "left behind")
    number = 0
    while total["at a touch"] + total["at a moment"] < kills:
        number += 1
        one = Round(folder / str(number), fed, whole.read_bytes(), random.Random(number))
        one.kill_at_touch(number)  # the first dozen lie around the first state and the first line
        for kill in range(each - 1):
            if kill % 3 == 2:
                one.kill_at_touch(one.chance.randrange(1, 30))
            else:
                one.kill_at_moment()
        if one.state.exists():
            one.try_others()
        one.finish()
        total += one.counts
        yield iter((number, *(one.counts[name] for name in names)))
    yield iter(("all", *(total[name] for name in names)))


def main() -> None:
    """Kill, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--kills", type=int, default=70)
    parser.add_argument("--scans", type=int, default=200, help="of the recording")
    parser.add_argument("--each", type=int, default=7, help="kills of one run")
    chosen = parser.parse_args()
    report = Report("Kills", ABOUT)
    head = "round|kills at a touch|at a moment|lines torn|runs the same, byte for byte|different|refused|changed|left behind"
    with tempfile.TemporaryDirectory() as folder:
        report.table(head.split("|"), rounds(chosen.kills, chosen.scans, chosen.each, Path(folder)))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
