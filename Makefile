# The few verbs, the same everywhere. Each installs what it needs into a virtual environment of this folder and
# is quick the second time. PYTHON chooses the interpreter, 3.11 or later; PRESET what `make run` shows.

PYTHON ?= $(shell command -v python3.11 || command -v python3)
PRESET ?= anodised-titanium
# What the benchmark compares with; bench-light leaves out PyTorch, which brings gigabytes for GPUs along.
BENCH_GROUP ?= bench

VENV := .venv
BENCH_VENV := .venv-bench
BLENDER_VENV := .venv-blender
BIN := $(VENV)/bin
# Matplotlib's cache of fonts: a home need not be writable.
export MPLCONFIGDIR ?= $(CURDIR)/$(VENV)/matplotlib
PIP_INSTALL := -m pip --disable-pip-version-check --no-input install --quiet

.PHONY: help run serve page test soak check bench docs figures pictures clean
.DELETE_ON_ERROR:

help:
	@echo 'make run     tabulate a preset to EXR and draw it, into out/'
	@echo 'make page    build the page of the service'
	@echo 'make serve   run the HTTP service and its page on http://localhost:8000'
	@echo 'make test    run all tests'
	@echo 'make check   look at style, types and layers'
	@echo 'make docs    build the documentation into build/site'
	@echo 'make figures render the figures of the paper, compare with the numbers of others'
	@echo 'make pictures draw the other pictures of the documentation anew'
	@echo 'make soak    inject faults as often as the promises say, for an hour or so'
	@echo 'make bench   measure against other programs, write docs/benchmarks.md'
	@echo 'make clean   remove what the others made'

run: $(VENV)/.installed
	@echo 'Lookup texture, linear colour over angle and thickness:'
	@$(BIN)/nacreous tabulate $(PRESET) --format exr -o out
	@echo 'Picture of it:'
	@$(BIN)/nacreous preview $(PRESET) -o out/$(subst /,-,$(PRESET)).png

serve: page
	@$(BIN)/nacreous serve

test: page $(VENV)/.group-test $(VENV)/.llvm $(VENV)/.drawing $(VENV)/.web $(VENV)/.node $(VENV)/.tracing $(BLENDER_VENV)/.bpy
	$(BIN)/python -m pytest --numprocesses auto --maxprocesses 4 --dist loadfile

# Installing builds the page; this builds it again where its sources have changed since, and is quick where not.
page: $(VENV)/.group-page
	@$(BIN)/python service/page/build.py

soak: page $(VENV)/.group-test $(VENV)/.tracing
	NACREOUS_SOAK=1 $(BIN)/python -m pytest tests/faults tests/web

check: $(VENV)/.group-check
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy
	$(BIN)/lint-imports --no-logo

docs: $(VENV)/.group-docs
	$(BIN)/python -m sphinx -W --keep-going -n -q docs build/site
	@echo 'To read it: $(BIN)/python -m http.server -d build/site'

figures: $(VENV)/.group-test $(VENV)/.llvm $(VENV)/.node
	PYTHONPATH=docs:tests $(BIN)/python -m figures
	PYTHONPATH=docs:tests $(BIN)/python -m validation

pictures: page $(VENV)/.group-test $(VENV)/.llvm $(VENV)/.drawing $(VENV)/.web $(BLENDER_VENV)/.bpy
	$(BIN)/python docs/make_images.py
	PYTHONPATH=docs $(BIN)/python docs/make_gallery.py
	PYTHONPATH=tests:docs $(BIN)/python docs/make_tutorial_images.py
	PYTHONPATH=tests $(BIN)/python docs/make_page_image.py
	PYTHONPATH=tests $(BIN)/python docs/make_client_images.py

bench: $(BENCH_VENV)/.group-$(BENCH_GROUP) $(BENCH_VENV)/.llvm
	PYTHONPATH=tests $(BENCH_VENV)/bin/python -m bench

clean:
	rm -rf $(VENV) $(BENCH_VENV) $(BLENDER_VENV) out build dist .hypothesis .*_cache \
	    tests/node/node_modules service/page/node_modules service/nacreous/web/page

# ---- environments: a stamp for each step, renewed when pyproject.toml changes ------------------------------

# $(call debian,TEST,PACKAGE): unless TEST holds, install PACKAGE where this user may; fails where it cannot be.
debian = { $(1); } >/dev/null 2>&1 || \
    { test "$$(id -u)" = 0 && apt-get -qq update && apt-get -qq --yes install $(2); } >/dev/null 2>&1

# Debian packs what makes environments apart from Python. PoCL links its kernels with ld and gcc's library.
$(VENV)/.made $(BENCH_VENV)/.made $(BLENDER_VENV)/.made:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	    { echo 'Expected Python 3.11 or later; name one with PYTHON=...' >&2; exit 1; }
	@$(call debian,$(PYTHON) -c "import ensurepip",python3-venv) || \
	    { echo 'Python cannot make environments: install the package python3-venv' >&2; exit 1; }
	@$(call debian,command -v ld && command -v gcc,gcc) || \
	    echo 'PoCL needs gcc and ld to link kernels: install the package gcc' >&2
	@$(PYTHON) -m venv --clear $(@D)
	@$(@D)/bin/python $(PIP_INSTALL) --upgrade 'pip>=25.1'
	@touch $@

# Mitsuba's vectorised variants compile with LLVM; without it the tests against them are skipped.
$(VENV)/.llvm $(BENCH_VENV)/.llvm: %/.llvm: %/.made
	@if $(call debian,$(PYTHON) -c 'import ctypes; ctypes.CDLL("libLLVM.so.19.1")',libllvm19); then touch $@; \
	    else echo 'Mitsuba needs LLVM for its vectorised variants: install the package libllvm19' >&2; fi

# What the tests of files and clients run in. Where something cannot be installed, the tests that need it say so.
$(VENV)/.drawing: $(VENV)/.made
	@if $(call debian,command -v xvfb-run && ls /usr/lib/*/dri/swrast_dri.so, \
	        xvfb xauth libgl1 libgl1-mesa-dri libglx-mesa0 libegl1); then touch $@; \
	    else echo 'MaterialX draws without a screen with the packages xvfb, libgl1 and libgl1-mesa-dri' >&2; fi

$(VENV)/.web: $(VENV)/.made
	@if $(call debian,command -v chromium && command -v glslangValidator && command -v spirv-cross, \
	        chromium glslang-tools spirv-cross); then touch $@; \
	    else echo 'The web and engine clients need the packages chromium, glslang-tools and spirv-cross' >&2; fi

# What tests of the service look at processes, requests and units with.
$(VENV)/.tracing: $(VENV)/.made
	@if $(call debian,command -v strace && command -v curl && command -v systemd-analyze,strace curl systemd); then touch $@; \
	    else echo 'Some tests of the service need the packages strace, curl and systemd' >&2; fi

# Blender's module wants Python 3.11 and an older NumPy: an environment of its own, and what its window needs.
$(BLENDER_VENV)/.bpy: $(BLENDER_VENV)/.made
	@echo 'Installing Blender into $(BLENDER_VENV) ...'
	@$(call debian,ldconfig -p | grep -q libXi.so && ldconfig -p | grep -q libXxf86vm.so && ldconfig -p | grep -q libSM.so, \
	    libxi6 libxxf86vm1 libxfixes3 libxrender1 libxkbcommon0 libsm6 libgl1 libegl1) || true
	@if $(BLENDER_VENV)/bin/python $(PIP_INSTALL) 'bpy==4.5.*' && $(BLENDER_VENV)/bin/python -c 'import bpy' \
	        >/dev/null 2>&1; then touch $@; \
	    else echo 'Blender 4.5 needs Python 3.11, libxi6, libxxf86vm1 and libsm6: its tests are skipped' >&2; fi

$(VENV)/.node: $(VENV)/.made tests/node/package-lock.json
	@if command -v npm >/dev/null && npm ci --silent --no-audit --no-fund --prefix tests/node >/dev/null; \
	    then touch $@; else echo 'glTF files are validated with Node.js and npm: install nodejs and npm' >&2; fi

$(VENV)/.installed $(BENCH_VENV)/.installed: %/.installed: %/.made pyproject.toml
	@echo 'Installing Nacreous into $* ...'
	@$*/bin/python $(PIP_INSTALL) --editable .
	@touch $@

$(VENV)/.group-%: $(VENV)/.installed
	@echo 'Installing what `$*` needs into $(VENV) ...'
	@$(BIN)/python $(PIP_INSTALL) --group $*
	@touch $@

$(BENCH_VENV)/.group-%: $(BENCH_VENV)/.installed
	@echo 'Installing what the benchmark compares with into $(BENCH_VENV) ...'
	@$(BENCH_VENV)/bin/python $(PIP_INSTALL) --group $*
	@touch $@
