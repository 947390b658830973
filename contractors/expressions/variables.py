"""Declaring variables."""

import re
from typing import Any

import numpy as np

from ial.contractors.expressions.expression import Expression
from ial.contractors.space import Space

_NAME = re.compile(r"([^\W\d]\w*)(?:\[(\d+)\])?")


def variables(names: str) -> Any:
    """Return the variables of a new space.

    Parameters
    ----------
    names
        Names between blanks. ``p[3]`` declares a vector of three variables, a NumPy array that can be indexed and multiplied with matrices.

    Returns
    -------
    Expression, numpy.ndarray or tuple of them
        One for each name.

    Raises
    ------
    ValueError
        If there is no name, one is no name or stands twice, or a vector has no members.

    Examples
    --------
    >>> from ial.contractors import Interval, sqrt, variables
    >>> x, y = variables("x y")
    >>> sqrt((x - 1) ** 2 + (y - 2) ** 2) == Interval(3, 4)
    sqrt(((x - 1)**2 + (y - 2)**2)) == [3.0, 4.0]
    """
    words = [_NAME.fullmatch(word) for word in names.split()] if isinstance(names, str) else []
    if not words or not all(word and int(word[2] or 1) for word in words):
        raise ValueError(f"{names!r} declares no variables; give names between blanks, such as 'x y p[3]'")
    named = [(word[1], word[2]) for word in words if word]
    if len({name for name, _ in named}) < len(named):
        raise ValueError(f"{names!r} declares a name twice")
    space = Space(tuple(part for name, size in named for part in ([f"{name}[{i}]" for i in range(int(size))] if size else [name])))
    axes = iter(range(space.dimension))
    declared: list[Any] = []
    for _, size in named:
        if size:
            vector = np.empty(int(size), dtype=object)
            vector[:] = [Expression(space, axis=next(axes)) for _ in range(int(size))]
            declared.append(vector)
        else:
            declared.append(Expression(space, axis=next(axes)))
    return declared[0] if len(declared) == 1 else tuple(declared)
