# make run    set up, start the control room with a demonstration test, and print its address
# make test   set up, check and test everything, and measure line coverage (at least 90 % of the product)
# make check  set up and check only: format, docstrings, types of Python and JavaScript, imports, spelling
# make setup  set up only: .venv, browser libraries, compiled engine
#
# Options: RTHS_PORT=8001 is the port of `make run`, RTHS_DATA=FOLDER its data folder, PYTHON=... the Python to use.
# PYTEST="tests/engine -k word" gives pytest arguments; coverage is then not measured.
# OPENSEES="--only specimen-gap --keep kept" gives arguments of `make prove-opensees`, CHAOS="--seed 7 --store sqlite" those of `make chaos`.
# FUZZ="--minutes 60 --seed 7" gives arguments of `make fuzz`.

VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --quiet --disable-pip-version-check
STAMPS := $(VENV)/stamps
VENDOR := frontend/static/vendor
ENGINE := $(shell find rths_engine -name '*.py')
PYTEST ?=
OPENSEES ?=
CHAOS ?=
FUZZ ?= --minutes 10
LOCK ?=

# Tests start many processes of the program, each of which would compile its modules anew.
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := setup
.DELETE_ON_ERROR:
.PHONY: setup run test test-clone test-guides chaos check docs migration bench figures fuzz prove prove-opensees browser postgres compiler opensees lock audit-dependencies sbom clean

setup: $(STAMPS)/package $(VENDOR)/.installed $(STAMPS)/compiled

run: setup
	@$(BIN)/rths serve --demo --local

test: setup browser postgres compiler opensees check
	$(BIN)/pytest -n 2 --dist loadfile --durations 25 $(if $(PYTEST),,--cov) $(PYTEST)

test-clone: setup
	$(BIN)/pytest -m slow tests/test_fresh_clone.py $(PYTEST)

# Follow docs/guides to the letter, each in a copy of the project.
test-guides: setup
	$(BIN)/pytest -m slow tests/test_guides.py $(PYTEST)

# Measure times on this machine, and compare with OpenSees if it is installed, and with pyarrow and polars: docs/benchmarks.md.
bench: setup
	@$(BIN)/python -c 'import polars, pyarrow' 2>/dev/null || $(PIP) install --no-build-isolation -e '.[bench]'
	$(BIN)/python -m benchmarks

# Figures of many people, runs and workers, and of Abort under load, on an otherwise idle machine: docs/scale.md. Takes 30 minutes.
figures: setup postgres
	$(BIN)/python -m benchmarks.abort
	$(BIN)/python -m benchmarks.crowd
	$(BIN)/python -m benchmarks.run_table
	$(BIN)/python -m benchmarks.sweep_workers
	$(BIN)/python -m benchmarks.scale

# Send made requests to every operation of the REST interface: docs/fuzzing.md.
fuzz: setup
	$(BIN)/python -m tests.fuzz $(FUZZ)

# Score diagnoses on recordings with known left-out physics: docs/proof.md. Takes 30 to 60 minutes.
prove: setup
	$(BIN)/rths prove --cases 300 --json proof.json --picture proof.svg --table

# Diagnose recordings that conceal material laws of OpenSees: docs/proof.md. Takes 5 to 10 minutes.
prove-opensees: setup opensees
	$(BIN)/python -m tests.opensees $(OPENSEES)

# Kill, fill, cut and turn back everything under 200 tests and a sweep, on both stores: docs/chaos.md. Takes 20 to 60 minutes.
chaos: setup postgres compiler
	$(BIN)/python -m tests.chaos $(CHAOS)

check: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/codespell -D -
	$(BIN)/python -m app.npm_parts check

# Write a migration to the present models: make migration MESSAGE="measure of ..."
migration: setup
	$(BIN)/python -m app.new_migration "$(MESSAGE)"
	@$(BIN)/ruff format --quiet migrations

# Write the generated tables into docs/*.md: app/documents.
docs: setup
	$(BIN)/python -m app.documents

clean:
	rm -rf $(VENV) $(VENDOR) frontend/node_modules *.egg-info build .coverage* .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# A step touches its stamp last: after a failure there is no stamp, and the step runs again.

$(STAMPS)/python:
	@for python in $(PYTHON) python3.11 python3 python3.12 python3.13 python3.14; do \
	    if $$python -c 'import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then \
	        echo "Making $(VENV) with $$($$python --version)"; $$python -m venv $(VENV) && mkdir -p $(STAMPS) && touch $@; exit; \
	    fi; \
	done; \
	echo "There is no Python 3.11 or newer with the module venv (on Debian: apt-get install python3 python3-venv)." >&2; \
	echo "Install Python, or give its path: make setup PYTHON=/path/to/python3.11" >&2; exit 1

$(STAMPS)/dependencies: requirements.lock $(STAMPS)/python
	$(PIP) install --no-deps --require-hashes -r requirements.lock
	@touch $@

$(STAMPS)/package: pyproject.toml $(STAMPS)/dependencies
	$(PIP) install --no-deps --no-build-isolation -e .
	@$(PIP) check
	@touch $@

$(VENDOR)/.installed: frontend/package.json frontend/package-lock.json frontend/.npmrc app/npm_parts.py $(STAMPS)/python
	$(BIN)/python -m app.npm_parts
	@touch $@

$(STAMPS)/compiled: $(ENGINE) $(STAMPS)/package
	$(BIN)/python -m rths_engine.running.warm
	@touch $@

# The browser tests use Debian's Chromium; no test tool downloads a browser.
browser:
	@command -v chromium >/dev/null || { \
	    if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	        apt-get update -qq && apt-get install -y -qq --no-install-recommends chromium; \
	    else \
	        echo "There is no Chromium, so the browser tests are skipped (on Debian: apt-get install chromium)." >&2; \
	    fi; }

# The tests of workers on PostgreSQL start a server of their own.
postgres:
	@ls /usr/lib/postgresql/*/bin/initdb >/dev/null 2>&1 || command -v initdb >/dev/null || { \
	    if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	        apt-get update -qq && apt-get install -y -qq --no-install-recommends postgresql; \
	    else \
	        echo "There is no PostgreSQL, so its tests are skipped (on Debian: apt-get install postgresql)." >&2; \
	    fi; }

# The tests of external rigs compile an FMU.
compiler:
	@command -v cc >/dev/null || command -v gcc >/dev/null || { \
	    if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	        apt-get update -qq && apt-get install -y -qq --no-install-recommends gcc libc6-dev; \
	    else \
	        echo "There is no C compiler, so the tests of FMUs are skipped (on Debian: apt-get install gcc libc6-dev)." >&2; \
	    fi; }

# OpenSees, the independent solver for tests and benchmarks; not installed with the product.
opensees: $(STAMPS)/package
	@$(BIN)/python -c 'import openseespy.opensees' 2>/dev/null || { \
	    $(PIP) install --no-build-isolation -e '.[opensees]'; \
	    if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	        apt-get update -qq && apt-get install -y -qq --no-install-recommends libblas3 liblapack3; \
	    fi; \
	    $(BIN)/python -c 'import openseespy.opensees' || \
	        echo "OpenSees does not start, so its tests are skipped (on Debian: apt-get install libblas3 liblapack3)." >&2; }

# Write requirements.lock: every package that pyproject.toml leads to, on Linux, macOS and Windows with CPython 3.11 or newer, pinned
# to one version with the hashes of all files of its release. Pins stay where they are allowed; `make lock LOCK=--upgrade` renews them.
lock: $(STAMPS)/python
	@$(BIN)/python -c 'import uv' 2>/dev/null || $(PIP) install uv
	$(BIN)/uv pip compile pyproject.toml --extra test --universal --fork-strategy fewest --python-version 3.11 --generate-hashes --no-annotate --no-emit-index-url --no-emit-package pip \
	    --custom-compile-command 'make lock' --quiet --output-file requirements.lock $(LOCK)

# Check the licences of all dependencies, and ask for their known vulnerabilities: docs/supply-chain.md.
# Fails with "Error 3" where no vulnerability is known, but some packages were not checked.
audit-dependencies: setup
	$(BIN)/python -m app.supply_chain licences
	$(BIN)/python -m app.supply_chain advisories

# Write the list of all dependencies (CycloneDX JSON).
sbom: setup
	$(BIN)/python -m app.supply_chain sbom sbom.json
