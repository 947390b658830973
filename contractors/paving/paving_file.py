"""Pavings on disk."""

from pathlib import Path
from typing import cast, get_args

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.paving.limits import Limit
from ial.errors import PavingError
from ial.whole_file import whole_files

_FORMAT = "ial paving 1"


def write(path: str | Path, inner: Boxes, boundary: Boxes, limited: Limit, nodes: int) -> None:
    """Write a paving as a compressed NumPy archive (npz).

    It is written under a temporary name and renamed, so that a file of that name is whole, and is replaced only by a whole one. Bounds are
    kept bit for bit.

    Parameters
    ----------
    path
        The file, whose name is not changed.
    inner, boundary, limited, nodes
        As in `ial.contractors.paving.paving.Paving`.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    with whole_files(path, what="the paving") as (lent,), lent.open("wb") as file:
        np.savez_compressed(
            file,
            format=_FORMAT,
            limited=limited,
            nodes=nodes,
            inner_lower=inner.lower,
            inner_upper=inner.upper,
            boundary_lower=boundary.lower,
            boundary_upper=boundary.upper,
        )


def read(path: str | Path) -> tuple[Boxes, Boxes, Limit, int]:
    """Read what `write` has written.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    tuple
        The inner boxes, the boundary, what limited the search, and the number of nodes.

    Raises
    ------
    PavingError
        If there is no such file, or if it is damaged or something else.
    """
    try:
        with Path(path).open("rb") as file, np.load(file, allow_pickle=False) as archive:
            stated = str(archive["format"])
            inner, boundary = (Boxes(archive[f"{part}_lower"], archive[f"{part}_upper"]) for part in ("inner", "boundary"))
            limited, nodes = str(archive["limited"]), int(archive["nodes"])
    except FileNotFoundError:
        raise PavingError(f"{path}: there is no such file; give a file that Paving.save has written") from None
    except Exception as error:  # a damaged archive makes its readers raise nearly anything
        raise PavingError(f"{path}: the file is damaged or no paving ({error}); give a file that Paving.save has written") from None
    if stated != _FORMAT:
        raise PavingError(f"{path}: the file is {stated!r}, not {_FORMAT!r}; save the paving again with this version of ial")
    _check(path, inner, boundary, limited)
    return inner, boundary, cast(Limit, limited), nodes


def _check(path: str | Path, inner: Boxes, boundary: Boxes, limited: str) -> None:
    if inner.dimension != boundary.dimension or inner.empty.any() or boundary.empty.any() or limited not in get_args(Limit):
        raise PavingError(f"{path}: the boxes of the paving do not fit together; save it again")
