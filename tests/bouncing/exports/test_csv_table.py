import csv
import io

import numpy as np

from ial.bouncing.exports.csv_table import csv_text
from ial.bouncing.filters.bounce_filter import BounceFilter


def test_csv_holds_the_table(small: BounceFilter) -> None:
    table = small.table
    rows = list(csv.DictReader(io.StringIO(csv_text(table))))
    assert [int(row["state"]) for row in rows] == list(range(len(table)))
    for names, array in ((("next_0", "next_1"), table.successors), (("colour",), table.colours), (("size",), table.uncertainty)):
        assert np.array_equal([[int(row[name]) for name in names] for row in rows], array.reshape(len(table), -1))
