"""The two constraints on a pose together: the robot stands in the domain, and the scan fits."""

import numpy as np

from ial.contractors.angles import wrapped
from ial.contractors.boxes import Boxes
from ial.lidar.evidence.beams import Beams
from ial.lidar.search.scan_contractor import ScanContractor
from ial.maps.grids.cell_index import CellIndex


class PoseContractor:
    """Poses (x, y, θ) in the grid's frame whose position lies in a cell of the domain, and from which at most q beams are bad.

    Parameters
    ----------
    beams
        The evidence of the scan.
    occupied
        The cells that beams may end at.
    domain
        The cells in which the robot's base may be.
    """

    dimension = 3

    def __init__(self, beams: Beams, occupied: CellIndex, domain: CellIndex) -> None:
        self._scan = ScanContractor(beams, occupied)
        self._domain = domain

    def contract(self, boxes: Boxes) -> Boxes:
        """Return the boxes, those emptied that hold no consistent pose; headings may have any turn, and keep theirs.

        Raises
        ------
        ValueError
            If a bound is NaN.
        """
        turned = wrapped(boxes, 2)
        keep = self._domain.meet(Boxes(turned.lower[:, :2], turned.upper[:, :2]))
        rows = np.flatnonzero(keep)
        keep[rows] = self._scan.fits(turned[rows])
        return boxes.where(keep)
