# Everything here works from a fresh clone: the commands make .venv in the checkout and install into it.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
WORKERS ?= 2
MINUTES ?= 60

.DEFAULT_GOAL := help
.PHONY: help demo test lint types docs page bench soak clean lock

help:  ## Show the commands.
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## (.*)/  make \1\t\2/'

$(BIN)/python:
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade "pip>=25.1"

$(VENV)/run.stamp: pyproject.toml requirements.lock | $(BIN)/python
	$(BIN)/python -m pip install --quiet --constraint requirements.lock --editable .
	@touch $@

$(VENV)/test.stamp: $(VENV)/run.stamp
	$(BIN)/python -m pip install --quiet --constraint requirements.lock --group test
	@touch $@

$(VENV)/docs.stamp: $(VENV)/run.stamp
	$(BIN)/python -m pip install --quiet --constraint requirements.lock --group docs
	@touch $@

demo: $(VENV)/run.stamp  ## Set up, then assess the arm of the paper over its region and write demo/report.html.
	rm -rf demo
	$(BIN)/holdfast assess pa10-9dof --poses 2000 --seed 1 --out demo

page/node_modules/.package-lock.json: page/package.json page/package-lock.json
	cd page && npm ci --no-audit --no-fund --silent
	@touch $@

page: page/node_modules/.package-lock.json  ## Build the experiment's page into the package; needs Node 20.
	cd page && npm run build

test: lint types page/node_modules/.package-lock.json  ## Set up, then run lint, types and tests; needs Node 20 and Chromium.
	$(BIN)/python -m pytest -n $(WORKERS) --durations=40

lint: $(VENV)/test.stamp
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(VENV)/test.stamp
	$(BIN)/mypy

docs: $(VENV)/docs.stamp  ## Build the documentation into docs/_build/html; a warning is an error.
	$(BIN)/python -m sphinx -W --keep-going -q -b html docs docs/_build/html

bench: $(VENV)/run.stamp  ## Run the benchmarks beside their peers (its own environment, large downloads).
	$(PYTHON) -m venv $(VENV)-bench
	$(VENV)-bench/bin/python -m pip install --quiet --upgrade pip
	$(VENV)-bench/bin/python -m pip install --quiet --constraint requirements.lock --editable .
	$(VENV)-bench/bin/python -m pip install --quiet --requirement benchmarks/requirements.txt
	$(VENV)-bench/bin/python benchmarks/run_all.py

soak: $(VENV)/test.stamp  ## Load the server for 10 minutes, 100,000 malformed messages, 30 s without network, ...; an hour of the studio (80 minutes).
	$(BIN)/python tests/soak.py
	$(BIN)/python -m tests.studio.soak --minutes $(MINUTES)

lock:  ## Write requirements.lock anew from pyproject.toml.
	rm -rf $(VENV)-lock && $(PYTHON) -m venv $(VENV)-lock
	$(VENV)-lock/bin/python -m pip install --quiet --upgrade "pip>=25.1"
	$(VENV)-lock/bin/python -m pip install --quiet --editable . --group test --group docs
	$(VENV)-lock/bin/python -m pip freeze --exclude-editable > requirements.lock
	rm -rf $(VENV)-lock

clean:  ## Remove what the commands made.
	rm -rf $(VENV) $(VENV)-bench page/node_modules demo docs/_build docs/gallery .mypy_cache .ruff_cache .pytest_cache
