import itertools
import math

import mpmath
import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.intervals.angle import contains_angle
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.contractors.paving.clusters import Clusters, cluster
from tests.cases import cases

mpmath.mp.prec = 200
TURN = 2 * mpmath.pi
PI_DOWN = math.pi  # the double below π


def touch(boxes: Boxes, a: int, b: int) -> bool:
    """Return whether two closed boxes share a point, headings modulo 2π, in exact arithmetic."""
    lower, upper = boxes.lower, boxes.upper
    if any(lower[a, axis] > upper[b, axis] or lower[b, axis] > upper[a, axis] for axis in range(2)):
        return False
    al, au, bl, bu = (mpmath.mpf(float(value)) for value in (lower[a, 2], upper[a, 2], lower[b, 2], upper[b, 2]))
    return any(al <= bu + turns * TURN and bl + turns * TURN <= au for turns in range(-2, 3))


def cluster_poses(boxes: Boxes) -> Clusters:
    return cluster(boxes, circular=(2,))


def twin(boxes: Boxes) -> list[int]:
    """Return the component of each box by looking at all pairs."""
    labels = list(range(len(boxes)))
    for a, b in itertools.combinations(range(len(boxes)), 2):
        if labels[a] != labels[b] and touch(boxes, a, b):
            low, high = sorted((labels[a], labels[b]))
            labels = [low if label == high else label for label in labels]
    firsts = sorted(set(labels), key=labels.index)
    return [firsts.index(label) for label in labels]


def random_boxes(random: np.random.Generator) -> Boxes:
    """Return boxes on a dyadic lattice, so that faces, edges and corners touch exactly; no dyadic heading touches another a turn away."""
    rows = int(random.integers(1, 60))
    spread = float(random.choice([3.0, 6.0, 20.0]))
    lower = np.floor(random.uniform(-spread, spread, (rows, 3)) * 2.0) / 2.0
    lower[:, 2] = np.round(random.uniform(-3.125, 3.125, rows) * 8.0) / 8.0
    widths = random.choice([0.0, 0.125, 0.5, 1.0], (rows, 3))
    if random.integers(3) == 0:
        widths[random.integers(rows)] = random.uniform(0.0, 6.0, 3)  # sizes differ widely
    if random.integers(4) == 0:
        lower[0, 2], widths[0, 2] = -PI_UPPER, 2.0 * PI_UPPER
    if random.integers(2):
        lower[:, 2] = random.uniform(-math.pi, math.pi, rows)
    moved = Boxes(lower, lower + widths)
    full = moved.width()[:, 2] >= 2.0 * math.pi
    moved.lower[full, 2], moved.upper[full, 2] = -PI_UPPER, PI_UPPER
    return moved


def hulls_hold(boxes: Boxes, clusters: Clusters) -> None:
    for label in range(len(clusters)):
        rows = np.flatnonzero(clusters.labels == label)
        hull = (clusters.hulls.lower[label], clusters.hulls.upper[label])
        assert (hull[0][:2] == boxes.lower[rows, :2].min(axis=0)).all()
        assert (hull[1][:2] == boxes.upper[rows, :2].max(axis=0)).all()
        low, high = mpmath.mpf(float(hull[0][2])), mpmath.mpf(float(hull[1][2]))
        assert -PI_UPPER <= hull[0][2] <= PI_UPPER
        assert high >= low
        if high - low < TURN:
            for row in rows:
                one = (mpmath.mpf(float(boxes.lower[row, 2])), mpmath.mpf(float(boxes.upper[row, 2])))
                assert any(low <= one[0] + k * TURN and one[1] + k * TURN <= high for k in (-1, 0, 1)), (hull, one)
        assert float(high - low) <= shortest_arc(boxes[rows]) + 1e-9


def shortest_arc(boxes: Boxes) -> float:
    """Return the width of the shortest arc around all headings: it begins where some box begins."""
    best = 2.0 * PI_UPPER
    for opens in boxes.lower[:, 2]:
        ahead = np.mod(boxes.lower[:, 2] - opens, 2.0 * math.pi)
        ahead[ahead > 2.0 * math.pi - 1e-9] = 0.0
        best = min(best, float((ahead + boxes.width()[:, 2]).max()))
    return best


@pytest.mark.slow
def test_components_and_hulls_equal_those_of_all_pairs() -> None:
    several = 0
    for seed in range(cases(120, 6)):
        boxes = random_boxes(np.random.default_rng(seed))
        clusters = cluster_poses(boxes)
        assert clusters.labels.tolist() == twin(boxes), seed
        assert len(clusters) == clusters.labels.max() + 1
        hulls_hold(boxes, clusters)
        several += 1 < len(clusters) < len(boxes)
    assert several > cases(50, 2)


CELL = [(0.0, 1.0), (0.0, 1.0), (0.0, 0.5)]


@pytest.mark.parametrize("corner", list(itertools.product([-1.0, 0.0, 1.0], [-1.0, 0.0, 1.0], [-0.5, 0.0, 0.5])))
def test_a_shared_corner_is_enough_and_the_next_double_is_not(corner: tuple[float, float, float]) -> None:
    other = [(low + by, high + by) for (low, high), by in zip(CELL, corner, strict=True)]
    assert len(cluster_poses(Boxes.of(CELL, other))) == 1
    for axis in range(3):
        if corner[axis]:
            low, high = other[axis]
            apart = list(other)
            apart[axis] = (math.nextafter(low, math.inf), high) if corner[axis] > 0 else (low, math.nextafter(high, -math.inf))
            assert len(cluster_poses(Boxes.of(CELL, apart))) == 2


@pytest.mark.parametrize(
    ("one", "other", "together"),
    [
        ((3.0, PI_UPPER), (-PI_UPPER, -3.0), True),
        ((3.0, 3.5), (-3.0, -2.0), True),  # 3.5 − 2π is about −2.78
        ((3.0, 3.5), (-2.75, -2.0), False),
        ((3.0, 3.25), (-PI_UPPER, -3.1), True),
        ((3.0, PI_DOWN - 1e-9), (-PI_DOWN + 1e-9, -3.0), False),
        ((-PI_UPPER, PI_UPPER), (1.0, 1.0), True),
        ((-PI_UPPER, PI_UPPER), (3.0, 4.0), True),
        ((-PI_UPPER, PI_UPPER), (-PI_UPPER, PI_UPPER), True),
        ((-3.125, -3.125), (3.0, 3.25), True),  # 3.25 − 2π is about −3.03
        ((-3.125, -3.125), (3.0, 3.125), False),
    ],
)
def test_headings_touch_across_the_cut_of_the_circle(one: tuple[float, float], other: tuple[float, float], together: bool) -> None:
    place = [(0.0, 1.0), (0.0, 1.0)]
    for first, second in ((one, other), (other, one)):
        boxes = Boxes.of([*place, first], [*place, second])
        assert len(cluster_poses(boxes)) == (1 if together else 2)
        hulls_hold(boxes, cluster_poses(boxes))


def test_the_hull_of_headings_around_the_cut_crosses_it() -> None:
    place = [(0.0, 1.0), (0.0, 1.0)]
    clusters = cluster_poses(Boxes.of([*place, (-PI_UPPER, -3.0)], [*place, (3.0, PI_UPPER)], [*place, (-3.0, -2.5)], [*place, (2.5, 3.0)]))
    assert len(clusters) == 1
    assert clusters.hulls.lower[0, 2] == 2.5
    assert clusters.hulls.upper[0, 2] == pytest.approx(2.0 * math.pi - 2.5, abs=1e-12)
    assert all(contains_angle(clusters.hulls.lower[0, 2], clusters.hulls.upper[0, 2], angle) for angle in (2.5, -2.5, math.pi, -math.pi))


def test_a_ring_of_headings_has_the_whole_circle_as_its_hull() -> None:
    edges = np.linspace(-math.pi, math.pi, 17)
    edges[0], edges[-1] = -PI_UPPER, PI_UPPER
    boxes = Boxes(np.column_stack([np.zeros((16, 2)), edges[:-1]]), np.column_stack([np.ones((16, 2)), edges[1:]]))
    clusters = cluster_poses(boxes)
    assert len(clusters) == 1
    assert clusters.hulls.lower[0, 2] == -PI_UPPER
    assert clusters.hulls.upper[0, 2] == PI_UPPER


def test_points_touch_only_if_they_are_equal() -> None:
    at = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, -0.0, 5e-324], [1.0, 0.0, 0.0]])
    assert cluster_poses(Boxes(at, at)).labels.tolist() == [0, 1, 0, 2, 1]


def test_one_large_box_joins_many_small_ones() -> None:
    at = np.random.default_rng(1).uniform(0.0, 50.0, (400, 3)) * [1.0, 1.0, 0.05]
    small = Boxes(at, at + 1e-3)
    assert len(cluster_poses(small)) > 300
    clusters = cluster_poses(Boxes.concatenate([small, Boxes.of([(0.0, 51.0), (0.0, 51.0), (0.0, 2.6)])]))
    assert len(clusters) == 1


def test_far_from_the_origin_neighbours_still_touch() -> None:
    at = np.array([1e6, -1e6, 1.0])
    edges = at + np.arange(200)[:, None] * [0.1, 0.0, 0.0]
    boxes = Boxes(edges[:-1], edges[1:])
    assert len(cluster_poses(boxes)) == 1
    assert len(cluster_poses(boxes[[i for i in range(199) if i != 100]])) == 2


def test_a_permutation_of_the_boxes_permutes_the_components() -> None:
    random = np.random.default_rng(4)
    boxes = random_boxes(random)
    order = random.permutation(len(boxes))
    labels, moved = cluster_poses(boxes).labels[order], cluster_poses(boxes[order]).labels
    assert len(set(zip(labels.tolist(), moved.tolist(), strict=True))) == len(set(labels.tolist())) == len(set(moved.tolist()))


def test_no_boxes_have_no_components() -> None:
    clusters = cluster_poses(Boxes.none(3))
    assert len(clusters) == 0
    assert clusters.labels.shape == (0,)
    assert clusters.hulls.lower.shape == (0, 3)


def plain_twin(boxes: Boxes) -> list[int]:
    """Return the component of each box by looking at all pairs; no axis is circular."""
    meet = (np.maximum(boxes.lower[:, None], boxes.lower) <= np.minimum(boxes.upper[:, None], boxes.upper)).all(axis=2)
    labels = np.arange(len(boxes))
    for _ in boxes.lower:
        labels = np.where(meet, labels, len(boxes)).min(axis=1)
    return [sorted(set(labels.tolist())).index(label) for label in labels]


def sizes_of_all_kinds(random: np.random.Generator, rows: int, dimension: int) -> Boxes:
    """Return boxes on a lattice, among them slabs, points, large and unbounded ones."""
    lower = random.integers(-8, 8, (rows, dimension)).astype(np.float64)
    widths = random.choice([0.0, 1.0, 1.0, 1.0, 2.0, 6.0], lower.shape) * (random.random(lower.shape) < 0.9)
    upper = lower + widths * random.choice([0.5, 1.0])
    far = random.random(lower.shape) < 0.002
    return Boxes(np.where(far, -np.inf, lower), np.where(far & (random.random(lower.shape) < 0.5), np.inf, upper))


@pytest.mark.parametrize("dimension", [1, 2, 3, 4, 6])
def test_components_of_boxes_of_any_dimension_equal_those_of_all_pairs(dimension: int) -> None:
    several = 0
    for seed in range(cases(40, 4)):
        random = np.random.default_rng(seed)
        boxes = sizes_of_all_kinds(random, int(random.integers(1, 12 * 2 ** min(dimension - 1, 4))), dimension)
        clusters = cluster(boxes)
        assert clusters.labels.tolist() == plain_twin(boxes), seed
        for label in range(len(clusters)):
            hull = boxes[clusters.labels == label].hull()
            assert (clusters.hulls.lower[label] == hull.lower[0]).all()
            assert (clusters.hulls.upper[label] == hull.upper[0]).all()
        several += 1 < len(clusters) < len(boxes)
    assert several >= cases(11, 1)


@pytest.mark.parametrize("circular", [(0,), (1,), (0, 1)])
def test_any_axis_may_be_circular(circular: tuple[int, ...]) -> None:
    ends = {axis: (3.0, 3.5) if axis in circular else (0.0, 1.0) for axis in range(2)}
    starts = {axis: (-3.0, -2.5) if axis in circular else (0.0, 1.0) for axis in range(2)}
    boxes = Boxes.of([ends[0], ends[1]], [starts[0], starts[1]])
    assert len(cluster(boxes)) == 2
    clusters = cluster(boxes, circular)
    assert len(clusters) == 1
    for axis in circular:
        assert clusters.hulls.lower[0, axis] == 3.0
        assert clusters.hulls.upper[0, axis] == pytest.approx(2.0 * math.pi - 2.5, abs=1e-12)


def test_many_boxes_of_very_different_sizes_form_a_tree_of_halves() -> None:
    # The boxes of a bisection that always goes on with the lower half: each touches the next.
    edges = 2.0 ** -np.arange(60.0)
    boxes = Boxes(np.column_stack([edges[1:], np.zeros(59)]), np.column_stack([edges[:-1], np.ones(59)]))
    assert len(cluster(boxes)) == 1
    assert len(cluster(boxes[np.arange(59) != 30])) == 2


@pytest.mark.parametrize(
    ("boxes", "circular", "message"),
    [
        (Boxes.of([(0, 1)]), (1,), "axis 1 was said to be circular"),
        (Boxes.of([(0, 1)]), (-1,), "axis -1 was said to be circular"),
        (Boxes(np.array([[0.0], [np.inf]]), np.array([[1.0], [-np.inf]])), (), "box 1 of 2 is empty"),
        (Boxes(np.array([[np.nan]]), np.array([[1.0]])), (), "box 0 of 1 has a bound that is NaN"),
    ],
)
def test_boxes_that_cannot_be_clustered_are_refused(boxes: Boxes, circular: tuple[int, ...], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        cluster(boxes, circular)


@pytest.mark.many
@pytest.mark.parametrize("axis", [0, 1])
def test_any_axis_may_be_the_circular_one(axis: int) -> None:
    """Rows are compared in the order of a curve that follows the last axis first; boxes across the cut come in any order along another."""
    order = [2, 0, 1] if axis == 0 else [0, 2, 1]
    for seed in range(cases(150, 8)):
        boxes = random_boxes(np.random.default_rng(seed))
        clusters = cluster(Boxes(boxes.lower[:, order], boxes.upper[:, order]), circular=(axis,))
        expected = cluster_poses(boxes)
        assert clusters.labels.tolist() == expected.labels.tolist() == twin(boxes)
        assert np.array_equal(clusters.hulls.lower, expected.hulls.lower[:, order])
        assert np.array_equal(clusters.hulls.upper, expected.hulls.upper[:, order])
