"""Every public function that computes a bound refuses to work while the processor does not round to nearest (the guarantee's guard)."""

import subprocess
import sys
from pathlib import Path

import pytest

import ial.contractors as toolkit
from tests.contractors import guarded
from tests.contractors.test_rounding import FLUSH, MODES, unknown_processor

ROOT = Path(__file__).resolve().parents[2]


def answered(where: str, field: str, value: int) -> list[str]:
    command = [sys.executable, "-m", "tests.contractors.guarded", where, field, str(value)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_every_public_name_is_tried_or_known_to_compute_no_bound() -> None:
    tried = {name.partition(".")[0] for name in guarded.works()}
    assert tried | guarded.EXACT == set(toolkit.__all__)
    assert not tried & guarded.EXACT - {"Constraint", "ConstraintFamily", "Operation", "Paving"}


@pytest.mark.slow
def test_what_is_tried_works_while_the_mode_is_right() -> None:
    for name, work in guarded.works().items():
        try:
            work()
        except Exception as error:
            pytest.fail(f"{name}: {error!r}")


@pytest.mark.slow
@unknown_processor
@pytest.mark.parametrize("mode", ["down", "up", "zero"])
def test_everything_refuses_another_rounding_mode(mode: str) -> None:
    assert answered("caller", "mode", MODES[mode]) == []


@pytest.mark.slow
@pytest.mark.skipif(FLUSH is None or sys.platform != "linux", reason="the layout of fenv_t is known for Linux on x86 and ARM")
def test_everything_refuses_to_flush_subnormals() -> None:
    assert FLUSH is not None
    assert answered("caller", str(FLUSH[0]), FLUSH[1]) == []


@pytest.mark.slow
@unknown_processor
@pytest.mark.parametrize("mode", ["down", "up", "zero"])
def test_what_is_shared_among_threads_refuses_workers_that_were_started_in_another_mode(mode: str) -> None:
    shared = {"Annulus", "Boxes", "Constraint.contract", "Function.jacobian", "Newton", "Union", "fixpoint", "transform"}
    assert not shared & set(answered("workers", "mode", MODES[mode]))
