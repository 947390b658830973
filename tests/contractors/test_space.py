import pytest

from ial.contractors import Boxes, Function, FunctionFamily, Separator, fixpoint, intersection, lazy, pave, relaxed, union, variables

x, y = variables("x y")
u, v = variables("u v")
ONE, OTHER = x**2 + y == 1, u + v == 2
APART = "u v and x y were declared apart"


@pytest.mark.parametrize("combine", [intersection, union, lazy, lambda both: relaxed(both, outliers=1)])
def test_constraints_on_variables_of_different_spaces_do_not_combine(combine) -> None:  # type: ignore[no-untyped-def]
    for one in (ONE, ~ONE, ONE & (x == 1), ONE | (x == 1), fixpoint(ONE), relaxed([ONE, ONE], outliers=1)):
        with pytest.raises(ValueError, match=APART):
            combine([one, OTHER])
    with pytest.raises(ValueError, match=APART):
        combine([Separator.of(ONE), Separator.of(OTHER)])


def test_formulas_and_functions_neither() -> None:
    with pytest.raises(ValueError, match=APART):
        x + u
    for kind in (Function, FunctionFamily):
        with pytest.raises(ValueError, match=APART):
            kind(x, u)
        with pytest.raises(ValueError, match="no variable"):
            kind(1.0)


def test_what_is_no_constraint_or_no_boxes_is_said() -> None:
    with pytest.raises(TypeError, match="3 is no constraint"):
        pave(3, Boxes.of([(0, 1)]), 0.1)  # type: ignore[call-overload]
    with pytest.raises(TypeError, match=r"are no boxes; write Boxes\.of"):
        pave(ONE, [(0, 1), (0, 1)], 0.1)  # type: ignore[call-overload]


def test_combinations_are_printed_as_they_are_written() -> None:
    assert repr((x <= 1) | (y == 2)) == "(x <= [1.0, 1.0]) | (y == [2.0, 2.0])"
    assert repr(relaxed([x <= 1, y <= 2], outliers=1)) == "relaxed([x <= [1.0, 1.0], y <= [2.0, 2.0]], outliers=1)"


def test_the_same_names_in_the_same_order_are_the_same_space() -> None:
    again, _ = variables("x y")
    assert (ONE & (again <= 0)).contract(Boxes.of([(-2, 2), (-2, 2)])).upper[0, 0] == 0.0
    with pytest.raises(ValueError, match="x y and y x were declared apart"):
        intersection([ONE, variables("y x")[0] == 1])
