from fractions import Fraction
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot

from ial.contractors.boxes import Boxes
from ial.contractors.paving.paving import Paving


def exact_volume(boxes: Boxes) -> Fraction:
    total = Fraction(0)
    for low, high in zip(boxes.lower.tolist(), boxes.upper.tolist(), strict=True):
        volume = Fraction(1)
        for a, b in zip(low, high, strict=True):
            volume *= Fraction(b) - Fraction(a)
        total += volume
    return total


def random_boxes(random: np.random.Generator, rows: int, dimension: int) -> Boxes:
    lower = random.normal(size=(rows, dimension)) * 10.0 ** random.integers(-9, 9, (rows, dimension))
    return Boxes(lower, lower + random.exponential(size=lower.shape) * 10.0 ** random.integers(-9, 9, lower.shape))


@pytest.mark.many
@pytest.mark.parametrize("dimension", [1, 2, 3, 6])
def test_the_volume_encloses_the_exact_one_closely(dimension: int) -> None:
    for seed in range(20):
        random = np.random.default_rng(seed)
        inner, boundary = random_boxes(random, 30, dimension), random_boxes(random, 20, dimension)
        volume = Paving(boundary, inner).volume()
        low, high = exact_volume(inner), exact_volume(inner) + exact_volume(boundary)
        assert Fraction(volume.lower) <= low
        assert high <= Fraction(volume.upper)
        assert volume.lower >= float(low) * (1.0 - 1e-12)
        assert volume.upper <= float(high) * (1.0 + 1e-12)


def test_the_volume_is_exact_where_doubles_are() -> None:
    volume = Paving(Boxes.of([(0, 0.5), (0, 4)]), Boxes.of([(1, 3), (0, 4)], [(3, 4), (1, 1)])).volume()
    assert (volume.lower, volume.upper) == (8.0, 10.0)


def test_the_volume_of_nothing_is_zero_and_that_of_unbounded_boxes_is_not_bounded() -> None:
    nothing = Boxes.none(2)
    assert (Paving(nothing, nothing).volume().lower, Paving(nothing, nothing).volume().upper) == (0.0, 0.0)
    unbounded = Paving(Boxes.of([(0, np.inf), (0, 1)]), nothing).volume()
    assert (unbounded.lower, unbounded.upper) == (0.0, np.inf)
    assert Paving(Boxes.of([(-np.inf, np.inf), (1, 1)]), nothing).volume().upper == 0.0


def test_a_contractor_alone_proves_no_volume() -> None:
    volume = Paving(Boxes.of([(0, 1), (0, 1)]), Boxes.none(2)).volume()
    assert (volume.lower, volume.upper) == (0.0, 1.0)


def test_all_boxes_are_the_inner_ones_and_the_boundary() -> None:
    paving = Paving(Boxes.of([(2, 3), (0, 1)]), Boxes.of([(0, 1), (0, 1)], [(1, 2), (0, 5)]))
    assert paving.boxes.lower.tolist() == [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]
    assert paving.dimension == 2
    assert (paving.hull().lower.tolist(), paving.hull().upper.tolist()) == ([[0.0, 0.0]], [[3.0, 5.0]])
    assert Paving(Boxes.none(2), Boxes.none(2)).hull().empty.all()


def test_points_on_faces_are_contained() -> None:
    paving = Paving(Boxes.of([(2, 3), (0, 1)]), Boxes.of([(0, 1), (0, 1)]))
    assert paving.contains((1.0, 1.0))
    assert paving.contains((2.5, 0.0))
    assert not paving.contains((1.5, 0.5))
    for point in ((0.0,), (0.0, np.nan), (np.inf, 0.0), ((0.0, 0.0),)):
        with pytest.raises(ValueError, match="give 2 finite numbers"):
            paving.contains(point)  # type: ignore[arg-type]


def test_components_take_inner_and_boundary_boxes_together() -> None:
    paving = Paving(Boxes.of([(1, 2), (0, 1)], [(3, 3.2), (0, 1)]), Boxes.of([(0, 1), (0, 1)], [(-3.2, -3.05), (1, 2)]))
    assert paving.clusters().labels.tolist() == [0, 1, 0, 2]
    assert paving.clusters(circular=(0,)).labels.tolist() == [0, 1, 0, 1]


def test_a_paving_is_drawn_and_saved_as_itself(tmp_path: Path) -> None:
    mpl.use("Agg")
    paving = Paving(Boxes.of([(1, 2), (0, 1)]), Boxes.of([(0, 1), (0, 1)]), "boxes", 7)
    assert len(paving.draw().collections) == 2
    pyplot.close("all")
    paving.save(tmp_path / "one.npz")
    again = Paving.load(tmp_path / "one.npz")
    assert (again.limited, again.nodes) == ("boxes", 7)
    assert (again.inner.lower == paving.inner.lower).all()
    assert (again.boundary.upper == paving.boundary.upper).all()
