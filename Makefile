# TRG for Blender. On a fresh machine with Python 3.11 or 3.13, a C++ compiler, make and git:
#   make render      set up .venv, build, render examples/fence.trg to out/fence.png
#   make test        the same set-up for both Pythons, then every test
#   make lint        ruff, mypy, clang-format
#   make extension   dist/trg-*.zip for Blender's Edit > Preferences > Get Extensions > Install from Disk
#   make clean       remove what was built; .venv and .venv/* stay (make distclean removes them too)

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DELETE_ON_ERROR:
.SUFFIXES:
# Stamps between a goal and its sources are kept; make would delete them as intermediate files.
.SECONDARY:
.PHONY: render test lint extension wheel clean distclean help

VERSIONS := 3.11 3.13
# The legs are the supported versions that this machine has; the newest one renders and builds.
LEGS := $(foreach v,$(VERSIONS),$(if $(shell tools/find_python.sh $(v)),$(v)))
MISSING := $(filter-out $(LEGS),$(VERSIONS))
LEG := $(lastword $(LEGS))
PYTHON = .venv/$(LEG)/bin/python
JOBS ?= $(shell nproc 2>/dev/null || sysctl -n hw.ncpu)

WHEEL := build/wheelhouse/.done
SOURCES := $(shell find native -type f -not -path '*/tests/*' 2>/dev/null)
PACKAGE := $(shell find trg_blender stl examples -type f -not -name '*.pyc' 2>/dev/null)

help:
	@sed -n '1,/^$$/s/^# \{0,1\}//p' Makefile

render: $(LEG:%=.venv/%/.ready)
	@$(if $(LEG),,echo "make: no Python 3.11 or 3.13 was found on PATH, in pyenv or in uv" >&2; exit 4)
	@mkdir -p out
	.venv/$(LEG)/bin/trg render examples/fence.trg -o out/fence.png --report out/fence.json

test: $(LEGS:%=.venv/%/.ready) dist/.extension
	@$(if $(LEG),,echo "make: no Python 3.11 or 3.13 was found on PATH, in pyenv or in uv" >&2; exit 4)
	@$(PYTHON) tools/run_tests.py $(addprefix --leg ,$(LEGS)) $(addprefix --missing ,$(MISSING))

lint: .venv/$(LEG)/.lint
	@$(PYTHON) tools/lint.py

wheel: $(WHEEL)

extension: dist/.extension
	@ls dist/*.zip

# A leg is ready when its requirements, the native wheel and the package itself are in its .venv.
# Pip runs one after the other (order-only on the leg before): two at a time fight over the cache.
.venv/%/.requirements: requirements/%.txt requirements/common.txt
	@[ -x .venv/$*/bin/python ] || tools/step.sh "Python $*: make .venv/$*" \
	    "$$(tools/find_python.sh $*)" -m venv .venv/$*
	@tools/step.sh "Python $*: install requirements" \
	    .venv/$*/bin/python -m pip install --progress-bar off -r requirements/$*.txt
	@tools/step.sh "Python $*: load Blender's module" .venv/$*/bin/python -c "import bpy"
	@touch $@

.venv/%/.ready: .venv/%/.requirements $(WHEEL) pyproject.toml
	@tools/step.sh "Python $*: install trg_native" .venv/$*/bin/python -m pip install \
	    --no-deps --no-index --force-reinstall build/wheelhouse/*.whl
	@tools/step.sh "Python $*: install trg" .venv/$*/bin/python -m pip install \
	    --no-deps --no-index --no-build-isolation --editable .
	@touch $@

.venv/%/.lint: .venv/%/.requirements requirements/lint.txt
	@tools/step.sh "Python $*: install lint tools" \
	    .venv/$*/bin/python -m pip install --progress-bar off -r requirements/lint.txt
	@touch $@

# One binary for every Python: stable ABI of 3.11.
$(WHEEL): $(SOURCES) | .venv/$(LEG)/.requirements
	@rm -rf build/wheelhouse
	@CMAKE_BUILD_PARALLEL_LEVEL=$(JOBS) tools/step.sh "build the trg_native wheel" $(PYTHON) -m pip wheel \
	    --no-deps --no-index --no-build-isolation --wheel-dir build/wheelhouse ./native
	@touch $@

dist/.extension: $(WHEEL) blender_manifest.toml __init__.py LICENSE tools/make_extension.py $(PACKAGE) | .venv/$(LEG)/.requirements
	@tools/step.sh "pack the extension" $(PYTHON) tools/make_extension.py --wheels build/wheelhouse --out dist
	@touch $@

clean:
	rm -rf build dist out

distclean: clean
	rm -rf .venv
