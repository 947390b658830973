import os
import signal
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from ial.contractors import Boxes, RangeBearing, get_threads, set_threads
from ial.contractors.kernels import kernel
from ial.contractors.threads import available_threads, run
from ial.errors import ConfigError


@kernel
def count_visits(start, stop, visits):  # type: ignore[no-untyped-def]
    for i in range(start, stop):
        visits[i] += 1


@pytest.fixture(autouse=True)
def _default_threads(monkeypatch: pytest.MonkeyPatch):  # type: ignore[no-untyped-def]
    monkeypatch.delenv("IAL_THREADS", raising=False)
    yield
    set_threads(None)


@pytest.fixture(scope="module")
def boxes() -> Boxes:
    rng = np.random.default_rng(1)
    centre = rng.normal(size=(5000, 7)) * 3
    width = rng.random((5000, 7)) * 2
    return Boxes(centre - width, centre + width)


def same(a: Boxes, b: Boxes) -> bool:
    return a.lower.tobytes() == b.lower.tobytes() and a.upper.tobytes() == b.upper.tobytes()


@pytest.mark.parametrize("threads", [1, 2, 3, 7])
@pytest.mark.parametrize("rows", [0, 1, 255, 256, 513, 10_000])
def test_every_row_is_visited_once(threads: int, rows: int) -> None:
    set_threads(threads)
    visits = np.zeros(rows, dtype=np.int64)
    run(count_visits, rows, visits)
    assert (visits == 1).all()


@pytest.mark.many
def test_the_result_does_not_depend_on_the_number_of_threads(boxes: Boxes) -> None:
    set_threads(1)
    one = RangeBearing().contract(boxes)
    assert 0 < one.empty.sum() < len(one)
    for threads in (2, 3):
        set_threads(threads)
        assert same(RangeBearing().contract(boxes), one)


@pytest.mark.many
def test_several_python_threads_may_call_at_once(boxes: Boxes) -> None:
    set_threads(2)
    one = RangeBearing().contract(boxes)
    with ThreadPoolExecutor(4) as callers:
        results = list(callers.map(lambda _: RangeBearing().contract(boxes), range(12)))
    assert all(same(result, one) for result in results)


@pytest.mark.many
@pytest.mark.skipif(not hasattr(os, "fork"), reason="the platform cannot fork")
@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")  # Python 3.12 warns of any fork beside threads
def test_a_forked_process_has_threads_of_its_own(boxes: Boxes) -> None:
    set_threads(2)
    one = RangeBearing().contract(boxes)
    child = os.fork()
    if child == 0:
        signal.alarm(30)  # a child that waits for threads it does not have would wait for ever
        try:
            os._exit(0 if same(RangeBearing().contract(boxes), one) else 1)
        finally:
            os._exit(2)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def test_the_number_of_threads_is_chosen_by_call_then_by_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    assert get_threads() == available_threads()
    monkeypatch.setenv("IAL_THREADS", "3")
    assert get_threads() == 3
    set_threads(5)
    assert get_threads() == 5
    set_threads(None)
    assert get_threads() == 3


@pytest.mark.parametrize("text", ["0", "-1", "two", "", "1.5"])
def test_a_bad_number_in_the_environment_is_refused(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setenv("IAL_THREADS", text)
    with pytest.raises(ConfigError, match="IAL_THREADS"):
        get_threads()


def test_no_threads_at_all_are_refused() -> None:
    with pytest.raises(ConfigError, match="at least 1"):
        set_threads(0)
