# Every target sets up what it needs by itself; nothing has to be typed before it.
# Pass a command's options on with ARGS, as in: make demo ARGS="--port 8001"

VENV := .venv
PEERS := $(VENV)/peers
PYTHON := $(VENV)/bin/python
PIP := $(PYTHON) -m pip --disable-pip-version-check -qq
WITH_NODE := scripts/with-node
ARGS ?=
PYTEST_ARGS ?=

.DEFAULT_GOAL := help
.PHONY: help demo serve web test test-web lint lint-python lint-web bench clean
.DELETE_ON_ERROR:

help:
	@echo "make demo    a server, a learner and a bot on this machine; prints one link to open"
	@echo "make serve   the server alone"
	@echo "make test    every check and every test"
	@echo "make lint    the checks alone: style, types, import contracts"
	@echo "make bench   measurements, as tables"
	@echo "make web     build the page"
	@echo "make clean   remove what the others made, but no store and no checkpoint"

# --- what a reader types

demo: $(VENV)/.learner $(if $(filter yes,$(shell scripts/page-is-current)),,web/dist/index.html)
	@exec $(PYTHON) -m waypost_learner.cli demo $(ARGS)

serve: $(VENV)/.base $(if $(filter yes,$(shell scripts/page-is-current)),,web/dist/index.html)
	@exec $(PYTHON) -m waypost_learner.cli serve $(ARGS)

web: web/dist/index.html

# pytest comes last, so that its summary is the last thing said. Not with --dist loadscope: it runs tests of one name,
# as those made of the API's description are, once.
test: lint test-web $(VENV)/.dev web/dist/index.html
	@SYSTEM_PACKAGES="$(SYSTEM_PACKAGES)" scripts/postgresql
	@chromium="$$(SYSTEM_PACKAGES="$(SYSTEM_PACKAGES)" scripts/chromium)" && \
	  export WAYPOST_CHROMIUM="$$chromium" && exec $(PYTHON) -m pytest -n auto --maxprocesses 4 --dist worksteal $(PYTEST_ARGS)

test-web: web/node_modules/.stamp
	@cd web && ../$(WITH_NODE) npm test --silent

lint: lint-python lint-web

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
	@cd web && ../$(WITH_NODE) npm run --silent types:check

bench: $(VENV)/.dev $(PEERS)/.installed
	@set -e; for file in bench/*.py; do echo "== $$file"; PYTHONPATH=. $(PYTHON) "$$file" $(ARGS); done

clean:
	rm -rf $(VENV) web/node_modules web/dist server/waypost_server/static .mypy_cache .ruff_cache .pytest_cache .import_linter_cache \
	  .hypothesis build dist
	find sdk server learner tests bench -name __pycache__ -type d -prune -exec rm -rf {} +

# --- how it is set up; a stamp says that a step is done for what is in pyproject.toml or package-lock.json now

# A virtual environment of another folder, or one whose Python is gone, is no good: forget its stamps.
ifneq ($(shell scripts/venv-works $(VENV)),yes)
$(shell rm -f $(VENV)/.made $(VENV)/.base $(VENV)/.learner $(VENV)/.dev)
endif

ifneq ($(shell scripts/venv-works $(PEERS)),yes)
$(shell rm -f $(PEERS)/.installed)
endif

$(VENV)/.made:
	@scripts/make-venv $(VENV)

$(VENV)/.base: pyproject.toml $(VENV)/.made
	@echo "Installing the server's Python packages."
	@$(PIP) install -e .
	@touch $@

$(VENV)/.learner: pyproject.toml $(VENV)/.made
	@echo "Installing the Python packages; PyTorch is large, so the first time takes a minute or more."
	@$(PIP) install -e '.[learner]'
	@touch $(VENV)/.base $@

$(VENV)/.dev: pyproject.toml $(VENV)/.made
	@echo "Installing the Python packages, those of the tests too; PyTorch is large, so the first time takes a minute or more."
	@$(PIP) install -e '.[learner,dev]'
	@touch $(VENV)/.base $(VENV)/.learner $@

# What bench/ measures beside ours needs packages that ours cannot live with. Without it the tables say so.
$(PEERS)/.installed: bench/peers/requirements.txt $(VENV)/.made
	@echo "Installing what the measurements compare with; it has a PyTorch of its own, so this takes some minutes."
	@if PYTHON_FOR_VENV=$(PYTHON) scripts/make-venv $(PEERS) && \
	  $(PEERS)/bin/python -m pip --disable-pip-version-check -qq install -r $<; \
	then touch $@; else echo "It could not be installed; the measurements go on without it."; fi

# Where there is no recent Node, scripts/with-node brings one into the virtual environment.
web/node_modules/.stamp: web/package.json web/package-lock.json | $(VENV)/.made
	@echo "Installing the page's npm packages."
	@cd web && ../$(WITH_NODE) npm ci --no-audit --no-fund --loglevel=error
	@touch $@

web/dist/index.html: web/node_modules/.stamp web/index.html web/vite.config.ts web/svelte.config.js web/tsconfig.json \
  $(shell find web/src web/public -type f ! -name '*.test.ts')
	@echo "Building the page."
	@cd web && ../$(WITH_NODE) npm run --silent build -- --logLevel warn
	@touch $@
