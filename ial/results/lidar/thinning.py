"""Fewer of what has become too much to keep."""

from collections.abc import Callable
from typing import TypeVar

MOST = 20_000
"""More than the pixels along the side of a picture."""

Item = TypeVar("Item")


def thinned(items: list[Item], kind: Callable[[Item], object] = lambda item: None) -> list[Item]:
    """Return a sequence as it is up to `MOST` items; of a longer one every second item, and those where the kind changes.

    Parameters
    ----------
    items
        The sequence. Its first and its last item stay.
    kind
        What to keep the changes of. Where it changes so often that most items would stay, only every second one does.
    """
    if len(items) <= MOST:
        return items
    kinds = [kind(item) for item in items]
    even = [number % 2 == 0 for number in range(len(items))]
    even[-1] = True
    telling = [stays or (number > 0 and kinds[number - 1] != kinds[number]) for number, stays in enumerate(even)]
    chosen = telling if 4 * sum(telling) <= 3 * MOST else even
    return [item for item, stays in zip(items, chosen, strict=True) if stays]
