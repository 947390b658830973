"""A million poses that must not be lost: random drives through all that a robot may undergo, and an oracle that is not the search."""

import sys
import time
from pathlib import Path

from report import Report, options

sys.path.append(str(Path(__file__).parents[1]))  # drives and oracle are those of the tests

from tests.lidar.pose_fuzzer import ALL_MODES, Tally, fuzz

ABOUT = """\
Random small maps of any resolution and turn, lidars, errors as large as their bounds allow, bad beams, and a localizer with a random
configuration. At each scan poses are tried around the truth, anywhere, at the border of the answer, where the odometry leads, and on from
those that hold as far as they do. A pose counts as *tried* if by the definitions of docs/guarantee.md it certainly has at most as many bad
beams as the answer prints, lies in the domain, and is reached by a motion within its box from the set before; so it must lie in a box of
the answer, in the hull of a hypothesis, and within the radius. *Lost* are those that do not. Seconds are those of the processor."""

SHOWN = 5
RARE = {"sections": 20, "extreme": 2}  # a drive in so many rounds: these are slow


def row(mode: str, tally: Tally) -> list[object]:
    """Return the cells of a line."""
    statuses = ", ".join(f"{count} {status}" for status, count in tally.statuses.most_common())
    return [mode, tally.drives, tally.scans, statuses or "–", f"{tally.tried:,}", len(tally.losses), f"{tally.seconds:.0f}"]


def main() -> None:
    """Try, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--poses", type=int, metavar="N", default=1_000_000, help="how many consistent poses are tried at least")
    parser.add_argument("--mode", action="append", choices=ALL_MODES, help="only this; may be repeated")
    parser.add_argument("--seed", type=int, default=0, help="the first drive of each mode")
    parser.add_argument("--drives", type=int, metavar="N", help="end after so many drives of each mode")
    parser.add_argument("--effort", type=int, default=300, help="candidates of each kind at a scan")
    chosen = parser.parse_args()
    tallies = {mode: Tally() for mode in chosen.mode or ALL_MODES}
    begun, number = time.perf_counter(), 0
    while sum(each.tried for each in tallies.values()) < chosen.poses and (chosen.drives is None or number < chosen.drives):
        for mode, tally in tallies.items():
            if number % RARE.get(mode, 1) == 0:
                fuzz(mode, chosen.seed + number, tally, chosen.effort)
        number += 1
    report = Report("Poses that must not be lost", ABOUT)
    report.table(
        ["", "drives", "scans", "statuses", "consistent poses tried", "lost", "s"], (row(mode, tally) for mode, tally in tallies.items())
    )
    wrong = [each for tally in tallies.values() for each in tally.wrong]
    losses = [loss for tally in tallies.values() for loss in tally.losses]
    tried, seconds = sum(each.tried for each in tallies.values()), time.perf_counter() - begun
    report.say(f"**{tried:,} tried, {len(losses)} lost**, in {seconds:.0f} s. Wrong numbers of used or allowed beams: {len(wrong)}.\n")
    for each in wrong[:SHOWN]:
        report.say(f"- {each}")
    drives = {(loss.mode, loss.seed): loss for loss in losses}
    for loss in list(drives.values())[:SHOWN]:
        report.say(f"- `--mode {loss.mode} --seed {loss.seed} --drives 1`: {loss}")
    report.write(chosen.out)
    sys.exit(bool(losses or wrong))


if __name__ == "__main__":
    main()
