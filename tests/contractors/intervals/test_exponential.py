import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ial.contractors.intervals import exponential
from tests.contractors import itf1788
from tests.contractors.oracles import EMPTY, ENTIRE, LARGEST, ORACLES, TINY, hard_intervals, hard_numbers, intervals, kernels_of, wider

COUNT = 10_000
KERNELS = kernels_of(exponential)


@pytest.mark.parametrize("kernel", KERNELS)
def test_results_enclose_and_are_nearly_tight(kernel: Any) -> None:
    far = np.random.default_rng(1).uniform(-760.0, 720.0, COUNT)  # to and beyond where results leave the range of doubles
    for operand in (intervals(COUNT, 2), hard_intervals(COUNT, 3), (far, far)):
        beyond = wider(kernel, operand)
        assert beyond.min() >= 0
        assert beyond.max() <= ORACLES[kernel].wider


@pytest.mark.parametrize("kernel", KERNELS)
def test_itf1788_vectors_are_contained(kernel: Any, itf1788_folder: Path) -> None:
    assert len(list(itf1788.cases(itf1788_folder, kernel.__name__))) >= 10
    assert not itf1788.missed(itf1788_folder, kernel.__name__, kernel, tight=False)


@pytest.mark.parametrize("kernel", KERNELS)
def test_the_empty_interval_stays_empty(kernel: Any) -> None:
    assert kernel(*EMPTY) == EMPTY


def test_values_that_are_doubles_are_exact() -> None:
    for kernel, value in ((exponential.exp, 1.0), (exponential.cosh, 1.0), (exponential.sinh, 0.0), (exponential.tanh, 0.0)):
        assert kernel(0.0, 0.0) == (value, value)
    for kernel in (exponential.asinh, exponential.atanh):
        assert kernel(-0.0, 0.0) == (0.0, 0.0)
    for kernel in (exponential.log, exponential.log2, exponential.log10, exponential.acosh):
        assert kernel(1.0, 1.0) == (0.0, 0.0)
    for k in range(-1074, 1024):
        assert exponential.exp2(float(k), float(k)) == (2.0**k, 2.0**k)
        assert exponential.log2(2.0**k, 2.0**k) == (k, k)
    for k in range(23):
        assert exponential.exp10(float(k), float(k)) == (10.0**k, 10.0**k)
        assert exponential.log10(10.0**k, 10.0**k) == (k, k)


@pytest.mark.parametrize(
    ("kernel", "operand", "result"),
    [
        (exponential.exp, ENTIRE, (0.0, math.inf)),
        (exponential.exp, (1e4, math.inf), (LARGEST, math.inf)),
        (exponential.exp, (-math.inf, -1e4), (0.0, TINY)),
        (exponential.log, ENTIRE, ENTIRE),
        (exponential.log, (-1.0, 0.0), EMPTY),
        (exponential.log, (0.0, 1.0), (-math.inf, 0.0)),
        (exponential.cosh, ENTIRE, (1.0, math.inf)),
        (exponential.sinh, (-1e4, 1e4), ENTIRE),
        (exponential.tanh, ENTIRE, (-1.0, 1.0)),
        (exponential.acosh, (-math.inf, 0.5), EMPTY),
        (exponential.acosh, ENTIRE, (0.0, math.inf)),
        (exponential.atanh, (-1.0, 1.0), ENTIRE),
        (exponential.atanh, (1.0, 1.0), EMPTY),
        (exponential.atanh, (-2.0, -1.0), EMPTY),
    ],
)
def test_limits_and_domains(kernel: Any, operand: itf1788.Pair, result: itf1788.Pair) -> None:
    assert kernel(*operand) == result


def test_pyinterval_agrees() -> None:
    pytest.importorskip("interval", reason="pyinterval is not installed; it needs a C compiler")
    from interval import imath, interval

    for x in np.clip(hard_numbers(500, 4), -700.0, 700.0).tolist():
        for name in ("exp", "sinh", "cosh", *(("log", "log2", "log10") if x > 0.0 else ())):
            ((low, high),) = getattr(imath, name)(interval[x, x])
            lower, upper = getattr(exponential, name)(x, x)
            assert lower <= low <= high <= upper, (name, x)
