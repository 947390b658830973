from ial.contractors.combinators.trivial_sets import EmptySet, WholeSpace
from tests.contractors.shapes import random_boxes, same


def test_the_trivial_sets_are_each_others_complement() -> None:
    boxes = random_boxes(50, 3, seed=2)
    assert EmptySet(3).contract(boxes).empty.all()
    assert same(WholeSpace(3).contract(boxes), boxes)
    assert same((~EmptySet(3)).contract(boxes), boxes)
    assert (~WholeSpace(3)).contract(boxes).empty.all()
