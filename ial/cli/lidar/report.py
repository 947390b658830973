"""The outcome of a run in a few lines."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ial.results.lidar.summary import Summary

_MANY = 0.1  # of the scans: in a good map with good bounds it is one in hundreds


def report(summary: "Summary", record: Mapping[str, Any]) -> Iterator[str]:
    """Yield the lines to print after a run.

    Parameters
    ----------
    summary
        The run.
    record
        What its ``summary.json`` holds.
    """
    yield _outcome(summary)
    scans, times = record["scans"], record["times"]
    counts = ", ".join(f"{count} {status}" for status, count in scans["by_status"].items())
    yield f"{scans['processed']} scans: {counts}; one hypothesis in {scans['one_hypothesis']}"
    contradicted = scans["by_status"].get("lost", 0) + scans["by_status"].get("blind", 0)
    if contradicted > _MANY * scans["processed"]:
        yield (
            f"doubtful: {contradicted} scans contradict what was known before; check that this is the map of the place, where the lidar "
            "sits, and the bounds (`ial bounds`)"
        )
    for word in ("skipped", "repaired"):
        for reason, count in scans[word].items():
            yield f"{word}: {count} × {reason}"
    if scans["uninformative"]:
        yield f"uninformative: {_scans(scans['uninformative'])} without usable beams, or with as many outliers allowed"
    if scans["vanishing"]:
        yield f"vanishing: {_scans(scans['vanishing'])} left less than the errors of the beams alone leave open; trust such answers least"
    for limit, count in scans["limited"].items():
        yield f"limited: {_scans(count)} by the limit on {limit}, with coarser answers"
    for frame in scans["lidars_without_scans"]:
        yield f"the configuration has errors of a lidar {frame}, from which no scan came; its frame is called otherwise"
    yield from measured(record["measures"])
    yield f"{1e3 * times['median_s']:.1f} ms per scan in the median, {1e3 * times['p99_s']:.1f} ms in 99 %; {times['wall_s']:.2f} s in all"


def _outcome(summary: "Summary") -> str:
    from ial.results.lidar.wording import pose_text

    last = summary.last
    if last is not None and last.pose is not None:
        return f"localized, at scan {last.index}: {pose_text(last.pose, last.hypotheses[0])}"
    if not summary.localized:
        return "never localized"
    return f"localized from scan {summary.first_localized} on, but not at the end"


def measured(measures: Mapping[str, Any] | None) -> Iterator[str]:
    """Yield the lines about a comparison with a reference, none if there is none."""
    if measures is None:
        return
    reference, holds = measures["scans_with_reference"], measures["scans_where_assumptions_hold"]
    if not reference:
        yield "no scan has a reference: its stamps do not meet those of the scans; check that both count seconds from the same start"
        return
    yield f"reference contained in {_share(measures['contained'])} of {reference} scans, in a hull in {_share(measures['contained_hull'])}"
    yield f"where the assumptions hold ({holds} scans): contained in {_share(measures['contained_when_assumptions_hold'])}"
    broken = ", ".join(f"{name.replace('_', ' ')} in {_scans(count)}" for name, count in measures["broken"].items() if count)
    if broken:
        yield f"what breaks them elsewhere: {broken}"


def _scans(count: int) -> str:
    return f"{count} scan{'s' * (count != 1)}"


def _share(share: float | None) -> str:
    """Return a share that reads 100 % only if it is all of it."""
    if share is None:
        return "none"
    return "100 %" if share == 1.0 else f"{min(100.0 * share, 99.99):.2f} %"
