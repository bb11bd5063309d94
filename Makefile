# Every target is one short call of CMake, CTest or a script. `make help` lists them.
SHELL := /bin/bash
JOBS ?= $(shell nproc)
PYTHON ?= /usr/bin/python3
BUILD := build
# One build serves all targets except those for other systems and sanitisers.
RELEASE := $(BUILD)/release
# The sanitised build: `asan`, or `asan-all`, which has every room.
ASAN ?= asan
KINEMEND := $(RELEASE)/cli/kinemend
DEMO := build/demo_takes
# Each target installs the sections of packages.txt that it needs.
need = @tools/install_packages packages.txt

# The program for Windows, and the emulator that runs it here.
WINDOWS := $(BUILD)/windows/cli/kinemend.exe
WINE ?= /usr/lib/wine/wine64

.PHONY: help setup build windows windows-test windows-install-test libcxx libcxx-test libcxx-install-test wasm wasm-test demo dist dist-quick dist-test dist-test-quick deb deb-test install-test first-test cluster-test test test-all asan asan-build asan-test lint format page bench bench-quick blender-addon blender-test blender-pictures web-app npm-package \
  papers papers-quick pictures fuzz soak nightly clean FORCE

help: ## this list
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## (.*)/  make \1\t\2/' | expand -t 22

setup: ## install every package of packages.txt (other targets install what they need)
	$(need)

demo: ## build the program and clean the noisy take that ships with the project
	$(need) core
	@cmake --preset release >/dev/null
	@cmake --build --preset release -j $(JOBS) --target kinemend_cli
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

build: ## the program and the library, as they ship: build/release/cli/kinemend
	$(need) core
	@cmake --preset release >/dev/null
	cmake --build --preset release -j $(JOBS) --target kinemend_ships

windows: ## the program for 64-bit Windows by MinGW-w64: build/windows/cli/kinemend.exe, which needs no library beside it
	$(need) core windows
	@cmake --preset windows >/dev/null
	cmake --build --preset windows -j $(JOBS) --target kinemend_cli
	tools/windows_test --libraries-only $(WINDOWS)

windows-test: build windows ## run it under Wine: files, streams, view and batch, and the same bytes as the program here on twenty takes
	$(need) core windows wine
	tools/windows_test $(WINDOWS) --through $(WINE)
	tools/compare_programs $(RELEASE)/cli/kinemend $(WINDOWS) --through $(WINE)

libcxx: ## compile everything with Clang and libc++ as on macOS, with the threads of the standard library, and test it
	$(need) core test sanitize libcxx
	@cmake --preset libcxx >/dev/null
	cmake --build --preset libcxx -j $(JOBS)
	ctest --preset libcxx -j $(JOBS)

libcxx-test: build libcxx ## compare its bytes with those of the program here, on twenty takes and on every fixture
	tools/compare_programs $(RELEASE)/cli/kinemend $(BUILD)/libcxx/cli/kinemend
	tools/compare_programs $(RELEASE)/cli/kinemend $(BUILD)/libcxx/cli/kinemend --fixtures

wasm: ## the module for JavaScript by Emscripten: build/wasm/wasm/kinemend.mjs and kinemend_module.wasm
	$(need) core wasm
	tools/wasm_tools $(BUILD)/wasm_tools
	@cmake --preset wasm >/dev/null
	cmake --build --preset wasm -j $(JOBS) --target kinemend_module

web-app: wasm ## kinemend.html, the page of `view` in one file that needs no program: build/wasm/wasm/kinemend.html
	$(need) page
	@cmake --preset wasm -DKINEMEND_WEB=ON >/dev/null
	cmake --build --preset wasm -j $(JOBS) --target kinemend_app

npm-package: wasm ## the npm package of the module: build/wasm/wasm/npm/kinemend-0.2.0.tgz
	$(need) page
	wasm/npm/make_package $(BUILD)/wasm/wasm

wasm-test: build web-app npm-package ## the module in Node, the app and the package in a browser write the same bytes as the program on twenty takes
	$(need) page browser
	rm -rf $(BUILD)/wasm/takes
	tools/compare_programs $(RELEASE)/cli/kinemend $(BUILD)/wasm/takes --make-takes
	cd $(BUILD)/wasm/web && npm ci --ignore-scripts --prefer-offline --silent
	cd $(BUILD)/wasm/web && node $(CURDIR)/web/test/app_test.mjs $(CURDIR)/$(RELEASE)/cli/kinemend $$(command -v chromium) ../wasm/kinemend.html screenshots \
	  $(CURDIR)/examples/takes $(CURDIR)/$(BUILD)/wasm/takes
	cd $(BUILD)/wasm/web && node $(CURDIR)/wasm/npm/package_test.mjs $(CURDIR)/$(RELEASE)/cli/kinemend $$(command -v chromium) ../wasm/npm/kinemend-*.tgz $(CURDIR)/examples/takes
	tools/compare_programs $(RELEASE)/cli/kinemend tools/wasm_program --methods bilateral,nonlocal,gaussian,butterworth,median,kalman,wavelet,learned

blender-addon: ## the Blender add-on: build/blender/kinemend_blender-0.2.0.zip
	@tools/make_blender_addon

blender-test: $(RELEASE)/.built ## run the add-on within Blender, without a window and in one on no screen
	$(need) core test blender
	@cmake --preset release >/dev/null
	ctest --preset release -R blender

blender-pictures: blender-test ## the pictures of docs/blender.md again
	cp $(RELEASE)/blender/*.png docs/pictures/

deb: build ## the Debian packages kinemend and libkinemend-dev, in build/deb
	$(need) package
	tools/make_deb $(RELEASE)

dist: ## all downloads, with checksums and a list of the libraries inside: build/dist (every compiler: about as long as three builds)
	$(need) core package python windows wasm page
	$(MAKE) build windows web-app npm-package
	tools/make_dist

dist-quick: ## the same without what other compilers make: build/dist
	$(need) core package python
	$(MAKE) build
	tools/make_dist --quick

dist-test: dist ## make them again in a clone and compare the bytes; install the wheel into a fresh Debian (needs root)
	tools/dist_test

dist-test-quick: dist-quick ## pack them again with another umask, locale and time zone, and compare the bytes
	tools/dist_test --quick

deb-test: deb ## install the packages into a fresh Debian, clean a take and build the snippet of docs/cpp.md there (needs root)
	tools/deb_test build/deb

install-test: build ## install into a folder and build the programs of docs/cpp.md and docs/install.md against it
	tools/install_test $(RELEASE)

windows-install-test: windows ## the same for Windows: the static library, its headers and its package, and programs that run under Wine
	$(need) core windows wine
	cmake --build --preset windows -j $(JOBS) --target kinemend_installed
	tools/install_test $(BUILD)/windows --through $(WINE) -DCMAKE_TOOLCHAIN_FILE=$(CURDIR)/cmake/toolchains/mingw-w64.cmake

libcxx-install-test: libcxx ## the same with Clang and libc++
	cmake --build --preset libcxx -j $(JOBS) --target kinemend_installed
	tools/install_test $(BUILD)/libcxx -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS=-stdlib=libc++

$(RELEASE)/.built: FORCE
	$(need) core test
	@cmake --preset release
	cmake --build --preset release -j $(JOBS)
$(RELEASE)/.benches: FORCE
	$(need) core bench
	@cmake --preset release >/dev/null
	cmake --build --preset release -j $(JOBS) --target kinemend_bench kinemend_papers kinemend_cli
FORCE:

test: $(RELEASE)/.built ## build and run the tests (real takes too where data/real or KINEMEND_DATA is a folder); says what it leaves out
	@cat $(RELEASE)/left_out.txt
	@[ -n "$$KINEMEND_LONG" ] || echo "Left out: tests that take minutes (KINEMEND_LONG=1 runs them)"
	ctest --preset release -j $(JOBS)

test-all: ## the same, with training, pages, browser, Python and Blender installed, so that nothing is left out
	$(need) core test page browser train python blender
	$(MAKE) test

# Rooms that are not sanitised come from the release build.
asan-build:
	$(need) core test sanitize
	@cmake --preset release >/dev/null
	cmake --build --preset release -j $(JOBS) --target kinemend_rooms
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
	cmake --build --preset release --target $(CURDIR)/$(RELEASE)/web/page.js
	cp $(RELEASE)/web/page.js $(RELEASE)/web/page.css web/dist/

bench: $(RELEASE)/.benches ## the speed tables, beside SciPy's figures of the same run (CHECK=1: compared with the stored ones)
	tools/run_benchmarks $(RELEASE)
	$(if $(CHECK),tools/check_figures build/bench --speeds)

bench-quick: $(RELEASE)/.benches
	tools/run_benchmarks $(RELEASE) --quick

papers: $(RELEASE)/.benches ## the papers' own experiments, and the figures of pages, under build/papers (CHECK=1: compared with the stored ones)
	tools/run_papers $(RELEASE)
	$(if $(CHECK),tools/check_figures build/papers)

# Uses synthetic takes, so that the figures are the same everywhere.
papers-quick: $(RELEASE)/.benches
	KINEMEND_DATA= tools/run_papers $(RELEASE) --quick
	tools/check_figures build/papers --quick

pictures: $(RELEASE)/.built ## every picture of README.md and docs again, by the program from takes that ship
	tools/make_pictures $(RELEASE)

fuzz: ## fuzz each target for a minute (FUZZ_SECONDS=60)
	$(need) core test sanitize
	tools/run_fuzzers $${FUZZ_SECONDS:-60}

first-test: ## make demo and make test of the last commit in a fresh Debian, with the times of both (needs root)
	$(need) package
	tools/first_test

cluster-test: build ## an array of 8 in a Slurm cluster of its own, one task killed and requeued, is one run (needs root)
	$(need) core cluster
	tools/cluster_test --takes $${CLUSTER_TAKES:-500} $(RELEASE)/cli/kinemend || [ $$? = 77 ]

soak: $(RELEASE)/.built ## mutated input, kills, threads and lossy streams for five minutes (SOAK_SECONDS=300)
	tools/soak $(RELEASE) $${SOAK_SECONDS:-300}

nightly: ## what continuous integration leaves out: sanitisers, a fresh Debian, a cluster, browser, soak, analysis of includers
	$(need)
	tools/lint --includers
	$(MAKE) asan ASAN=asan-all
	$(MAKE) libcxx-test libcxx-install-test windows-test windows-install-test
	KINEMEND_LONG=1 $(MAKE) test-all
	$(MAKE) fuzz soak dist-test deb-test install-test first-test cluster-test bench-quick
	tests/live/clients/node_osc_test $(RELEASE)/cli/kinemend

clean: ## remove everything that was built
	rm -rf $(BUILD)
