# One command per chore; `make help` lists them, CONTRIBUTING.md says when to use which.
# Each does its own set-up: what it needs from PyPI goes to .venv, what it needs from Debian is installed with apt-get.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMPS := $(VENV)/stamps
comma := ,
FUZZ_SECONDS ?= 60
MINUTES ?= 20
# One more worker than processors: some tests wait.
WORKERS := $(shell echo $$(($$(nproc) + 1)))
# Not empty if `make test` measures coverage: from Python 3.12 on, that costs little.
MEASURES = $(if $(ONLY),,$(shell $(BIN)/python -c 'import sys; print("yes" * (sys.version_info >= (3, 12)))'))
# Of `make test-cpp`: a filter of GoogleTest; of `make test-python`: what pytest takes. All tests, if nothing is said.
ONLY ?=

# cmake and ninja come from .venv, whatever the machine has.
export PATH := $(CURDIR)/$(BIN):$(PATH)
export PIP_DISABLE_PIP_VERSION_CHECK := 1
export DEBIAN_FRONTEND := noninteractive
# Where it is set, Python and pytest compile their files at each start.
unexport PYTHONDONTWRITEBYTECODE

cpp_engine := $(shell find cpp -name '*.[ch]pp') cpp/CMakeLists.txt
python_packages := $(shell find python -name __init__.py)
cpp_checked := $(shell find cpp tests/cpp tests/fuzz bench -name '*.[ch]pp')
python_checked := python tests examples bench docs packaging
node_packages := viewer/node_modules/.package-lock.json

.DEFAULT_GOAL := help
.NOTPARALLEL:
.PHONY: help demo test test-cpp test-python test-slow test-threads test-binding coverage fuzz torture mutants lint lint-python lint-cpp lint-viewer lint-files format build verify bench figures pictures schema fingerprints golden pages docs wheels hashes release clean distclean system-gtest system-benchmark system-ns3 need-ns3 system-tshark system-clang system-npm system-chromium system-qemu viewer test-viewer again

help:  ## List the commands.
	@sed -nE 's/^([a-z-]+):.*## (.*)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 20

demo: build  ## Run ZigZag in both modes and print the comparison.
	$(BIN)/python examples/zigzag/compare.py

test: test-cpp test-python test-viewer  ## Build and run the tests: C++, Python, the page of replays.

test-cpp: $(STAMPS)/build system-gtest  ## C++ tests under AddressSanitizer and UndefinedBehaviorSanitizer; some: ONLY='Contention*'.
	cmake -S cpp --preset asan --log-level=WARNING
	cmake --build build/asan
	$(if $(ONLY),build/asan/netsim_tests --gtest_brief=1 --gtest_filter='$(ONLY)',ctest --test-dir build/asan --parallel --output-on-failure --no-tests=error)

test-python: build $(STAMPS)/test system-tshark  ## Python tests, in parallel, with their coverage from Python 3.12 on; some: ONLY='FILE -k NAME'.
	$(if $(MEASURES),COVERAGE_CORE=sysmon) $(BIN)/python -m pytest \
	  $(if $(ONLY),$(ONLY),--numprocesses=$(WORKERS) --dist=loadfile $(if $(MEASURES),--cov --cov-report=))
	$(if $(MEASURES),@echo "Lines that the tests reach: $$($(BIN)/coverage report --format=total) %")

coverage: build $(STAMPS)/test system-tshark  ## The Python tests, and for each file the lines and branches that they do not reach.
	$(BIN)/python -m pytest --numprocesses=$(WORKERS) --dist=loadfile --cov --cov-branch --cov-report=term-missing:skip-covered

test-viewer: build $(STAMPS)/test $(node_packages) system-chromium  ## Tests of the page of replays: of its parts, and in Chromium.
	cd viewer && npm run --silent test
	$(BIN)/python -m pytest tests/viewer --numprocesses=auto --dist=worksteal

test-threads: $(STAMPS)/build system-gtest  ## C++ tests under ThreadSanitizer.
	cmake -S cpp --preset tsan --log-level=WARNING
	cmake --build build/tsan
	ctest --test-dir build/tsan --parallel --output-on-failure --no-tests=error

# Sanitizers come first: Python itself does not link them. What Python keeps until its end is not a leak.
test-binding: build $(STAMPS)/test  ## Python tests of the engine, with the compiled module under AddressSanitizer and UndefinedBehaviorSanitizer.
	cmake -S cpp --preset binding --log-level=WARNING \
	  -DPython_EXECUTABLE="$(CURDIR)/$(BIN)/python" -Dpybind11_DIR="$$($(BIN)/python -m pybind11 --cmakedir)"
	cmake --build build/binding
	LD_PRELOAD="$$(for name in asan ubsan stdc++; do $${CXX:-g++} -print-file-name=lib$$name.so; done | xargs)" \
	  ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 PYTHONPATH=tests $(BIN)/python -m pytest -p python.sanitized \
	  --numprocesses=$(WORKERS) --dist=loadfile $(or $(ONLY),tests/python/integrated tests/python/conformance tests/python/encapsulator)

fuzz: $(STAMPS)/build system-clang  ## Search for scenarios that break the engine, FUZZ_SECONDS=60 long.
	cmake -S cpp --preset fuzz --log-level=WARNING
	cmake --build build/fuzz
	@mkdir -p build/fuzz/corpus build/fuzz/failures
	build/fuzz/netsim_fuzzer build/fuzz/corpus -artifact_prefix=build/fuzz/failures/ -max_total_time=$(FUZZ_SECONDS) \
	  -timeout=20 -max_len=2000 -len_control=0 -verbosity=0 -print_final_stats=1

torture: build $(STAMPS)/test  ## Kill, interrupt, mutate and attack runs, MINUTES=20 long; prints what was lost.
	cd tests && "$(CURDIR)/$(BIN)/python" -m python.torture $(MINUTES)

mutants: build $(STAMPS)/test  ## Change the package at 50 random places, one by one, and report how many changes the tests notice (2 h).
	cd tests && "$(CURDIR)/$(BIN)/python" -m python.mutants $(or $(COUNT),50)

lint: lint-python lint-cpp lint-viewer lint-files docs  ## All checks of style, types, layers and links: Python, C++, TypeScript, files of the repository, pages.

lint-python: build $(STAMPS)/test $(STAMPS)/lint  ## ruff, mypy --strict, stubtest, lint-imports, and the English of all files.
	ruff check $(python_checked)
	ruff format --check $(python_checked)
	mypy
	lint-imports
	python -m pytest -q --capture=no -m verify tests/python/house/test_english.py tests/python/integrated/test_stub.py

lint-cpp: $(STAMPS)/build $(STAMPS)/lint system-gtest  ## clang-format, clang-tidy.
	clang-format --dry-run -Werror $(cpp_checked)
	cmake -S cpp --preset lint --log-level=WARNING \
	  -DPython_EXECUTABLE="$(CURDIR)/$(BIN)/python" -Dpybind11_DIR="$$($(BIN)/python -m pybind11 --cmakedir)"
	@$(MAKE) --no-print-directory --jobs=$$(nproc) -f cpp/clang-tidy.mk

lint-viewer: $(node_packages)  ## The TypeScript compiler, and Biome.
	cd viewer && npm run --silent check

lint-files: $(STAMPS)/lint  ## Workflows, the forms of issues, the citation, the hooks of git.
	check-jsonschema --builtin-schema vendor.citation-file-format CITATION.cff
	check-jsonschema --builtin-schema vendor.github-issue-forms .github/ISSUE_TEMPLATE/*.yml
	check-jsonschema --builtin-schema vendor.github-workflows .github/workflows/*.yml
	check-jsonschema --builtin-schema vendor.dependabot .github/dependabot.yml
	zizmor --offline --quiet --no-progress .github
	pre-commit validate-config

format: $(STAMPS)/lint  ## Lay out all sources; fixes what ruff can fix.
	ruff check --fix-only --quiet $(python_checked)
	ruff format $(python_checked)
	clang-format -i $(cpp_checked)

build: $(STAMPS)/editable  ## Install the package into .venv, editable, with the engine compiled.

test-slow: build $(STAMPS)/test $(node_packages) system-chromium system-tshark  ## The Python tests that take too long for `make test`: the commands of most pages.
	$(BIN)/python -m pytest tests/python tests/viewer --numprocesses=$(WORKERS) --dist=loadfile -m verify

verify: build $(STAMPS)/test system-gtest test-slow  ## Compare with INET, ns-3 and closed forms; draws docs/verification; the tests that take long.
	$(BIN)/python -m pytest tests/verification --verify
	NETSIM_THOROUGHNESS=20 ASAN_OPTIONS=detect_stack_use_after_return=1 $(MAKE) --no-print-directory test-cpp

bench: build system-benchmark system-ns3  ## Benchmarks, with the distance to their goals, and a profile by layer.
	cmake -S cpp --preset bench --log-level=WARNING
	cmake --build build/bench
	build/bench/netsim_bench --benchmark_out=build/bench/figures.json --benchmark_out_format=json
	PYTHONPATH=bench/python $(BIN)/python -m findings build/bench/figures.json
	build/bench/netsim_layers 1000
	build/bench/netsim_layers 10000
	@failed=0; for script in bench/python/*.py; do echo "== $$script"; $(BIN)/python $$script || failed=1; done; exit $$failed

docs: build $(STAMPS)/docs  ## Build the documentation site, build/site, and check its links.
	$(BIN)/sphinx-build --quiet --fail-on-warning --keep-going docs build/site

viewer: lint-viewer  ## Rebuild the page of replays, python/gradysim/viewer/page.html, from viewer/.
	cd viewer && npm run --silent build

figures: build $(STAMPS)/test  ## Draw those of the pictures that are figures: run the commands of their how-to pages.
	sed -n '/^```sh$$/,/^```$$/{/^```/d;p}' docs/how-to/plot-a-study.md docs/how-to/compare-two-studies.md | sh -e
	gradysim ladder configs/zigzag.ini -c ZigZag5Synchronised --metric "groundStation data" -n 5 \
	  --set sim-time-limit=10min --output docs/pictures/ladder/ladder.png
	gradysim desync configs/zigzag.ini -c ZigZag5Synchronised --metric "groundStation data" -n 2 \
	  --set sim-time-limit=10min --output docs/pictures/ladder/jitter.png
	for kind in ini python sh; do sed -n "/^\`\`\`$$kind$$/,/^\`\`\`$$/{/^\`\`\`/d;p}" docs/how-to/fly-with-inertia.md >results/square.$$kind; done
	cd results && mv square.python square.py && sh -e square.sh && cp results/inertia.png ../docs/pictures/plots
	rm docs/pictures/ladder/*.csv docs/pictures/ladder/*.json
	cp results/line.png results/diff.png results/outcomes.png results/cdf.png results/time.png results/map.png docs/pictures/plots
	cp results/compare.png docs/pictures/plots
	python docs/pictures/gallery/draw.py

pictures: figures $(node_packages) system-chromium  ## Draw the pictures of the README and the guides again.
	$(BIN)/python docs/pictures/draw.py
	$(BIN)/python docs/pictures/engine/draw.py
	$(BIN)/python docs/pictures/architecture/draw.py

schema: $(STAMPS)/build  ## Rewrite what is derived from the declarations of the engine's fields.
	$(BIN)/python cpp/schema/write_schema.py

fingerprints: build  ## Rewrite the fingerprints of the examples; tests/fingerprints/update.py says when.
	$(BIN)/python tests/fingerprints/update.py

pages: build $(STAMPS)/test system-tshark  ## Rewrite the output that pages show; some: ONLY='tests/python/house/test_run_a_study.py'.
	REWRITE_PAGES=1 $(BIN)/python -m pytest -m 'not autopilot' --numprocesses=$(WORKERS) --dist=loadfile $(or $(ONLY),tests/python/house)

golden: build $(STAMPS)/test  ## Rewrite tests/golden: the messages about mistakes in scenarios and commands.
	REWRITE_GOLDEN=1 $(BIN)/python -m pytest -q tests/python/scenario/test_messages.py tests/python/cli/test_mistakes.py

wheels: $(STAMPS)/build $(STAMPS)/wheels $(STAMPS)/test system-qemu  ## Build wheels for x86-64 and aarch64 and the source distribution into dist, and test them.
	$(BIN)/python packaging/build_wheels.py
	$(BIN)/python -m pytest -o pythonpath='packaging tests/wheels' -vv -rs tests/wheels

hashes: $(STAMPS)/hashes  ## Rewrite packaging/requirements.txt: what builds the published distributions, with hashes.
	UV_CUSTOM_COMPILE_COMMAND='make hashes' uv pip compile --quiet --universal --python-version=3.11 --generate-hashes \
	  --group=dist --output-file=packaging/requirements.txt

release: | $(VENV)/bin/python  ## Check the clone, build and test the wheels, and tag a release: VERSION=1.0.0, or 1.0.0rc1.
	$(BIN)/python packaging/release.py check "$(VERSION)"
	VCS_VERSIONING_PRETEND_VERSION_FOR_GRADYSIM=$(VERSION) $(MAKE) --no-print-directory wheels
	$(BIN)/python packaging/release.py tag "$(VERSION)"

clean:  ## Remove what was built; .venv stays.
	rm -rf build dist $(STAMPS)/editable

distclean: clean  ## Remove .venv and the packages of npm, too.
	rm -rf $(VENV) viewer/node_modules

# ---- set-up ---------------------------------------------------------------------------------------------------------

# $(call need,CHECK,PACKAGE): when the shell command CHECK fails, install the Debian package PACKAGE.
define need
@$(1) >/dev/null 2>&1 || { \
  echo "Installing the Debian package $(2)"; \
  if [ "$$(id -u)" = 0 ]; then root=; else root=sudo; fi; \
  if ! command -v apt-get >/dev/null || { [ -n "$$root" ] && ! command -v sudo >/dev/null; }; then \
    echo "Please install $(2) (the name of the Debian package) and run make again." >&2; exit 1; fi; \
  get() { $$root env DEBIAN_FRONTEND=noninteractive apt-get -qq "$$@" </dev/null; }; \
  get update || true; \
  get install -y --no-install-recommends $(2) >/dev/null || { \
    echo "apt-get could not install $(2): please install it and run make again." >&2; exit 1; }; }
endef

system-gtest:
	$(call need,echo '#include <gtest/gtest.h>' | $${CXX:-g++} -E -x c++ -,libgtest-dev)

system-clang:
	$(call need,echo 'int main() { return 0; }' | clang++ -fsanitize=fuzzer-no-link$(comma)address -x c++ - -o /dev/null,clang libclang-rt-14-dev)

system-benchmark:
	$(call need,echo '#include <benchmark/benchmark.h>' | $${CXX:-g++} -E -x c++ -,libbenchmark-dev)

# Without it the benchmarks do all but the comparison with ns-3.
system-ns3:
	@$(MAKE) --no-print-directory need-ns3 || echo "The benchmarks go on without ns-3."

need-ns3:
	$(call need,test -e /usr/include/ns3/wifi-module.h,libns3-dev)

system-tshark:
	$(call need,command -v tshark,tshark)

system-npm:
	$(call need,command -v npm,nodejs npm)

system-chromium:
	$(call need,command -v chromium,chromium fonts-dejavu-core)

system-qemu:
	$(call need,command -v qemu-aarch64-static,qemu-user-static)

$(node_packages): viewer/package-lock.json | system-npm
	cd viewer && npm ci --silent --no-audit --no-fund
	@touch $@

$(VENV)/bin/python:
	$(call need,$(PYTHON) -c 'import venv$(comma) ensurepip',python3-venv)
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and f"gradysim needs Python 3.11 or newer, {sys.executable} is {sys.version}")'
	$(PYTHON) -m venv $(VENV)

# Which packages, and which version of each: [dependency-groups] of pyproject.toml.
$(STAMPS)/build $(STAMPS)/test $(STAMPS)/lint $(STAMPS)/docs $(STAMPS)/wheels $(STAMPS)/hashes: pyproject.toml | $(VENV)/bin/python
	@mkdir -p $(STAMPS)
	@$(BIN)/pip --version | grep -q '^pip 26\.' || $(BIN)/pip install --quiet pip==26.3
	$(BIN)/pip install --quiet --group $(@F)
	@touch $@

# `"editable": true` if gradysim is installed so; another `pip install` of it in .venv would put a copy in its place.
is_editable = $(shell grep -hos '"editable": true' $(VENV)/lib/python*/site-packages/gradysim-*.dist-info/direct_url.json)

# Whether the packages are those of the last installation: it lists them, so new and removed ones need another.
installed_packages = $(shell cat $(STAMPS)/packages 2>/dev/null)
is_current = $(and $(is_editable),$(if $(filter-out $(installed_packages),$(python_packages))$(filter-out $(python_packages),$(installed_packages)),,same))

# Editable: Python sources are used where they are. The compiled module is rebuilt here when one of its sources changes.
$(STAMPS)/editable: pyproject.toml $(cpp_engine) $(if $(is_current),,again) | $(STAMPS)/build
	$(call need,$(BIN)/python -c 'import os$(comma)sys$(comma)sysconfig; sys.exit(not os.path.exists(sysconfig.get_path("include") + "/Python.h"))',python3-dev)
	$(BIN)/pip install --quiet --no-build-isolation --editable .
	@echo $(python_packages) >$(STAMPS)/packages
	@touch $@
