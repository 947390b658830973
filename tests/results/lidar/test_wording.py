import math
import re
from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from ial.lidar.hypothesis import Hypothesis
from ial.results.lidar.wording import pose_text

MIDDLE = st.floats(-1e3, 1e3)
HALF = st.floats(0.0, 2.0)


def test_an_example() -> None:
    hypothesis = Hypothesis((15.7, 16.0), (-10.2, -9.7), (0.05, 0.1), 3, 0.1)
    # The double 15.7 is a little less than 15.7, and −9.7 a little more than −9.7.
    assert pose_text(hypothesis.centre, hypothesis) == "x 15.85 ± 0.16 m, y −9.95 ± 0.26 m, θ 4.3 ± 1.5°"


@given(x=MIDDLE, y=MIDDLE, theta=st.floats(-math.pi, math.pi), halves=st.tuples(HALF, HALF, HALF))
def test_the_bounds_lie_within_what_is_said(x: float, y: float, theta: float, halves: tuple[float, float, float]) -> None:
    a, b, c = halves
    hypothesis = Hypothesis((x - a, x + a), (y - b, y + b), (theta, theta + 2.0 * c), 1, 1.0)
    text = pose_text(hypothesis.centre, hypothesis).replace("−", "-")
    numbers = [Fraction(number) for number in re.findall(r"-?\d+\.\d+", text)]
    for value, error, (lower, upper) in ((*numbers[:2], hypothesis.x), (*numbers[2:4], hypothesis.y)):
        assert value - error <= Fraction(lower)
        assert Fraction(upper) <= value + error
    low, high = (math.degrees(bound) for bound in hypothesis.theta)
    value, error = map(float, numbers[4:])
    turn = 360.0 * round((0.5 * (low + high) - value) / 360.0)
    assert value - error <= low - turn + 1e-9
    assert high - turn <= value + error + 1e-9
