# The front desk: every target is one thin call of CMake, CTest or a script. `make help` lists them.
SHELL := /bin/bash
JOBS ?= $(shell nproc)
PYTHON ?= /usr/bin/python3
BUILD := build
# What `build`, `deb` and `install-test` use.
PRESET ?= release
# What tests, benchmarks and papers use: `dev`, or `ci`, which is quicker as a whole and slower after an edit.
TESTS ?= dev
# What `demo` uses, which compiles in two thirds of the time; continuous integration has a program already.
FIRST ?= demo
# The sanitised build: `asan`, or `asan-all`, which has every room.
ASAN ?= asan
KINEMEND := $(BUILD)/$(FIRST)/cli/kinemend
DEMO := build/demo_takes
# Each target installs the sections of packages.txt that it needs.
need = @tools/install_packages packages.txt

# The program for Windows, and what runs it here.
WINDOWS := $(BUILD)/windows/cli/kinemend.exe
WINE ?= /usr/lib/wine/wine64

.PHONY: help setup build windows windows-test windows-install-test libcxx libcxx-test libcxx-install-test wasm wasm-test demo deb deb-test install-test cluster-test test test-all asan asan-build asan-test lint format page bench bench-quick blender-addon blender-test blender-pictures web-app npm-package \
  papers papers-quick pictures fuzz soak nightly clean FORCE

help: ## this list
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## (.*)/  make \1\t\2/' | expand -t 22

setup: ## install every package of packages.txt (other targets install what they need)
	$(need)

demo: ## clean the noisy take that ships with the project
	$(need) core
	@cmake --preset $(FIRST) >/dev/null
	@cmake --build --preset $(FIRST) -j $(JOBS) --target kinemend_cli
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

build: ## the command line and the library, as they ship: build/release/cli/kinemend
	$(need) core
	@cmake --preset $(PRESET) >/dev/null
	cmake --build --preset $(PRESET) -j $(JOBS)

$(BUILD)/$(PRESET)/.packaged: FORCE
	$(need) core package
	@cmake --preset $(PRESET) >/dev/null
	cmake --build --preset $(PRESET) -j $(JOBS) --target kinemend_cli kinemend_cli_texts kinemend_installed

windows: ## the program for 64-bit Windows by MinGW-w64: build/windows/cli/kinemend.exe, which needs no library beside it
	$(need) core windows
	@cmake --preset windows >/dev/null
	cmake --build --preset windows -j $(JOBS) --target kinemend_cli
	tools/windows_test --libraries-only $(WINDOWS)

windows-test: build windows ## run it under Wine: files, streams, view and batch, and the same bytes as the program here on twenty takes
	$(need) core windows wine
	tools/windows_test $(WINDOWS) --through $(WINE)
	tools/compare_programs $(BUILD)/$(PRESET)/cli/kinemend $(WINDOWS) --through $(WINE)

libcxx: ## compile everything with Clang and libc++ as on macOS, with the threads of the standard library, and test it
	$(need) core test sanitize libcxx
	@cmake --preset libcxx >/dev/null
	cmake --build --preset libcxx -j $(JOBS)
	ctest --preset libcxx -j $(JOBS)

libcxx-test: build libcxx ## compare its bytes with those of the program here, on twenty takes and on every fixture
	tools/compare_programs $(BUILD)/$(PRESET)/cli/kinemend $(BUILD)/libcxx/cli/kinemend
	tools/compare_programs $(BUILD)/$(PRESET)/cli/kinemend $(BUILD)/libcxx/cli/kinemend --fixtures

wasm: ## the module for JavaScript by Emscripten: build/wasm/wasm/kinemend.mjs and kinemend_module.wasm
	$(need) core wasm
	tools/wasm_tools $(BUILD)/wasm_tools
	@cmake --preset wasm >/dev/null
	cmake --build --preset wasm -j $(JOBS) --target kinemend_module

web-app: wasm ## kinemend.html, the page of `view` in one file that needs no program: build/wasm/wasm/kinemend.html
	$(need) page
	@cmake --preset wasm -DKINEMEND_WEB=ON >/dev/null
	cmake --build --preset wasm -j $(JOBS) --target kinemend_app

npm-package: wasm ## the npm package of the module: build/wasm/wasm/npm/kinemend-0.1.0.tgz
	$(need) page
	wasm/npm/make_package $(BUILD)/wasm/wasm $(BUILD)/wasm_tools/zlib

wasm-test: build web-app npm-package ## the module in Node, the app and the package in a browser write the same bytes as the program on twenty takes
	$(need) page browser
	rm -rf $(BUILD)/wasm/takes
	tools/compare_programs $(BUILD)/$(PRESET)/cli/kinemend $(BUILD)/wasm/takes --make-takes
	cd $(BUILD)/wasm/web && npm ci --ignore-scripts --prefer-offline --silent
	cd $(BUILD)/wasm/web && node $(CURDIR)/web/test/app_test.mjs $(CURDIR)/$(BUILD)/$(PRESET)/cli/kinemend $$(command -v chromium) ../wasm/kinemend.html screenshots \
	  $(CURDIR)/examples/takes $(CURDIR)/$(BUILD)/wasm/takes
	cd $(BUILD)/wasm/web && node $(CURDIR)/wasm/npm/package_test.mjs $(CURDIR)/$(BUILD)/$(PRESET)/cli/kinemend $$(command -v chromium) ../wasm/npm/kinemend-*.tgz $(CURDIR)/examples/takes
	tools/compare_programs $(BUILD)/$(PRESET)/cli/kinemend tools/wasm_program --methods bilateral,nonlocal,gaussian,butterworth,median,kalman,wavelet,learned

blender-addon: ## the Blender add-on: build/blender/kinemend_blender-0.1.0.zip
	@tools/make_blender_addon

blender-test: $(BUILD)/$(TESTS)/.built ## run the add-on within Blender, without a window and in one on no screen
	$(need) core test blender
	@cmake --preset $(TESTS) >/dev/null
	ctest --preset $(TESTS) -R blender

blender-pictures: blender-test ## the pictures of docs/blender.md again
	cp $(BUILD)/$(TESTS)/blender/*.png docs/pictures/

deb: $(BUILD)/$(PRESET)/.packaged ## the Debian packages kinemend and libkinemend-dev, in build/deb
	tools/make_deb $(BUILD)/$(PRESET)

deb-test: deb ## install the packages into a fresh Debian, clean a take and build the README's snippet there (needs root)
	tools/deb_test build/deb

install-test: $(BUILD)/$(PRESET)/.packaged ## install into a folder and build the programs of README and docs/install.md against it
	tools/install_test $(BUILD)/$(PRESET)

windows-install-test: windows ## the same for Windows: the static library, its headers and its package, and programs that run under Wine
	$(need) core windows wine
	cmake --build --preset windows -j $(JOBS) --target kinemend_installed
	tools/install_test $(BUILD)/windows --through $(WINE) -DCMAKE_TOOLCHAIN_FILE=$(CURDIR)/cmake/toolchains/mingw-w64.cmake

libcxx-install-test: libcxx ## the same with Clang and libc++
	cmake --build --preset libcxx -j $(JOBS) --target kinemend_installed
	tools/install_test $(BUILD)/libcxx -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS=-stdlib=libc++

$(BUILD)/$(TESTS)/.built: FORCE
	$(need) core test
	@cmake --preset $(TESTS)
	cmake --build --preset $(TESTS) -j $(JOBS)
$(BUILD)/$(TESTS)/.benches: FORCE
	$(need) core test bench
	@cmake --preset $(TESTS) -DKINEMEND_BENCH=ON >/dev/null
	cmake --build --preset $(TESTS) -j $(JOBS) --target kinemend_bench kinemend_papers kinemend_cli
FORCE:

test: $(BUILD)/$(TESTS)/.built ## build and run the tests (real takes too where KINEMEND_DATA names a folder); says what it leaves out
	@cat $(BUILD)/$(TESTS)/left_out.txt
	ctest --preset $(TESTS) -j $(JOBS) $(CTEST_ARGUMENTS)

test-all: ## the same, with training, pages, browser, Python and Blender installed, so that nothing is left out
	$(need) core test page browser train python blender
	$(MAKE) test

asan-build:
	$(need) core test sanitize
	@cmake --preset $(ASAN) >/dev/null
	cmake --build --preset $(ASAN) -j $(JOBS)
asan-test:
	ctest --preset $(ASAN) -j $(JOBS)
asan: asan-build asan-test ## tests under AddressSanitizer and UndefinedBehaviorSanitizer (ASAN=asan-all: of every room)

lint: ## formatting, direction of includes, and static analysis of what changed (tools/lint --help)
	$(need) core test lint bench
	tools/lint

format: ## rewrite every source file in the project's format
	$(need) lint
	git ls-files '*.cpp' '*.hpp' | xargs clang-format -i

page: ## bundle the report page anew from web/src, into web/dist
	$(need) core page
	@cmake --preset release -DKINEMEND_WEB=ON >/dev/null
	cmake --build --preset release --target $(CURDIR)/build/release/web/page.js
	cp build/release/web/page.js build/release/web/page.css web/dist/

bench: $(BUILD)/$(TESTS)/.benches ## the speed tables, beside SciPy's figures of the same run (CHECK=1: compared with the stored ones)
	tools/run_benchmarks $(BUILD)/$(TESTS)
	$(if $(CHECK),tools/check_figures build/bench --speeds)

bench-quick: $(BUILD)/$(TESTS)/.benches
	tools/run_benchmarks $(BUILD)/$(TESTS) --quick

papers: $(BUILD)/$(TESTS)/.benches ## the papers' own experiments, and the figures of pages, under build/papers (CHECK=1: compared with the stored ones)
	tools/run_papers $(BUILD)/$(TESTS)
	$(if $(CHECK),tools/check_figures build/papers)

# On takes that the project makes itself, so that the figures are the same everywhere.
papers-quick: $(BUILD)/$(TESTS)/.benches
	KINEMEND_DATA= tools/run_papers $(BUILD)/$(TESTS) --quick
	tools/check_figures build/papers --quick

pictures: $(BUILD)/$(TESTS)/.built ## every picture of README.md and docs again, by the program from takes that ship
	tools/make_pictures $(BUILD)/$(TESTS)

fuzz: ## fuzz each target for a minute (FUZZ_SECONDS=60)
	$(need) core test sanitize
	tools/run_fuzzers $${FUZZ_SECONDS:-60}

cluster-test: build ## an array of 8 in a Slurm cluster of its own, one task killed and requeued, is one run (needs root)
	$(need) core cluster
	tools/cluster_test --takes $${CLUSTER_TAKES:-500} $(BUILD)/$(PRESET)/cli/kinemend || [ $$? = 77 ]

soak: $(BUILD)/$(TESTS)/.built ## mutated input, kills, threads and lossy streams for five minutes (SOAK_SECONDS=300)
	tools/soak $(BUILD)/$(TESTS) $${SOAK_SECONDS:-300}

nightly: ## what continuous integration leaves out: sanitisers, packages in a fresh root, a cluster, browser, soak, analysis of includers
	$(need)
	tools/lint --includers
	$(MAKE) asan ASAN=asan-all
	$(MAKE) libcxx-test libcxx-install-test windows-test windows-install-test
	$(MAKE) fuzz soak test-all deb-test install-test cluster-test bench-quick
	tests/live/clients/node_osc_test $(BUILD)/$(TESTS)/cli/kinemend

clean: ## remove everything that was built
	rm -rf $(BUILD)
