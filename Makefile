# `make help` lists the targets. ROS=jazzy|kilted chooses whose wheels to run with, PYTHON= names
# an interpreter, OUT= and SEED= belong to the demo.

ROS ?= jazzy
VENV_jazzy := .venv
VENV_kilted := .venv-kilted
VENV := $(or $(VENV_$(ROS)),$(error ROS=$(ROS) is not known: use ROS=jazzy or ROS=kilted))
LOCK := $(VENV:.venv%=requirements%.lock)
OUT ?= out/demo
SUITS := import sys, venv, ensurepip; sys.exit(not (3, 10) <= sys.version_info[:2] <= (3, 13))
PYTHON ?= $(shell for p in python3 python3.13 python3.12 python3.11 python3.10; do \
	if $$p -c '$(SUITS)' 2>/dev/null; then echo $$p; break; fi; done)

.PHONY: help venv demo test lint clean

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z]+:.*## / {printf "make %-6s %s\n", $$1, $$2}' Makefile

venv: $(VENV)/.ready ## make the environment that all else runs in

demo: $(VENV)/.ready ## drive, record, find the hidden effect, drive again; OUT=folder SEED=number
	$(VENV)/bin/python -m diffbot_sim demo --out $(OUT) $(if $(SEED),--seed $(SEED))

test: lint ## lint, then the whole test suite, two files at a time
	$(VENV)/bin/python -m pytest -n 2 --dist loadfile

lint: $(VENV)/.ready ## format, style, types
	$(VENV)/bin/ruff format --check .
	$(VENV)/bin/ruff check .
	$(VENV)/bin/mypy

clean: ## remove all that make and colcon made
	rm -rf $(VENV_jazzy) $(VENV_kilted) out build install log *.egg-info
	rm -rf .hypothesis .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -prune -exec rm -rf {} +

$(VENV)/.ready: $(LOCK) setup.py
	@$(or $(PYTHON),false) -c '$(SUITS)' 2>/dev/null || { echo >&2 'No usable Python: needs' \
	  '3.10 to 3.13 with venv and pip (Debian: apt install python3-venv).' \
	  'Name one with make PYTHON=/path/to/python3'; exit 1; }
	@echo 'Making $(VENV) with $(PYTHON): about 130 packages and 1 GB, once; a minute or a few.'
	$(PYTHON) -m venv $(VENV)
	$(VENV)/bin/python -m pip install --disable-pip-version-check -r $(LOCK)
	$(VENV)/bin/python -m pip install --disable-pip-version-check --no-deps --no-build-isolation -e .
	@touch $@
