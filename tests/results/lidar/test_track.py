from collections.abc import Callable
from typing import Any

import pytest

from ial.results.lidar import thinning
from ial.results.lidar.enclosures import Enclosure
from ial.results.lidar.track import Track

BOX = [(1.0, 1.6), (3.0, 3.4), (0.1, 0.2)]


def test_every_scan_is_counted_and_few_are_kept(estimate_of: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(thinning, "MOST", 30)
    track = Track()
    for number in range(200):
        status = "lost" if number == 101 else "localized"
        track.add(Enclosure.of(*estimate_of(number, BOX, status=status, vanishing=number == 51)))
    assert len(track) == 200
    assert track.statuses == {"localized": 199, "lost": 1}
    assert track.vanishing == 1
    assert [each.index for each in track.scans if each.vanishing] == [51]
    assert 10 < len(track.scans) <= 30
    assert track.scans[0].index == 0
    assert track.scans[-1].index == 199
