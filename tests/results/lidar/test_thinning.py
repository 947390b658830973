import pytest

from ial.results.lidar import thinning
from ial.results.lidar.thinning import thinned


@pytest.fixture(autouse=True)
def _few(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(thinning, "MOST", 20)


def test_a_short_sequence_stays_as_it_is() -> None:
    items = list(range(20))
    assert thinned(items) is items


@pytest.mark.parametrize("count", [21, 22])
def test_of_a_long_one_every_second_item_stays_and_both_ends(count: int) -> None:
    left = thinned(list(range(count)))
    assert left[:3] == [0, 2, 4]
    assert left[-1] == count - 1
    assert len(left) == 11 + (count - 1) % 2


def test_changes_stay() -> None:
    kinds = ["a"] * 7 + ["b"] + ["a"] * 14
    left = thinned(list(range(22)), lambda item: kinds[item])
    assert 7 in left
    assert 8 in left
    assert len(left) < 15


def test_changes_all_the_time_are_thinned_all_the_same() -> None:
    assert len(thinned(list(range(21)), lambda item: item // 1)) == 11


def test_however_long_it_grows_little_is_kept() -> None:
    items: list[int] = []
    for number in range(5000):
        items = thinned([*items, number], lambda item: item % 97 == 0)
        assert len(items) <= 20
    assert items[0] == 0
    assert items[-1] == 4999
