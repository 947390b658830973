import importlib
from collections.abc import Iterator

import pytest

from ial.contractors import (
    Affine,
    Boxes,
    Contractor,
    Polar,
    checked_contractor,
    fixpoint,
    from_polar,
    intersection,
    lazy,
    projection,
    relaxed,
    to_polar,
    transform,
    union,
    where,
)
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.combinators.trivial_sets import EmptySet, WholeSpace
from ial.errors import RoundingModeError
from tests.contractors.shapes import separator
from tests.test_house import MODULES


def kinds(kind: type[Contractor]) -> Iterator[type[Contractor]]:
    for heir in kind.__subclasses__():
        yield heir
        yield from kinds(heir)


def test_every_contractor_of_ial_is_checked_in_the_one_place() -> None:
    for name in MODULES:
        if name.startswith(("ial.contractors.", "ial.maps.")):
            importlib.import_module(name)
    ours = {kind for kind in kinds(Contractor) if kind.__module__.startswith("ial.")}
    assert {"Annulus", "CellContractor", "Constraint", "Intersection", "Newton", "Problem"} <= {kind.__name__ for kind in ours}
    assert [kind.__name__ for kind in ours if vars(kind).get("contract") not in (None, CheckedContractor.contract)] == []
    assert [kind.__name__ for kind in ours if not issubclass(kind, CheckedContractor)] == []


def test_boxes_of_another_dimension_and_things_that_are_no_boxes_are_refused() -> None:
    with pytest.raises(ValueError, match="the boxes have 1 dimensions; Polar needs 4"):
        Polar().contract(Boxes.of([(0, 1)]))
    with pytest.raises(TypeError, match="are no boxes"):
        EmptySet(1).contract([(0, 1)])  # type: ignore[arg-type]


def test_the_rounding_mode_is_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    shape, turn = separator((0, 2), (0, 5)), Affine.rigid(0.0, 0.0, 1.0)
    made = [combine([shape, shape]) for combine in (intersection, union, lazy)]
    made += [relaxed([shape, shape], 1), fixpoint(shape), transform(shape, turn, turn.inverse), from_polar(shape), to_polar(shape)]
    made += [where(shape, (0, 2), 3), projection(shape, (0,), [(0, 1)], 0.1)]

    def refuse() -> None:
        raise RoundingModeError("the processor does not round to nearest")

    monkeypatch.setattr(checked_contractor, "check_rounding", refuse)
    for combined in [part for both in made for part in (both.inner, both.outer)] + [EmptySet(2), WholeSpace(2)]:
        with pytest.raises(RoundingModeError):
            combined.contract(Boxes.none(combined.dimension))
