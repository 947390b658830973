"""The outcome of `ial bounds` in a few tables."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.configuration.config_record import config_record
from ial.study.bounds_survey import TOTALS_M, TYPICAL_OUTLIERS, TYPICAL_SCANS

_MOST_BAD = 0.4  # of the beams of a scan; in a map of another place three in four are bad
_FEW_STEPS = 300  # of which three break what holds in 99 %


def lines(record: Mapping[str, Any], config: LocalizerConfig) -> Iterator[str]:
    """Yield the lines to print.

    Parameters
    ----------
    record
        What ``bounds.json`` holds.
    config
        The configuration that was tried.
    """
    own = "the localizer's own poses, which is circular: beams look better than they are"
    reference = own if record["circular"] else "the reference"
    yield f"{record['scans']} scans, measured against {reference}"
    yield ""
    yield "share of the scans that a bound holds: rows range_error_m + map_error_m, columns outliers"
    table = record["held"]
    yield _row("", [f"{float(each):.0%}" for each in next(iter(table.values()))])
    for total, row in table.items():
        yield _row(f"{float(total):.2f} m", [f"{share:.1%}" for share in row.values()])
    yield ""
    head = list(record["beam_error_m"])
    yield _row("quantiles", [each if each == "max" else f"{float(each):.0%}" for each in head], 26)
    yield _row("end point to obstacle, m", [f"{record['beam_error_m'][each]:.3f}" for each in head], 26)
    yield _row("bad beams of a scan", [f"{record['bad_share_of_a_scan'][each]:.1%}" for each in head], 26)
    motion = record["motion"]
    if motion["steps"]:
        yield _row("error of dx or dy, m", [f"{motion['translation_m'][each]:.3f}" for each in head], 26)
        yield _row("error of the turn, °", [f"{math.degrees(motion['rotation_rad'][each]):.2f}" for each in head], 26)
        each = motion["messages"] / motion["steps"]
        yield f"the motion bounds hold in {motion['held']:.1%} of {motion['steps']} steps of {each:.1f} odometry messages each"
    yield ""
    before, after = config_record(config), record["suggestion"]
    changed = list(_changes(before, after))
    kept = "99 % of these steps hold" if record["suggested_total_m"] is None else "99 % of these scans and of these steps hold"
    yield f"suggested, so that {kept}:" if changed else "nothing to change"
    yield from changed


def doubts(record: Mapping[str, Any]) -> Iterator[str]:
    """Yield what speaks against using the suggestion.

    Parameters
    ----------
    record
        What ``bounds.json`` holds.
    """
    if record["bad_share_of_a_scan"]["0.5"] > _MOST_BAD:
        yield (
            f"in half of the scans more than {_MOST_BAD:.0%} of the beams are bad: the reference, its frame (--truth-frame) or the map "
            "probably does not belong to this recording, and then nothing that is suggested means anything"
        )
    if record["suggested_total_m"] is None:
        most = record["held"][f"{TOTALS_M[-1]:g}"][f"{TYPICAL_OUTLIERS:g}"]
        yield (
            f"no bound that was tried leaves at most {TYPICAL_OUTLIERS:.0%} of the beams bad in {TYPICAL_SCANS:.0%} of the scans "
            f"({TOTALS_M[-1]:g} m, the largest, in {most:.1%}), so nothing is suggested for the beams: range_error_m, map_error_m and "
            "max_outliers stay as they were; see in picture.png where beams fail, and take a map of the place as it was then"
        )
    if record["steps_of"] > 1 and record["motion"]["steps"]:
        yield (
            f"the motion was measured over steps of {record['steps_of']} scans, which are long: bounds for these may be too small from one "
            "scan to the next; measure without --every, or with --truth, before you use them there"
        )
    if 0 < record["motion"]["steps"] < _FEW_STEPS:
        yield f"the motion was measured in {record['motion']['steps']} steps only, too few for what holds in 99 % of all"


def _changes(before: Mapping[str, Any], after: Mapping[str, Any], indent: str = "  ") -> Iterator[str]:
    """Yield the keys that differ as lines of YAML."""
    for key, value in after.items():
        if isinstance(value, dict):
            below = list(_changes(before[key], value, indent + "  "))
            if below:
                yield f"{indent}{key}:"
                yield from below
        elif value != before[key]:
            yield f"{indent}{key}: {value}  # was {before[key]}"


def _row(name: str, cells: list[str], width: int = 10) -> str:
    return f"{name:<{width}}" + "".join(f"{cell:>9}" for cell in cells)
