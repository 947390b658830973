import io

import numpy as np

from ial.bouncing.exports.archive import plain_archive
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.filters.bounce_filter import BounceFilter


def test_the_archive_holds_plain_arrays(small: BounceFilter) -> None:
    with np.load(io.BytesIO(plain_archive(ExportedFilter.of(small))), allow_pickle=False) as archive:
        arrays = dict(archive)
    table = small.table
    for name, array in (("next", table.successors), ("colour", table.colours), ("size", table.uncertainty)):
        assert np.array_equal(arrays[name], array)
    assert np.array_equal(arrays["environments"], table.environments)
    for state in range(len(table)):
        told = []
        for place in arrays["place"][arrays["place_start"][state] : arrays["place_start"][state + 1]]:
            environment, kind = arrays["place_environment"][place], arrays["place_class"][place]
            cell = np.array([arrays["place_column"][place], arrays["place_row"][place]])
            x, y = arrays["corner_m"][environment] + (cell + 0.5) * arrays["cell_m"]
            headings = arrays["heading"][arrays["class_start"][kind] : arrays["class_start"][kind + 1]]
            told.append((str(arrays["name"][environment]), x, y, tuple(arrays["heading_deg"][headings])))
        assert told == [(each.environment, each.x_m, each.y_m, each.headings_deg) for each in small.where(state)]


def test_a_minimized_archive_has_no_places(corner: BounceFilter) -> None:
    with np.load(io.BytesIO(plain_archive(ExportedFilter.of(corner, "colours")))) as archive:
        assert {name for name in archive if "place" in name} == set()
