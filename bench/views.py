"""Whether the planner of two stages ends as an exhaustive search over views says it must."""

import sys
from collections import Counter
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from report import Report, options

sys.path.append(str(Path(__file__).parents[1]))  # robots, plans and oracle are those of the tests

from ial.maps.grids.alike_plans import alike_plan, plan_names
from ial.maps.grids.occupancy_grid import OccupancyGrid
from tests.active.closed_plans import CLOSED_PLANS
from tests.active.judged_views import GAVE_UP, judged_run
from tests.active.views_oracle import VIEW_M, WAY_M

ABOUT = f"""\
Random starts, each with errors of its own; every other robot has errors at their bounds. The oracle looks from all places of a lattice,
{VIEW_M:g} m apart along the first heading and across it, that can be reached over places {WAY_M:g} m apart wherever the robot may be
after its first look. *Localizable*: views tell the truth from all else, but its images under a symmetry of the map, though all that is
unsure be against it; *not*: there is left an exact copy of the true pose though all that is unsure be in its favour; *undecided*:
neither. A planner that ends `exhausted` where it is localizable, or otherwise where it is not, disagrees, and so does one that comes to no
end. A bench that ends has found the truth in the set after every drive, and nothing touched."""
VERDICTS = ("localizable", "not", "undecided")
ENDS = ("localized", "symmetric", "exhausted", GAVE_UP)
PLANS: dict[str, Callable[[], OccupancyGrid]] = {**{name: partial(alike_plan, name) for name in plan_names()}, **CLOSED_PLANS}


def rows(names: list[str], seeds: range, most_drives: int, differ: list[str]) -> Iterator[tuple[object, ...]]:
    """Yield, for each plan, what the oracle says and how the planner ends; and take note of disagreements."""
    for name in names:
        grid, verdicts, ends, drives = PLANS[name](), Counter[str](), Counter[str](), 0
        for seed in seeds:
            run = judged_run(grid, seed, most_drives)
            verdicts[run.verdict] += 1
            ends[run.end] += 1
            drives += run.drives
            if run.disagrees:
                differ.append(f"{name}, seed {seed}: {run.verdict}, but {run.end} after {run.drives} drives")
        yield name, len(seeds), *(verdicts[each] for each in VERDICTS), *(ends[each] for each in ENDS), f"{drives / len(seeds):.1f}"


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("plans", nargs="*", metavar="PLAN", help=f"which plans, of {', '.join(PLANS)}; all of them by default")
    parser.add_argument("--starts", type=int, default=28, metavar="N", help="how many in each plan")
    parser.add_argument("--seed", type=int, default=0, metavar="S", help="of the first")
    parser.add_argument("--drives", type=int, default=150, metavar="N", help="after so many a planner gives up")
    chosen = parser.parse_args()
    if unknown := set(chosen.plans) - PLANS.keys():
        parser.error(f"there is no plan {', '.join(sorted(unknown))}; give some of {', '.join(PLANS)}")
    if chosen.starts < 1:
        parser.error("give one start at least")
    report, differ = Report("Views that tell, and the planner of two stages", ABOUT), list[str]()
    head = ("plan", "starts", *VERDICTS, *ENDS, "drives, mean")
    report.table(head, rows(chosen.plans or list(PLANS), range(chosen.seed, chosen.seed + chosen.starts), chosen.drives, differ))
    report.say(f"Disagreements: {len(differ)}." + "".join(f"\n- {each}" for each in differ))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
