from collections.abc import Callable, Iterable

import pytest

from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.recording import Reading
from ial.errors import RecordingError

Maker = Callable[[int], Iterable[Reading]]


def test_readings_come_out_as_they_went_in_and_more_than_once(readings: Maker) -> None:
    given = list(readings(4))
    recording = InMemoryRecording("synthetic", iter(given))
    assert list(recording.readings()) == list(recording.readings()) == given
    assert (recording.skipped, recording.repaired) == ({}, {})


def test_it_says_what_it_holds(readings: Maker) -> None:
    info = InMemoryRecording("synthetic", readings(4)).info()
    assert (info.name, info.scans, [(topic.name, topic.count) for topic in info.topics]) == ("synthetic", 4, [("scans", 4)])


def test_no_scan_and_stamps_that_do_not_increase_are_refused(readings: Maker) -> None:
    with pytest.raises(RecordingError, match="synthetic: there is no scan in it"):
        InMemoryRecording("synthetic", [])
    first, second = readings(2)
    for wrong in ([second, first], [first, first]):
        with pytest.raises(RecordingError, match="synthetic: the stamps do not increase; sort"):
            InMemoryRecording("synthetic", wrong)
