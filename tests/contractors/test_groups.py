import numpy as np
import pytest

from ial.contractors.boxes import FloatArray
from ial.contractors.groups import group_rows


def twin(lower: FloatArray, upper: FloatArray) -> list[int]:
    groups: dict[tuple[float, float], list[int]] = {}
    for row, key in enumerate(zip(lower.tolist(), upper.tolist(), strict=True)):
        groups.setdefault(key, []).append(row)  # a dictionary keeps the order of insertion, and holds -0.0 and 0.0 equal
    return [row for rows in groups.values() for row in rows]


@pytest.mark.parametrize("rows", [0, 1, 2, 100, 5000])
@pytest.mark.parametrize("distinct", [1, 2, 50, 100_000])
def test_rows_are_grouped_like_the_slow_twin(rows: int, distinct: int) -> None:
    random = np.random.default_rng(rows + distinct)
    chosen = random.integers(0, distinct, (rows, 2))
    values = random.normal(size=distinct) * 10.0 ** random.integers(-12, 12, distinct)
    lower, upper = values[chosen[:, 0]], values[chosen[:, 1]]
    assert group_rows(lower, upper).tolist() == twin(lower, upper)


def test_more_groups_than_the_first_table_holds() -> None:
    random = np.random.default_rng(0)
    edges = -np.pi + 2.0 * np.pi * np.arange(20_001) / 20_000
    chosen = random.integers(0, 20_000, 60_000)
    assert group_rows(edges[chosen], edges[chosen + 1]).tolist() == twin(edges[chosen], edges[chosen + 1])


def test_special_values_are_grouped_by_equality() -> None:
    lower = np.array([0.0, np.inf, -0.0, -np.inf, 1e300, np.inf, 5e-324, 1e300, -np.inf, 0.0])
    upper = np.array([1.0, -np.inf, 1.0, np.inf, 1e308, -np.inf, 5e-324, 1e308, np.inf, 2.0])
    assert group_rows(lower, upper).tolist() == [0, 2, 1, 5, 3, 8, 4, 7, 6, 9] == twin(lower, upper)


def test_intervals_that_start_the_search_at_the_same_place_stay_apart() -> None:
    lower = np.concatenate([np.arange(1.0, 600.0) * 2.0**60] * 2)
    assert group_rows(lower, lower).tolist() == twin(lower, lower)


def test_every_row_is_returned_once_even_if_it_is_not_a_number() -> None:
    lower = np.array([np.nan, 1.0, np.nan, 1.0, np.nan])
    order = group_rows(lower, lower).tolist()
    assert sorted(order) == [0, 1, 2, 3, 4]
    assert order.index(3) == order.index(1) + 1
