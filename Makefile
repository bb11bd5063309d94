# The front desk: every target is one thin call of CMake, CTest or a script. `make help` lists them.
SHELL := /bin/bash
JOBS ?= $(shell nproc)
PYTHON ?= /usr/bin/python3
BUILD := build
# What `build` and `install-test` use: `dev` has the same code in it, with tests and benchmarks beside it.
PRESET ?= release
# What tests, benchmarks and papers use: `dev`, or `ci`, which is quicker as a whole and slower after an edit.
TESTS ?= dev
# What `demo` uses, which compiles in two thirds of the time; continuous integration has a program already.
FIRST ?= demo
KINEMEND := $(BUILD)/$(FIRST)/cli/kinemend
DEMO := build/demo_takes

.PHONY: help setup build demo test asan lint format bench bench-quick papers papers-quick pictures fuzz install-test clean

help: ## this list
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## (.*)/  make \1\t\2/' | expand -t 22

setup: ## install the Debian packages of packages.txt that are missing
	@tools/install_packages packages.txt

build: setup ## the command line and the library, as they ship
	cmake --preset $(PRESET) >/dev/null
	cmake --build --preset $(PRESET) -j $(JOBS)

demo: setup ## clean the noisy take that ships with the project
	cmake --preset $(FIRST) >/dev/null
	cmake --build --preset $(FIRST) -j $(JOBS) --target kinemend_cli
	@mkdir -p $(DEMO)
	@echo
	@echo "A noisy walk, examples/takes/noisy_walk.bvh, cleaned by: kinemend clean noisy_walk.bvh"
	@echo
	@$(KINEMEND) clean examples/takes/noisy_walk.bvh -o $(DEMO)/noisy_walk.clean.bvh --force
	@echo
	@echo "Error before, against the clean original:"
	@$(KINEMEND) compare examples/takes/walk.bvh examples/takes/noisy_walk.bvh
	@echo
	@echo "Error after:"
	@$(KINEMEND) compare examples/takes/walk.bvh $(DEMO)/noisy_walk.clean.bvh
	@echo
	@echo "The clean take is $(DEMO)/noisy_walk.clean.bvh"

$(BUILD)/$(TESTS)/.built: FORCE
	cmake --preset $(TESTS)
	cmake --build --preset $(TESTS) -j $(JOBS)
FORCE:

test: setup $(BUILD)/$(TESTS)/.built ## build and run every test (real takes too where KINEMEND_DATA names a folder)
	ctest --preset $(TESTS) -j $(JOBS)

asan: setup ## the tests under AddressSanitizer and UndefinedBehaviorSanitizer
	cmake --preset asan
	cmake --build --preset asan -j $(JOBS)
	ctest --preset asan -j $(JOBS)

lint: setup ## formatting, static analysis and the direction of includes (tools/lint --deep looks deeper)
	tools/lint

format: ## rewrite every source file in the project's format
	git ls-files '*.cpp' '*.hpp' | xargs clang-format -i

bench: setup $(BUILD)/$(TESTS)/.built ## the speed tables, beside SciPy's figures of the same run (CHECK=1: compared with the stored ones)
	tools/run_benchmarks $(BUILD)/$(TESTS)
	$(if $(CHECK),tools/check_figures build/bench --speeds)

bench-quick: setup $(BUILD)/$(TESTS)/.built
	tools/run_benchmarks $(BUILD)/$(TESTS) --quick

papers: setup $(BUILD)/$(TESTS)/.built ## the papers' own experiments, and the figures of pages, under build/papers (CHECK=1: compared with the stored ones)
	tools/run_papers $(BUILD)/$(TESTS)
	$(if $(CHECK),tools/check_figures build/papers)

# On takes that the project makes itself, so that the figures are the same everywhere.
papers-quick: setup $(BUILD)/$(TESTS)/.built
	KINEMEND_DATA= tools/run_papers $(BUILD)/$(TESTS) --quick
	tools/check_figures build/papers --quick

pictures: setup $(BUILD)/$(TESTS)/.built ## every picture of README.md and docs again, by the program from takes that ship
	tools/make_pictures $(BUILD)/$(TESTS)

fuzz: setup ## fuzz each reader for a minute (FUZZ_SECONDS=60)
	tools/run_fuzzers $${FUZZ_SECONDS:-60}

install-test: build ## install into a folder and build the README's snippet against it
	tools/install_test $(BUILD)/$(PRESET)

clean: ## remove everything that was built
	rm -rf $(BUILD)
