import pytest

from ial.active.planners.goal import Goal


def test_what_tells_more_for_the_way_is_worth_more() -> None:
    near, far, better = (Goal("view", (0.0, 0.0), *each) for each in ((2.0, 1.0), (2.0, 5.0), (7.0, 5.0)))
    assert far.value < near.value < better.value
    assert Goal("view", (0.0, 0.0), 2.0, 0.0).value == 2.0, "what is at hand does not count for more than any number"


@pytest.mark.parametrize("stage", ["backtrack", "view", "approach"])
def test_of_as_good_ones_a_frontier_that_was_seen_last_is_the_best(stage: str) -> None:
    assert Goal("frontier", (0.0, 0.0), 3.0, 2.0).value == 2.0 * Goal(stage, (0.0, 0.0), 3.0, 2.0).value
