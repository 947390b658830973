import math
import platform
import subprocess
import sys
import textwrap

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors.rounding import check_rounding, down, up

X86 = {"down": 0x400, "up": 0x800, "zero": 0xC00}
ARM = {"down": 0x800000, "up": 0x400000, "zero": 0xC00000}
MODES = {"x86_64": X86, "amd64": X86, "aarch64": ARM, "arm64": ARM}.get(platform.machine().lower(), {})
# Where the control word lies in fenv_t of the C library, as an index of 32-bit words, and its bits that flush subnormals to zero.
FLUSH = {"x86_64": (7, 0x8040), "aarch64": (0, 1 << 24)}.get(platform.machine())

unknown_processor = pytest.mark.skipif(not MODES or sys.platform != "linux", reason="the codes are known for Linux on x86 and ARM")


def run(*lines: str) -> str:
    """Run a script in a process of its own, since the mode stays; return what it prints."""
    script = textwrap.dedent("""
        import ctypes, ctypes.util
        from ial.contractors import Boxes, Interval, RangeBearing, check_rounding, relaxed_intersection
        from ial.contractors import threads
        from ial.contractors.expressions.functions import sin
        from ial.errors import RoundingModeError
        libm = ctypes.CDLL(ctypes.util.find_library("m") or "libm.so.6")
        check_rounding()
        a, b = Interval(1, 2), Boxes.of(*[[(0, 1)] * 7] * 2000)
        def refuses(work):
            try:
                work()
            except RoundingModeError as error:
                assert "round to nearest" in str(error)
                return True
            return False
        """)
    done = subprocess.run([sys.executable, "-c", script + "\n".join(lines)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


ENTRIES = ("a + a", "sin(a)", "-a", "b + 1", "Interval(1) / 3", "Interval.parse('[1/3]')", "RangeBearing().contract(b)", "check_rounding()")
WORK = f"[refuses(work) for work in ({', '.join(f'lambda: {entry}' for entry in ENTRIES)})]"


@given(st.floats(allow_nan=False))
def test_a_step_reaches_the_next_double(x: float) -> None:
    assert up(x) == math.nextafter(x, math.inf)
    assert down(x) == math.nextafter(x, -math.inf)


@pytest.mark.parametrize("x", [0.0, -0.0, 5e-324, -5e-324, 2.0**-1022, 1.0, -1.0, np.finfo(float).max, math.inf, -math.inf])
def test_a_step_at_the_edges(x: float) -> None:
    assert up(x) == math.nextafter(x, math.inf)
    assert down(x) == math.nextafter(x, -math.inf)


def test_a_step_keeps_nan() -> None:
    assert math.isnan(up(math.nan))
    assert math.isnan(down(math.nan))


def test_the_default_mode_is_accepted() -> None:
    check_rounding()


@pytest.mark.slow
@unknown_processor
@pytest.mark.parametrize("mode", ["down", "up", "zero"])
def test_every_entry_refuses_another_rounding_mode(mode: str) -> None:
    printed = run(f"assert libm.fesetround({MODES[mode]}) == 0", f"print(all({WORK}))")
    assert printed == "True"


@pytest.mark.slow
@pytest.mark.skipif(FLUSH is None or sys.platform != "linux", reason="the layout of fenv_t is known for Linux on x86 and ARM")
def test_every_entry_refuses_to_flush_subnormals() -> None:
    assert FLUSH is not None
    word, bits = FLUSH
    printed = run(
        "environment = (ctypes.c_uint32 * 16)()",
        "assert libm.fegetenv(environment) == 0",
        f"environment[{word}] |= {bits}",
        "assert libm.fesetenv(environment) == 0",
        f"print(all({WORK}))",
    )
    assert printed == "True"


@pytest.mark.slow
@unknown_processor
def test_a_worker_thread_in_another_mode_is_found() -> None:
    printed = run(
        "threads.set_threads(2)",
        "RangeBearing().contract(b)",
        "pool = threads._executor(2)",
        "import threading",
        "both = threading.Barrier(2)",  # each of the two workers takes one job, so that none is left in the ordinary mode
        f"turn = lambda: (both.wait(), libm.fesetround({MODES['up'] if MODES else 0}))",
        "for job in [pool.submit(turn) for _ in range(2)]: job.result()",
        "check_rounding()",
        "print(refuses(lambda: RangeBearing().contract(b)))",
    )
    assert printed == "True"
