import numpy as np
import pytest

from ial.contractors import Annulus, Boxes, Distance, Interval, Polar, Polygon, RangeBearing, Segments
from ial.contractors.row_contractor import RowContractor
from ial.maps.grids.cell_contractor import CellContractor, OutsideCells
from ial.maps.grids.cell_index import CellIndex
from tests.contractors.shapes import is_well_formed, random_boxes, same

CELLS = CellIndex(np.array([[True, False, True], [True, True, False], [True, True, True]]), 3.5)
ALL = [
    Annulus((1.0, 2.0), Interval(1, 3)),
    Distance(),
    Polar(),
    RangeBearing(),
    Segments([(0, 0), (5, 1)], [(3, 2), (5, 1)]),
    Polygon([(0, 0), (5, 0), (1, 6)]),
    ~Polygon([(0, 0), (5, 0), (1, 6)]),
    CellContractor(CELLS),
    OutsideCells(CELLS),
]


@pytest.mark.parametrize("contractor", ALL, ids=lambda each: type(each).__name__)
def test_each_row_is_narrowed_by_itself_and_the_input_stays(contractor: RowContractor) -> None:
    boxes = random_boxes(40, contractor.dimension, seed=1)
    for bound in (boxes.lower, boxes.upper):
        bound.flags.writeable = False
    narrowed = contractor.contract(boxes)
    assert is_well_formed(narrowed, boxes)
    assert not same(narrowed, boxes)
    assert same(narrowed, Boxes.concatenate([contractor.contract(boxes[row]) for row in range(len(boxes))]))
