import numpy as np
import pytest

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.paving.paver import pave
from ial.contractors.paving.smear import Jacobian, smear


def constant(*rows: tuple[float, ...]) -> Jacobian:
    """Return the Jacobian of linear functions."""

    def jacobian(boxes: Boxes) -> tuple[FloatArray, FloatArray]:
        everywhere = np.tile(np.array(rows), (len(boxes), 1, 1))
        return everywhere, everywhere

    return jacobian


def test_the_weight_is_the_steepest_slope_times_the_width() -> None:
    boxes = Boxes.of([(0, 2), (0, 4), (0, 0)], [(-1, 0), (0, 1), (0, 3)])
    assert smear(constant((1.0, -2.0, 5.0), (-3.0, 0.5, 0.0)))(boxes).tolist() == [[6.0, 8.0, 0.0], [3.0, 2.0, 15.0]]


def test_the_larger_end_of_a_slope_counts() -> None:
    def jacobian(boxes: Boxes) -> tuple[FloatArray, FloatArray]:
        return np.array([[[-4.0, -1.0]]]), np.array([[[1.0, 2.0]]])

    assert smear(jacobian)(Boxes.of([(0, 1), (0, 1)])).tolist() == [[4.0, 2.0]]


def test_an_unbounded_side_without_influence_weighs_nothing() -> None:
    weights = smear(constant((0.0, 1.0)))(Boxes.of([(-np.inf, np.inf), (0, np.inf)]))
    assert weights.tolist() == [[0.0, np.inf]]


def test_a_function_of_one_variable_is_bisected_along_it_first() -> None:
    class Strip:
        dimension = 2

        def contract(self, boxes: Boxes) -> Boxes:
            return boxes.where((boxes.lower[:, 1] <= 0.3) & (boxes.upper[:, 1] >= 0.3))

    box = Boxes.of([(0, 8), (0, 1)])
    steered, plain = (
        pave(Strip(), box, 0.1, rule=rule, order="breadth", max_boxes=1000) for rule in (smear(constant((0.0, 1.0))), "largest")
    )  # type: ignore[arg-type]
    assert (steered.boxes.width() <= 0.1).all()
    assert steered.nodes < plain.nodes


def test_a_jacobian_of_another_shape_is_refused() -> None:
    for jacobian in (constant((1.0, 2.0, 3.0)), lambda boxes: (np.ones((1, 2)), np.ones((1, 2)))):
        with pytest.raises(ValueError, match="must be \\(boxes, functions, dimensions\\)"):
            smear(jacobian)(Boxes.of([(0, 1), (0, 1)]))
