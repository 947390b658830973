# Two commands on a fresh machine: `make demo` localizes the embedded recording, `make test` runs the tests.
# Every command sets up what it needs in .venv, once: a stamp in there stands for a finished set-up.

PYTHON ?= python3
PYTEST_ARGS ?= --numprocesses auto --dist worksteal
export PYTHON

.PHONY: help demo test lint docs smoke wheel requirements clean
.NOTPARALLEL:

help:
	@echo "make demo           localize the embedded recording; the result is in out/demo"
	@echo "make test           run the tests (IAL_DATA and IAL_ITF1788 name the folders of the test data)"
	@echo "make lint           ruff and mypy"
	@echo "make docs           the documentation, in docs/_build/html"
	@echo "make smoke          install as a user does, into an empty environment, and try every command"
	@echo "make wheel          a wheel for this system and Python that carries compiled kernels, in dist"
	@echo "make requirements   resolve the pinned versions anew"
	@echo "make clean          remove the environment and everything that was made"

demo: .venv/.run
	.venv/bin/ial localize --out out/demo --overwrite

test: .venv/.test
	.venv/bin/pytest $(PYTEST_ARGS)

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

requirements: .venv/.pin
	requirements/compile

clean:
	rm -rf .venv out build dist docs/_build docs/api/generated ial.egg-info .pytest_cache .mypy_cache .ruff_cache .hypothesis

.venv/.%: requirements/%.txt requirements/tools.txt requirements/build-constraints.txt pyproject.toml
	requirements/set-up $*
