"""The scans of several lidars in one order: that of their stamps."""

from collections import deque
from collections.abc import Collection, Iterator

from ial.datasets.odometry_buffer import MAX_GAP_NS
from ial.datasets.reader import Record


def in_order_of_stamps(records: Iterator[tuple[str, Record]], sources: Collection[str]) -> Iterator[Record]:
    """Yield the records of several sources by their stamps; those of one source keep their order.

    A record waits until every other source has one that is not older, but not for a source that is more than 0.5 s behind.

    Parameters
    ----------
    records
        Pairs of a source and a record with a stamp.
    sources
        All sources.
    """
    waiting: dict[str, deque[tuple[int, Record]]] = {source: deque() for source in sources}
    latest: int | None = None
    for source, record in records:
        if record.stamp_ns is None:
            yield record
            continue
        waiting[source].append((record.stamp_ns, record))
        latest = record.stamp_ns if latest is None else max(latest, record.stamp_ns)
        while any(waiting.values()) and (all(waiting.values()) or _earliest(waiting)[0][0] < latest - MAX_GAP_NS):
            yield _earliest(waiting).popleft()[1]
    while any(waiting.values()):
        yield _earliest(waiting).popleft()[1]


def _earliest(waiting: dict[str, deque[tuple[int, Record]]]) -> deque[tuple[int, Record]]:
    """Return the queue whose first record has the smallest stamp."""
    return min((queue for queue in waiting.values() if queue), key=lambda queue: queue[0][0])
