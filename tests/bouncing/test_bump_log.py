from collections.abc import Iterator
from fractions import Fraction

import pytest

from ial.bouncing.bump_event import BumpEvent
from ial.bouncing.bump_log import LogForm, bump_events
from ial.errors import StreamError


def read(text: str, form: LogForm | None = None) -> list[BumpEvent]:
    return list(bump_events(text.encode().splitlines(keepends=True), "a.log", form))


def test_columns_come_in_any_order_and_numbers_are_exact() -> None:
    text = "battery,event,heading,time,y,x\n0.9,start,-22.5,10.1,1e-3,4\n\n0.8, bump ,,12.340000000000000001,,\n"
    assert read(text) == [
        BumpEvent(Fraction(101, 10), "start", place=(Fraction(4), Fraction(1, 1000), Fraction(-45, 2))),
        BumpEvent(Fraction("12.340000000000000001"), "bump"),
    ]


def test_the_form_is_told_by_the_first_line() -> None:
    lines = '{"time": 0.1, "event": "start", "x": 1, "y": 0.1, "heading": 90}\n{"event": "bump", "time": 2, "robot": null, "more": [1]}\n'
    events = [BumpEvent(Fraction(1, 10), "start", place=(Fraction(1), Fraction(1, 10), Fraction(90))), BumpEvent(Fraction(2), "bump")]
    assert read(lines) == read(lines, "jsonl") == events
    assert read("\ufefftime,event\r\n1,start\r\n") == [BumpEvent(Fraction(1), "start")]


def test_robots_have_clocks_of_their_own() -> None:
    events = read("time,event,robot\n5,start,a\n1,start,b\n2,bump,b\n5,bump,a\n")
    assert [(event.robot, event.time_s) for event in events] == [("a", 5), ("b", 1), ("b", 2), ("a", 5)]
    assert read('{"time": 1, "event": "bump", "robot": 7}\n')[0].robot == "7"


def test_a_place_counts_at_a_start_alone() -> None:
    assert read("time,event,x,y,heading\n1,bump,3,4,5\n")[0].place is None


def test_events_come_as_soon_as_their_lines_do() -> None:
    given = []

    def growing() -> Iterator[bytes]:
        for line in (b"time,event\n", b"1,start\n", b"2,bump\n"):
            given.append(line)
            yield line

    assert next(bump_events(growing(), "a.log")).kind == "start"
    assert len(given) == 2


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no event and no line"),
        ("time,event\n", "a.log: the log holds no event;"),
        ("time,what\n1,bump\n", "line 1: the header 'time,what' has no column `event`"),
        ("event\nbump\n", "no column `time`"),
        ("time,time,event\n1,1,bump\n", "line 1: the header has the column `time` twice"),
        ("time,event\n1,crash\n", "line 2: the event 'crash' is not known; write start"),
        ("time,event\nnan,bump\n", "line 2, time: 'nan' is no number"),
        ("time,event\nsoon,bump\n", "line 2, time: 'soon' is no number"),
        (
            "time,event\n1796000000000000000,bump\n",
            "line 2, time: '1796000000000000000' is too large; write a number of at most 1e15, in metres, degrees or seconds",
        ),
        ("time,event\n1e999,bump\n", "line 2, time: '1e999' is too large"),
        ("time,event\n,bump\n", "line 2: no `time`"),
        ("time,event\n2,start\n1,bump\n", "line 3: the clock goes back, from 2 to 1 s"),
        ("time,event\n1,start\n2,bu", "line 3: the line does not end"),
        ("event,time\nstart,1\nbump,12", "line 3: the line does not end"),
        ("time,event\n1\n", "line 2: 1 columns, and the header has 2; is the line cut off?"),
        ('time,event\n1,"bump\n', "line 2: no line of CSV"),
        ("time,event,robot\n1,start,a\n2,bump,\n", "line 3: only some lines name a robot"),
        ("time,event,robot\n1,start,\n2,bump,a\n", "line 3: only some lines name a robot"),
        ("time,event,x,y,heading\n1,start,1,,\n", "line 2: a start with x alone"),
        ("time,event,x,y,heading\n1,start,1,2,north\n", "line 2, heading: 'north' is no number"),
        ('{"time": NaN, "event": "bump"}\n', "line 1: 'NaN' is no number"),
        ('{"time": 1e9999, "event": "bump"}\n', "line 1: '1e9999' is no number"),
        ('{"time": true, "event": "bump"}\n', "line 1, time: 'True' is no number"),
        ('{"time": 1, "event": ["bump"]}\n', "is not known"),
        ('{"time": 1, "time": 2, "event": "bump"}\n', "line 1: a name stands there twice"),
        ('{"time": 1, "event": "bump"\n', "line 1: no JSON object in one line, or a part of one"),
        ('{"time": 1, "event": "start"}\n[2]\n', "line 2: no JSON object"),
        ('{"time": 1, "event": "bump", "robot": 1.5}\n', "line 1: the robot is"),
        ('{"event": "bump"}\n', "line 1: no `time`"),
    ],
)
def test_what_cannot_be_meant_is_refused_with_its_line(text: str, message: str) -> None:
    with pytest.raises(StreamError) as error:
        read(text)
    assert message in str(error.value)


def test_a_line_that_is_no_text_is_refused() -> None:
    with pytest.raises(StreamError, match="line 2: no text; give CSV or JSON lines in UTF-8"):
        list(bump_events([b"time,event\n", b"\xff\n"], "a.csv"))
