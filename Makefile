# Two commands on a fresh machine: `make demo` localizes the embedded recording, `make test` runs the tests.
# Every command sets up what it needs in .venv, once: a stamp in there stands for a finished set-up.

PYTHON ?= python3
PYTEST_ARGS ?= --numprocesses auto --dist worksteal
export PYTHON

# What runs kernels in minutes with NUMBA_DISABLE_JIT=1: there, tests take few cases, and those that take many are left out.
_INTERVALS = angle arithmetic conversion double error_free exp_log integer interval literal narrowing reverse_integer reverse_powers
INTERPRETED = tests/test_lazy.py tests/contractors/test_interpreter.py tests/contractors/test_rounding.py \
    $(_INTERVALS:%=tests/contractors/intervals/test_%.py) tests/contractors/expressions/test_operation.py \
    tests/contractors/expressions/test_functions.py tests/contractors/paving tests/contractors/solving \
    tests/maps tests/membership tests/lidar/search tests/bouncing/automata
FAST = not slow and not data

.PHONY: help demo test check interpreted coverage lint docs smoke wheel interpreters requirements clean
.NOTPARALLEL:

help:
	@echo "make demo           localize the embedded recording; the result is in out/demo"
	@echo "make test           run the tests (IAL_DATA and IAL_ITF1788 name the folders of the test data)"
	@echo "make check          lint, types and the fast tests"
	@echo "make interpreted    a part of the tests without compiled kernels, as a debugger sees them"
	@echo "make coverage       which lines the tests reach"
	@echo "make lint           ruff and mypy"
	@echo "make docs           the documentation, in docs/_build/html"
	@echo "make smoke          install as a user does, into an empty environment, and try every command"
	@echo "make wheel          a wheel for this system and Python that carries compiled kernels, in dist"
	@echo "make interpreters   try every Python from 3.10 to 3.13 that this machine has"
	@echo "make requirements   resolve the pinned versions anew"
	@echo "make clean          remove the environment and everything that was made"

demo: .venv/.run
	.venv/bin/ial localize --out out/demo --overwrite

test: .venv/.test
	.venv/bin/pytest $(PYTEST_ARGS)

check: lint .venv/.test
	.venv/bin/pytest $(PYTEST_ARGS) -m "$(FAST)"

interpreted: .venv/.test
	NUMBA_DISABLE_JIT=1 .venv/bin/pytest $(PYTEST_ARGS) -m "$(FAST) and not many" $(INTERPRETED)

# Coverage does not see into compiled kernels, so a second run interprets them.
coverage: .venv/.test
	.venv/bin/coverage erase
	.venv/bin/coverage run -m pytest $(PYTEST_ARGS)
	NUMBA_DISABLE_JIT=1 .venv/bin/coverage run -m pytest $(PYTEST_ARGS) -m "$(FAST) and not many" $(INTERPRETED)
	.venv/bin/coverage combine --quiet
	.venv/bin/coverage report

lint: .venv/.lint
	.venv/bin/ruff check
	.venv/bin/ruff format --check
	.venv/bin/mypy

docs: .venv/.docs
	rm -rf docs/api/generated docs/_build
	.venv/bin/sphinx-build --fail-on-warning --keep-going --quiet -b html docs docs/_build/html

smoke:
	.ci/smoke

wheel: .venv/.run
	requirements/wheel

interpreters: .venv/.run
	.ci/interpreters

requirements: .venv/.pin
	requirements/compile

clean:
	rm -rf .venv out build dist docs/_build docs/api/generated ial.egg-info .pytest_cache .mypy_cache .ruff_cache .hypothesis .coverage*

.venv/.%: requirements/%.txt requirements/tools.txt requirements/build-constraints.txt pyproject.toml
	requirements/set-up $*
