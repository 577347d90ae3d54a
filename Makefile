# Every target first installs what it needs, so no other command is necessary before it.
# ARGS passes options to the command: make demo ARGS="--port 8001"

VENV := .venv
PEERS := $(VENV)/peers
LABEL_STUDIO := $(VENV)/label-studio
PYTHON := $(VENV)/bin/python
PIP := $(PYTHON) -m pip --disable-pip-version-check -qq
WITH_NODE := scripts/with-node
ARGS ?=
PYTEST_ARGS ?=
WORKERS ?= 4

# Tests start hundreds of processes, each of which would compile all modules again.
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := help
.PHONY: help demo serve web docs docs-serve test test-web test-browsers lint lint-python lint-web bench \
  bench-label-studio soak mutants clean
.DELETE_ON_ERROR:

help:
	@echo "make demo    run a server, a learner and a bot on this machine; print a link to open"
	@echo "make serve   run only the server"
	@echo "make test    run every check and every test"
	@echo "make test-browsers  open the web app in Firefox and WebKit, which it installs (Debian, Ubuntu)"
	@echo "make lint    run only the checks: style, types, import contracts"
	@echo "make bench   measure, and print tables"
	@echo "make bench-label-studio  measure Waypost and Label Studio, which it installs, side by side"
	@echo "make soak    try for 10 minutes to make stores lose answers, and print counts"
	@echo "make mutants change the server's core in small ways, for an hour or more, and list what no test notices"
	@echo "make web     build the web app"
	@echo "make docs    build the documentation site into site/; make docs-serve shows it while you write"
	@echo "make clean   remove everything that the other targets made, except stores and checkpoints"

# --- targets for users

demo: $(VENV)/.learner $(if $(filter yes,$(shell scripts/page-is-current)),,web/dist/index.html)
	@exec $(PYTHON) -m waypost_learner.cli demo $(ARGS)

serve: $(VENV)/.base $(if $(filter yes,$(shell scripts/page-is-current)),,web/dist/index.html)
	@exec $(PYTHON) -m waypost_learner.cli serve $(ARGS)

web: web/dist/index.html

# Many tests wait for a browser or for another process, so there are four workers also where there are two cores. They
# use all cores already, so each computes with one thread.
# pytest runs last, so that its summary is the end of the output. It runs without --dist loadscope, which would run only
# one of several tests with the same name; the tests that are generated from the API's description have the same name.
test: $(VENV)/.dev web/node_modules/.stamp
	@$(MAKE) --no-print-directory -j 2 --output-sync=target lint-python lint-web docs test-web web/dist/index.html
	@SYSTEM_PACKAGES="$(SYSTEM_PACKAGES)" scripts/postgresql
	@chromium="$$(SYSTEM_PACKAGES="$(SYSTEM_PACKAGES)" scripts/chromium)" && \
	  export WAYPOST_CHROMIUM="$$chromium" OMP_NUM_THREADS=1 && \
	  exec $(PYTHON) -m pytest -n $(WORKERS) --dist worksteal $(PYTEST_ARGS)

test-web: web/node_modules/.stamp
	@cd web && ../$(WITH_NODE) npm test --silent

# Firefox and WebKit are not among the tests of `make test`, because they are large to install.
test-browsers: $(VENV)/.dev web/dist/index.html
	@SYSTEM_PACKAGES="$(SYSTEM_PACKAGES)" scripts/system-packages firefox-esr webkit2gtk-driver xvfb || \
	  echo "Nothing is installed here. The tests need Firefox, WebKitWebDriver and xvfb-run."
	@exec xvfb-run --auto-servernum $(PYTHON) -m pytest tests/browser/others $(PYTEST_ARGS)

docs: $(VENV)/.dev
	NO_MKDOCS_2_WARNING=1 $(PYTHON) -m mkdocs build --strict

docs-serve: $(VENV)/.dev
	@NO_MKDOCS_2_WARNING=1 exec $(PYTHON) -m mkdocs serve $(ARGS)

lint: lint-python lint-web docs

lint-python: $(VENV)/.dev
	$(PYTHON) -m ruff check
	$(PYTHON) -m ruff format --check
	$(PYTHON) -m mypy
	$(VENV)/bin/lint-imports

lint-web: web/node_modules/.stamp $(VENV)/.dev
	@cd web && ../$(WITH_NODE) npm run --silent check
	@cd web && ../$(WITH_NODE) npm run --silent lint
	@cd web && ../$(WITH_NODE) npm run --silent layers
	@cd web && ../$(WITH_NODE) npm run --silent format:check
	@cd web && ../$(WITH_NODE) npm run --silent texts:check
	@cd web && ../$(WITH_NODE) npm run --silent types:check

# Label Studio is not among the measurements of `make bench`, because it is large to install and slow to start.
bench: $(VENV)/.dev $(PEERS)/.installed
	@set -e; for file in $(filter-out bench/label_studio.py,$(sort $(wildcard bench/*.py))); do \
	  echo "== $$file"; PYTHONPATH=. $(PYTHON) "$$file" $(ARGS); done

bench-label-studio: $(VENV)/.dev $(LABEL_STUDIO)/.installed
	@PYTHONPATH=. exec $(PYTHON) bench/label_studio.py $(ARGS)

soak: $(VENV)/.dev
	@exec $(PYTHON) -m tests.soak $(ARGS)

mutants: $(VENV)/.dev
	@exec $(PYTHON) -m tests.mutants $(ARGS)

clean:
	rm -rf $(VENV) web/node_modules web/dist server/waypost_server/static site .mypy_cache .ruff_cache .pytest_cache .import_linter_cache \
	  .hypothesis .mutants build dist
	find sdk server learner tests bench -name __pycache__ -type d -prune -exec rm -rf {} +

# --- installation; a stamp file says that a step is done for the current pyproject.toml or package-lock.json

# A virtual environment that was made for another folder, or whose Python is missing, does not work: remove its stamps.
ifneq ($(shell scripts/venv-works $(VENV)),yes)
$(shell rm -f $(VENV)/.made $(VENV)/.base $(VENV)/.learner $(VENV)/.dev)
endif

ifneq ($(shell scripts/venv-works $(PEERS)),yes)
$(shell rm -f $(PEERS)/.installed)
endif

ifneq ($(shell scripts/venv-works $(LABEL_STUDIO)),yes)
$(shell rm -f $(LABEL_STUDIO)/.installed)
endif

$(VENV)/.made:
	@scripts/make-venv $(VENV)

$(VENV)/.base: pyproject.toml $(VENV)/.made
	@echo "Installing the server's Python packages."
	@$(PIP) install -e .
	@touch $@

$(VENV)/.learner: pyproject.toml $(VENV)/.made
	@echo "Installing the Python packages. PyTorch is large, so the first time takes a minute or more."
	@$(PIP) install -e '.[learner,atari]'
	@touch $(VENV)/.base $@

$(VENV)/.dev: pyproject.toml $(VENV)/.made
	@echo "Installing the Python packages, including those of the tests; PyTorch is large, so the first time takes a minute or more."
	@$(PIP) install -e '.[learner,dev]'
	@touch $(VENV)/.base $(VENV)/.learner $@

# The libraries that bench/ compares with ours need packages that conflict with ours, so they have their own environment.
# If they are missing, the tables say so.
$(PEERS)/.installed: bench/peers/requirements.txt $(VENV)/.made
	@echo "Installing the libraries for the comparisons; they include another PyTorch, so this takes some minutes."
	@if PYTHON_FOR_VENV=$(PYTHON) scripts/make-venv $(PEERS) && \
	  $(PEERS)/bin/python -m pip --disable-pip-version-check -qq install -r $<; \
	then touch $@; else echo "They could not be installed; the measurements continue without them."; fi

$(LABEL_STUDIO)/.installed: bench/peers/label-studio.txt $(VENV)/.made
	@echo "Installing Label Studio for the comparison (1 GB), which takes some minutes."
	@if PYTHON_FOR_VENV=$(PYTHON) scripts/make-venv $(LABEL_STUDIO) && \
	  $(LABEL_STUDIO)/bin/python -m pip --disable-pip-version-check -qq install -r $<; \
	then touch $@; else echo "Label Studio could not be installed, so nothing can be measured; the reason is above."; fi

# If there is no recent Node, scripts/with-node installs one in the virtual environment.
web/node_modules/.stamp: web/package.json web/package-lock.json | $(VENV)/.made
	@echo "Installing the npm packages of the web app."
	@cd web && ../$(WITH_NODE) npm ci --no-audit --no-fund --loglevel=error
	@touch $@

web/dist/index.html: web/node_modules/.stamp web/index.html web/vite.config.ts web/svelte.config.js web/wuchale.config.js web/tsconfig.json \
  $(shell find web/src web/public -type f ! -name '*.test.ts' ! -path '*/.wuchale/*' ! -name data.js)
	@echo "Building the web app."
	@cd web && ../$(WITH_NODE) npm run --silent build -- --logLevel warn
	@touch $@
