"""With ``NUMBA_DISABLE_JIT=1`` Python interprets every kernel: the same bits, and errors that a debugger can stop at."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from ial.contractors import rounding
from ial.contractors.interpreter import INTERPRETED, InterpretedCallback, interpreted
from ial.contractors.intervals import error_free
from ial.contractors.kernels import kernel
from ial.lidar.search.empty_rectangles import LANES, count_empty_rectangles
from ial.lidar.search.rectangle_indices import OFFSET, rectangle_indices

ROOT = Path(__file__).resolve().parents[2]
EDGES = [0.0, 5e-324, 2.0**-1074 * 3, 2.0**-1022, 2.0**-511, 0.1, 1.0, 1.0 + 2.0**-52, 3.0, 2.0**512, np.finfo(np.float64).max, np.inf]
DOUBLES = [*EDGES, *(-x for x in EDGES), np.nan]


def bits(x: float) -> int:
    return 0 if np.isnan(x) else int(np.float64(x).view(np.int64))  # NaN has many patterns


@kernel
def _there_and_back(x, steps):  # type: ignore[no-untyped-def]
    pattern = rounding._bits(x)
    return pattern, rounding._double(pattern + steps)


@kernel
def _fused(a, b, c):  # type: ignore[no-untyped-def]
    return error_free.fma(a, b, c)


@kernel
def _indices(bounds, i, xl, yl, xu, yu, columns, rows):  # type: ignore[no-untyped-def]
    return rectangle_indices(bounds, i, xl, yl, xu, yu, np.int32(columns), np.int32(rows))


@kernel
def _count(table, above_right, above_left, below_right, below_left, counts, at):  # type: ignore[no-untyped-def]
    count_empty_rectangles(table, above_right, above_left, below_right, below_left, counts, at)


@pytest.mark.compiled
@pytest.mark.parametrize("steps", [-1, 1, 7])
def test_the_bits_of_a_double(steps: int) -> None:
    for x in [x for x in DOUBLES if np.isfinite(x) and x != 0.0]:
        pattern, stepped = _there_and_back(x, steps)
        assert pattern == rounding._bits.py_func(x)
        assert bits(stepped) == bits(rounding._double.py_func(pattern + steps))


@pytest.mark.compiled
def test_a_fused_multiply_add_at_the_edges_and_between() -> None:
    generator = np.random.default_rng(3)
    near = [(a, b, -(a * b) * (1.0 + k * 2.0**-52)) for a, b in generator.normal(size=(300, 2)) for k in (-1, 0, 1)]
    wide = generator.normal(size=(300, 3)) * 2.0 ** generator.integers(-540, 540, (300, 3))
    for a, b, c in [*((a, b, c) for a in DOUBLES for b in DOUBLES for c in DOUBLES), *near, *wide.tolist()]:
        with np.errstate(all="ignore"):
            twin = error_free.fma.py_func(np.float64(a), np.float64(b), np.float64(c))
        assert bits(_fused(a, b, c)) == bits(twin), (a, b, c)


@pytest.mark.compiled
def test_the_indices_of_rectangles() -> None:
    generator = np.random.default_rng(4)
    bounds = np.concatenate([generator.uniform(-60.0, 60.0, (200, 4)), np.round(generator.uniform(-60.0, 60.0, (200, 4)))])
    for i, box in enumerate(np.round(generator.uniform(-30.0, 30.0, (len(bounds), 4)) * 4.0) / 4.0 + OFFSET):
        assert _indices(bounds, i, *box, 40, 25) == rectangle_indices.py_func(bounds, i, *box, 40, 25)


@pytest.mark.compiled
@pytest.mark.parametrize("dtype", [np.int32, np.uint16])
def test_the_number_of_empty_rectangles(dtype: type) -> None:
    generator = np.random.default_rng(5)
    table = np.zeros((30, 60), dtype=np.int64)
    table[1:, 1:] = (generator.random((29, 59)) < 0.02).cumsum(axis=0).cumsum(axis=1) * (1 << 8 if dtype is np.uint16 else 1)
    flat = table.astype(dtype).reshape(-1)  # in 16 bits the sums overflow, and their differences come out right
    counts, twins = np.zeros(40, dtype=np.int32), np.zeros(40, dtype=np.int32)
    for _ in range(300):
        below, left = generator.integers(0, 20), generator.integers(0, 40)
        above, right = below + generator.integers(0, 10), left + generator.integers(0, 12)
        at = int(generator.integers(0, 40 - LANES))
        corners = [60 * above + right, 60 * above + left, 60 * below + right, 60 * below + left]
        _count(flat, *corners, counts, at)
        count_empty_rectangles.py_func(flat, *corners, twins, at)
    assert counts.tolist() == twins.tolist()
    assert 0 < counts.sum() < 300 * LANES


def test_interpreted_kernels_count_as_the_processor_does() -> None:
    quotient = interpreted(lambda a, b: (a / b, a > b, np.float64(a).view(np.int64)))
    outer = interpreted(lambda a, b: 1.0 / quotient(a, b)[0])
    assert quotient(-1.0, 0.0) == (-np.inf, False, -0x4010000000000000)
    assert outer(0.0, 5.0) == np.inf  # an inner kernel's zero divides as well
    assert [type(each) for each in quotient(1.0, 2.0)] == [float, bool, int]
    assert interpreted(lambda n: n + 200)(np.uint8(100)) == 300  # compiled code widens before it adds


def test_an_error_of_an_interpreted_kernel_leaves_nothing_behind() -> None:
    wrong = interpreted(lambda x: [][int(x)])
    with pytest.raises(IndexError):
        wrong(1.0)
    assert type(interpreted(lambda x: x)(1.0)) is float


def test_interpreted_callbacks_have_numbers_from_one() -> None:
    called: list[float] = []
    one, two = InterpretedCallback(lambda x: called.append(x)), InterpretedCallback(lambda x: called.append(-x))
    assert 0 < one.address < two.address
    InterpretedCallback.at(two.address)(3.0)
    InterpretedCallback.at(one.address)(3.0)
    assert called == [-3.0, 3.0]


WORK = """
import numpy as np
from ial.contractors import Boxes, Interval, variables
from ial.contractors.expressions.functions import atan2, exp, sin, sqrt
from ial.lidar import Localizer

a, b = Interval(0.1, 0.2), Interval(-1, 2)
x, y = variables("x y")
boxes = Boxes(np.array([[0.0, -3.0], [0.5, 0.25]]), np.array([[2.0, 3.0], [0.75, 1.5]]))
narrowed = [formula.contract(boxes) for formula in (sqrt(x) * sin(y) == 0.7, x**2 + y**2 <= 2, atan2(y, x) <= 0.3)]
print([a + b, a / b, 1 / Interval(0, 2), b**3, sin(a), exp(b)], [(each.lower.tolist(), each.upper.tolist()) for each in narrowed])
"""

PIECE = ("tests/contractors/test_rounding.py", "tests/contractors/intervals/test_error_free.py", "tests/lidar/search/test_prediction.py")


def outcome(jit: str, *command: str) -> str:
    environment = {**os.environ, "NUMBA_DISABLE_JIT": jit}
    done = subprocess.run([sys.executable, *command], capture_output=True, text=True, cwd=ROOT, env=environment, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.slow
def test_interpreted_results_are_those_of_compiled_kernels() -> None:
    assert outcome("1", "-c", WORK) == outcome("0", "-c", WORK)


@pytest.mark.slow
@pytest.mark.skipif(INTERPRETED, reason="is what this would start")
def test_a_piece_of_the_suite_runs_interpreted() -> None:
    printed = outcome("1", "-m", "pytest", "-q", "-p", "no:cacheprovider", "-k", "a_step or splitting or follow or unknown", *PIECE)
    assert " passed" in printed
