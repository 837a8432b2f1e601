# Everything here works from a fresh clone: the commands make .venv in the checkout and install into it.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check
WORKERS ?= 3
MINUTES ?= 60

.DEFAULT_GOAL := help
.PHONY: help demo test check lint types house docs page bench soak release clean lock

help:  ## Show the commands.
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## (.*)/  make \1\t\2/'

# Hundreds of short processes import the package: without compiled files each of them takes half a second longer.
unexport PYTHONDONTWRITEBYTECODE
# Node comes from a wheel; npm and what it installs look for it on the PATH.
export PATH := $(CURDIR)/$(BIN):$(PATH)

$(BIN)/python:
	$(PYTHON) -m venv $(VENV)

# uv installs in seconds what takes pip two minutes. It asks the index that pip asks; where it cannot be had or does not get
# there, pip installs. Neither compiles: what is imported is compiled then, and that is a third of it.
INDEX = $(shell $(BIN)/python -m pip config list 2> /dev/null | sed -n "s/^[^=]*[.]index-url='\(.*\)'/UV_DEFAULT_INDEX=\1/p" | head -n 1)
INSTALL = install() { $(INDEX) $(BIN)/uv pip install --quiet --python $(BIN)/python --no-deps "$$@" || $(PIP) --no-compile --no-deps "$$@"; }; install

$(VENV)/uv.stamp: requirements-uv.lock | $(BIN)/python
	-$(PIP) --no-deps --require-hashes --requirement requirements-uv.lock
	@touch $@

# The locks name every package that is needed, with the digests of its files.
$(VENV)/run.stamp: pyproject.toml requirements.lock | $(VENV)/uv.stamp
	$(INSTALL) --require-hashes --requirement requirements.lock
	$(INSTALL) --no-build-isolation --editable .
	@touch $@

# The documentation runs what it shows, cells with meshes and servers among it: it needs what the tests need, and Sphinx.
$(VENV)/test.stamp: $(VENV)/run.stamp
$(VENV)/docs.stamp: $(VENV)/test.stamp
$(VENV)/test.stamp $(VENV)/docs.stamp: $(VENV)/%.stamp: requirements-%.lock
	$(INSTALL) --require-hashes --requirement $<
	@touch $@

# Where the system has no Chromium and Playwright's cannot be had, the tests say so at their end.
$(VENV)/browser.stamp: $(VENV)/test.stamp
	@for name in chromium-headless-shell chromium google-chrome; do command -v $$name > /dev/null && exit; done; $(BIN)/playwright install --only-shell chromium > /dev/null 2>&1 || true
	@touch $@

demo: $(VENV)/run.stamp  ## Set up, then assess the arm of the paper over its region and write demo/report.html.
	rm -rf demo
	$(BIN)/holdfast assess pa10-9dof --poses 2000 --seed 1 --out demo

page/node_modules/.package-lock.json: page/package.json page/package-lock.json | $(VENV)/test.stamp
	cd page && npm ci --no-audit --no-fund --silent
	@touch $@

page: page/node_modules/.package-lock.json  ## Build the experiment's page into the package.
	cd page && npm run build

test: lint types page/node_modules/.package-lock.json $(VENV)/browser.stamp  ## Set up, then run lint, types and all tests.
	$(BIN)/python -m pytest -n $(WORKERS) --dist loadfile --no-loadscope-reorder --durations=40

check: lint types page/node_modules/.package-lock.json  ## Before a pull request: lint, types and the quick tests of every package.
	$(BIN)/python -m pytest -n $(WORKERS) --dist loadfile --no-loadscope-reorder -m "not slow" --ignore tests/browser

lint: $(VENV)/test.stamp
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports --no-cache --no-logo
	$(BIN)/python -m tools.house

house: $(VENV)/test.stamp  ## Count what the rules of the house forbid: circles of files, shadowed names, retired words, ...; part of lint.
	$(BIN)/python -m tools.house

types: $(VENV)/test.stamp
	$(BIN)/mypy

docs: $(VENV)/docs.stamp  ## Build the documentation into docs/_build/html; a warning is an error.
	$(BIN)/python -m sphinx -W --keep-going -q -b html docs docs/_build/html

bench: $(VENV)/run.stamp  ## Run the benchmarks beside their peers (its own environment, large downloads).
	$(PYTHON) -m venv $(VENV)-bench
	$(VENV)-bench/bin/python -m pip install --quiet --no-deps --require-hashes --requirement requirements.lock
	$(VENV)-bench/bin/python -m pip install --quiet --no-deps --no-build-isolation --editable .
	$(VENV)-bench/bin/python -m pip install --quiet --requirement benchmarks/requirements.txt
	$(VENV)-bench/bin/python benchmarks/run_all.py

soak: $(VENV)/test.stamp  ## The attacks in full: 10 minutes of load, 1,500 silent sockets, malformed messages, changed bits, damaged inputs, 1,000 rounds of forks; then an hour of the studio. Two hours and a half.
	$(BIN)/python tests/soak.py
	$(BIN)/python -m tests.interface.studio.soak --minutes $(MINUTES)

SCHEMA = $(VENV)-release/bin/check-jsonschema --builtin-schema vendor.

release: $(VENV)/run.stamp  ## Try a release: what must agree, wheel and sdist, the main job from them in a bare environment. TAG=--tag tags.
	$(PYTHON) -m venv $(VENV)-release
	$(VENV)-release/bin/python -m pip install --quiet "check-jsonschema>=0.39"
	$(SCHEMA)github-workflows .github/workflows/*.yml
	$(SCHEMA)github-issue-forms $(filter-out %/config.yml,$(wildcard .github/ISSUE_TEMPLATE/*.yml))
	$(SCHEMA)citation-file-format CITATION.cff
	$(BIN)/python -m tools.release $(TAG)

# One resolution for every Python from 3.11 on and every system; the locks of tests and documentation hold what run does not.
LOCK = $(VENV)-lock/bin/uv pip compile pyproject.toml --quiet --universal --python-version 3.11 --fork-strategy fewest \
	--generate-hashes --no-annotate --no-header
MORE = $(LOCK) --constraint $(VENV)-lock/all $$(sed -nE 's/^([a-z0-9.-]+)==.*/--no-emit-package \1/p' requirements.lock)

lock:  ## Write the requirements*.lock anew from pyproject.toml.
	rm -rf $(VENV)-lock && $(PYTHON) -m venv $(VENV)-lock
	$(VENV)-lock/bin/python -m pip install --quiet uv packaging
	$(LOCK) --extra report --group build --group test --group docs --output-file $(VENV)-lock/all
	$(LOCK) --constraint $(VENV)-lock/all --extra report --group build --output-file requirements.lock
	$(MORE) --group test --output-file requirements-test.lock
	$(MORE) --group docs --output-file requirements-docs.lock
	echo uv | $(LOCK:pyproject.toml=-) --output-file requirements-uv.lock
	$(VENV)-lock/bin/python -m tools.wheels
	rm -rf $(VENV)-lock

clean:  ## Remove what the commands made.
	rm -rf $(VENV) $(VENV)-bench $(VENV)-release page/node_modules demo docs/_build docs/gallery docs/commands docs/api/classes .mypy_cache .ruff_cache .pytest_cache
