from fractions import Fraction

from ial.bouncing.cells.noisy_model import NoisyModel
from ial.membership import Rejection, SetMembershipFilter
from tests.bouncing.cells.test_noisy_map import noisy


def test_an_impossible_stream_is_a_rejection() -> None:
    model = NoisyModel(noisy(step=Fraction(3), cell=Fraction(1, 2)).graph)
    robot = SetMembershipFilter(model, "restart")
    answers = [robot.update(None, 0) for _ in range(40)]
    first = next(each for each in answers if each is not None)
    assert isinstance(first, Rejection)
    assert first.step >= 6, "the diagonal is 10 m, a step 1.5 m"
    assert len(model.predict(model.universe(), None)) > 0
