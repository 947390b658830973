from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ial.contractors import Boxes, Separator, fixpoint, intersection, lazy, negation, relaxed, union
from ial.contractors.combinators.lazy_intersection import LazyIntersection
from tests.contractors.shapes import Inside, Mask, Outside, inside, is_well_formed, lattice, random_boxes, same, separator

POINTS = lattice(2)
BOXES = random_boxes(60, 2, seed=1)


@dataclass
class Set:
    """A set, and which points may be kept by each contractor: the members and the boundary; the others and the boundary."""

    separator: Separator
    kept_outer: Mask
    kept_inner: Mask


def leaf(bounds: list[tuple[int, int]]) -> Set:
    sides = [(min(pair), max(pair)) for pair in bounds]
    return Set(separator(*sides), Inside(*sides).holds(POINTS), Outside(*sides).holds(POINTS))


def at_least(count: int, masks: list[Mask]) -> Mask:
    return np.asarray(np.sum(masks, axis=0) >= count)


def of_many(combine: Callable[[list[Separator]], Separator], parts: list[Set], outliers: int) -> Set:
    made = combine([part.separator for part in parts])
    outer = at_least(len(parts) - outliers, [part.kept_outer for part in parts])
    return Set(made, outer, at_least(outliers + 1, [part.kept_inner for part in parts]))


def combined(parts: list[Set], kind: str, outliers: int) -> Set:
    if kind == "and":
        return of_many(intersection, parts, 0)
    if kind == "lazy":
        return of_many(lazy, parts, 0)
    if kind == "or":
        return of_many(union, parts, len(parts) - 1)
    if kind == "not":
        return Set(~parts[0].separator, parts[0].kept_inner, parts[0].kept_outer)
    if kind == "fixpoint":
        return Set(fixpoint(parts[0].separator), parts[0].kept_outer, parts[0].kept_inner)
    return of_many(lambda members: relaxed(members, outliers, exact=kind == "exact"), parts, outliers)


kinds = st.sampled_from(["and", "or", "not", "lazy", "fixpoint", "relaxed", "exact"])
leaves = st.builds(leaf, st.lists(st.tuples(st.integers(0, 7), st.integers(0, 7)), min_size=2, max_size=2))


def branch(parts: st.SearchStrategy[Set]) -> st.SearchStrategy[Set]:
    return st.builds(combined, st.lists(parts, min_size=1, max_size=4), kinds, st.integers(0, 5))


trees = st.recursive(leaves, branch, max_leaves=8)


@pytest.mark.slow
@given(trees)
@settings(max_examples=80)
def test_no_combination_removes_a_point_of_the_wrong_side(tree: Set) -> None:
    inner, outer = tree.separator.separate(BOXES)
    there = inside(BOXES, POINTS)
    assert inside(outer, POINTS)[there & tree.kept_outer].all()
    assert inside(inner, POINTS)[there & tree.kept_inner].all()
    assert is_well_formed(inner, BOXES)
    assert is_well_formed(outer, BOXES)


@pytest.mark.slow
@given(trees)
@settings(max_examples=80)
def test_every_combination_decides_every_point_that_is_not_on_the_boundary(tree: Set) -> None:
    inner, outer = tree.separator.separate(Boxes(POINTS, POINTS))
    assert (~outer.empty == tree.kept_outer).all()
    assert (~inner.empty == tree.kept_inner).all()


A, B = separator((0, 4), (1, 6)), separator((2, 7), (0, 3))


def equal(a: Separator, b: Separator) -> bool:
    return all(same(x, y) for x, y in zip(a.separate(BOXES), b.separate(BOXES), strict=True))


def test_the_algebra_is_that_of_sets() -> None:
    assert equal(~(A & B), ~A | ~B)
    assert equal(~(A | B), ~A & ~B)
    assert equal(~~A, A)
    assert equal(negation(A), ~A)
    assert equal(~relaxed([A, B, A], 1), relaxed([~A, ~B, ~A], 1))
    assert not equal(A, ~A)
    assert equal(A & B, intersection([A, B]))
    assert equal(A | B, union([A, B]))


def test_as_many_outliers_as_separators_make_the_whole_space() -> None:
    inner, outer = relaxed([A, B], 2).separate(BOXES)
    assert same(outer, BOXES)
    assert inner.empty.all()


def test_of_separators_the_outer_contractors_are_ordered() -> None:
    made = lazy([separator((0, 6), (0, 7)), separator((3, 4), (3, 4))])
    assert isinstance(made.outer, LazyIntersection)


@pytest.mark.parametrize("combine", [intersection, union, lazy, lambda members: relaxed(members, 1)])
def test_contractors_and_separators_do_not_mix(combine: Callable[[list[object]], object]) -> None:
    for mixture in ([A, Inside((0, 1), (0, 1))], [Inside((0, 1), (0, 1)), A]):
        with pytest.raises(TypeError, match=r"Separator is not a contractor, .* Separators combine with separators only"):
            combine(mixture)
