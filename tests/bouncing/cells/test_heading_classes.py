from fractions import Fraction

from ial.bouncing.cells.heading_classes import HeadingClasses
from ial.bouncing.cells.headings import Headings


def test_classes_respect_bumps() -> None:
    headings = Headings(24, 5, Fraction(2))
    classes = HeadingClasses.merged(headings)
    for heading in range(24):
        mine = classes.of[heading]
        assert classes.offsets[mine].tolist() == headings.offsets[heading].tolist()
        assert classes.turned[mine] == classes.of[(heading + 5) % 24]
        assert heading in classes.members(int(mine))
    assert classes.sizes.sum() == 24
