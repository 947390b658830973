"""Tests of transforms in space and of paths along fixed edges."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from ial.datasets.odometry import Odometry
from ial.datasets.tf_buffer import Transform, TransformBuffer

unit = st.floats(-1.0, 1.0)
quaternions = st.tuples(unit, unit, unit, unit).filter(lambda q: math.hypot(*q) > 0.1)
vectors = st.tuples(*[st.floats(-10.0, 10.0)] * 3)
transforms = st.builds(Transform, vectors, quaternions)


def _matrix(transform: Transform) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.from_quat(transform.quaternion).as_matrix()
    matrix[:3, 3] = transform.translation
    return matrix


@given(transforms, transforms)
def test_products_and_inverses_agree_with_matrices(first: Transform, second: Transform) -> None:
    assert _matrix(first @ second) == pytest.approx(_matrix(first) @ _matrix(second), abs=1e-9)
    assert _matrix(first.inverse()) == pytest.approx(np.linalg.inv(_matrix(first)), abs=1e-9)


@given(st.lists(transforms, min_size=3, max_size=3), st.lists(st.booleans(), min_size=3, max_size=3))
def test_paths_run_up_and_down_the_tree(edges: list[Transform], up: list[bool]) -> None:
    buffer = TransformBuffer()
    expected = np.eye(4)
    for index, (edge, reverse) in enumerate(zip(edges, up, strict=True)):
        names = (f"f{index}", f"f{index + 1}")
        buffer.add(*(names[::-1] if reverse else names), 0, edge.inverse() if reverse else edge)
        expected = expected @ _matrix(edge)
    path = buffer.fixed("f0", "f3")
    assert path is not None
    assert _matrix(path) == pytest.approx(expected, abs=1e-8)


def test_only_edges_that_never_change_are_fixed() -> None:
    buffer = TransformBuffer()
    for stamp in range(3):
        buffer.add("base", "still", stamp, Transform((1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)))
        buffer.add("still", "turning", stamp, Transform((0.0, 0.0, 0.0), (0.0, 0.0, math.sin(stamp), math.cos(stamp))))
    assert buffer.fixed("base", "still") is not None
    assert buffer.fixed("base", "turning") is None
    assert buffer.fixed("base", "elsewhere") is None
    assert buffer.fixed("base", "base") == Transform((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    assert buffer.frames == {"base", "still", "turning"}


def test_what_is_no_transform_is_left_out() -> None:
    buffer = TransformBuffer()
    buffer.add("a", "b", 0, Transform((math.nan, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)))
    buffer.add("a", "b", 0, Transform((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)))
    assert buffer.edges == []


def test_samples_from_odom_are_kept() -> None:
    buffer = TransformBuffer()
    edge = Transform((1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    buffer.add("odom", "base_link", 2, edge)
    buffer.add("odom", "base_link", 3, edge)
    buffer.add("base_link", "arm", 3, edge)
    odometry = buffer.odometry("base_link")
    assert odometry is not None
    assert odometry.at(2) == odometry.at(3) == Odometry(1.0, 0.0)
    assert len(odometry) == 2
    assert buffer.odometry("arm") is None
