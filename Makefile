# SPDX-License-Identifier: GPL-3.0-or-later
# `make help` lists what there is. Needs Python 3.11 or 3.13 (PYTHON=/path/to/one to choose it); the rest is installed.

VENV := .venv
RUN := $(VENV)/bin/python
SCENE ?= sample_blends/cornell_suzanne_point.blend
OUT ?= out
SIZE ?= 400x300
BENCH ?= docs/benchmarks
BENCH_SCENES ?= $(addprefix sample_blends/,cornell_suzanne_point.blend cornell_suzanne_area.blend two_rooms.blend \
	colonnade.blend glossy_steps.blend)

.DEFAULT_GOAL := help
.PHONY: help setup render bench test lint package clean

help: ## List the targets
	@sed -nE 's/^([a-z]+):.*## (.*)/\1|\2/p' Makefile | while IFS='|' read -r name text; do printf 'make %-9s%s\n' "$$name" "$$text"; done

setup: $(VENV)/.libraries ## Install everything into .venv, and the system libraries when run as root
	@echo "All that is needed is installed; make help lists what can be done with it."

render: $(VENV)/.libraries ## Render a sample scene; SCENE=FILE.blend, OUT=FOLDER and SIZE=WxH choose others
	@mkdir -p $(OUT)
	$(RUN) -m svo_engine render $(SCENE) --out $(OUT)/ --size $(SIZE)

bench: $(VENV)/.libraries ## Measure run time against error beside Cycles; BENCH=FOLDER and BENCH_SCENES="A.blend B.blend"
	$(RUN) -m svo_engine bench --scenes $(BENCH_SCENES) --size $(SIZE) --out $(BENCH)/data/cpu
	$(RUN) -m svo_engine bench --thesis --scaling --out $(BENCH)/data/cpu
	$(RUN) -m svo_engine bench --report $(BENCH)

test: lint $(VENV)/.libraries ## Run the linters and all tests
	$(RUN) -m pytest

lint: $(VENV)/.packages ## Check style, types and the rules of the house
	$(RUN) -m ruff check --output-format concise --quiet
	$(RUN) -m mypy
	$(RUN) -m tools.house

package: $(VENV)/.packages ## Build the extension's zip files for Linux and Windows into dist/
	$(RUN) -m tools.package

clean: ## Remove everything that make has made
	rm -rf $(VENV) out dist wheels .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# Empty files that say what is done, so that it is done once
$(VENV)/.packages: requirements/run.txt requirements/dev.txt
	@tools/setup.sh venv $(VENV)
	@touch $@

$(VENV)/.libraries: $(VENV)/.packages
	@tools/setup.sh libraries $(VENV)
	@touch $@
