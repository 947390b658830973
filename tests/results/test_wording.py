import math
import re

from hypothesis import given
from hypothesis import strategies as st

from ial.lidar.estimate import Hypothesis
from ial.results.wording import pose_text

MIDDLE = st.floats(-1e3, 1e3)
HALF = st.floats(0.0, 2.0)


def test_an_example() -> None:
    hypothesis = Hypothesis((15.7, 16.0), (-10.2, -9.7), (0.05, 0.1), 3, 0.1)
    assert pose_text(hypothesis.centre, hypothesis) == "x 15.85 ± 0.15 m, y −9.95 ± 0.25 m, θ 4.3 ± 1.5°"


@given(x=MIDDLE, y=MIDDLE, theta=st.floats(-math.pi, math.pi), halves=st.tuples(HALF, HALF, HALF))
def test_the_bounds_lie_within_what_is_said(x: float, y: float, theta: float, halves: tuple[float, float, float]) -> None:
    a, b, c = halves
    hypothesis = Hypothesis((x - a, x + a), (y - b, y + b), (theta, theta + 2.0 * c), 1, 1.0)
    text = pose_text(hypothesis.centre, hypothesis).replace("−", "-")
    found = [float(number) for number in re.findall(r"-?\d+\.\d+", text)]
    bounds = (hypothesis.x, hypothesis.y, (math.degrees(theta), math.degrees(theta + 2.0 * c)))
    for (value, error), (lower, upper) in zip(zip(found[::2], found[1::2], strict=True), bounds, strict=True):
        turn = 360.0 * round((0.5 * (lower + upper) - value) / 360.0) if (lower, upper) == bounds[2] else 0.0
        assert value - error <= lower - turn + 2e-7
        assert upper - turn - 2e-7 <= value + error
