# Thin verbs over tools/*.sh and the CMake presets, for those who have make.
.DEFAULT_GOAL := build
.PHONY: setup build studio site blender-addon demo notebooks test test-page bench bench-parts test-clients format format-check tidy asan tsan sanitizers mutants fuzz clean

export JOBS ?= $(shell nproc)
CMAKE_BUILD := cmake --build --parallel $(JOBS) --preset
CXX_FILES = $(shell git ls-files '*.h' '*.cpp')

setup:  ## install what is missing, through apt
	@sh tools/setup.sh

build: setup  ## the release: build/release/bin/pelage
	@cmake --preset release -DPELAGE_TESTS=OFF -DPELAGE_BENCHMARKS=OFF
	@$(CMAKE_BUILD) release

studio: build  ## the studio's page, beside the program: build/release/bin/pelage studio opens it
	@sh tools/studio.sh

site: build  ## gallery, figures, guides, reference and the studio as plain files: out/site
	@sh tools/site.sh

blender-addon:  ## the add-on for Blender, with pictures of all coats: out/pelage_addon.zip
	@python3 tools/blender_addon.py

demo:  ## grow a coat on the built-in animal: out/demo.glb, out/demo.ply, out/demo.png
	@sh tools/demo.sh

notebooks:  ## the examples for Python as Jupyter notebooks: out/notebooks
	@python3 tools/notebooks.py out/notebooks python/examples/*.py

test:  ## build everything and run every test
	@sh tools/test.sh

test-page: studio  ## all of a journey through the studio's page in a browser: six minutes
	@JOURNEY=. bash tests/scripts/page_test.sh . build/release

BENCH_BUILD = cmake --preset release -DPELAGE_TESTS=OFF -DPELAGE_BENCHMARKS=ON
bench:  ## measure beside plain programs: docs/performance.md and bench/results, about ten minutes
	@sh tools/setup.sh libbenchmark-dev
	@$(BENCH_BUILD)
	@$(CMAKE_BUILD) release --target pelage_cli plain measure
	@python3 bench/tables.py $(BENCH)

bench-parts:  ## measure the parts of a run one by one; results in bench/results
	@sh tools/setup.sh libbenchmark-dev
	@$(BENCH_BUILD)
	@$(CMAKE_BUILD) release
	@$(CMAKE_BUILD) release --target run_benchmarks

# The tests of write_mesh leave a closed surface and one with boundary and uv seams in every format.
WRITTEN = build/release/test-files/WriteMesh.EveryFormatTwiceTheSameBytes
test-clients: demo test  ## install Blender, ParaView and others, and open the demo's and the tests' files in them
	@bash tests/clients/run.sh out/demo.glb out/demo.ply \
		$(foreach name,closed seamed,$(foreach extension,glb ply obj vtp,$(WRITTEN)/$(name).$(extension)))

asan: setup  ## every test under the address and undefined-behaviour sanitizers
	@cmake --preset asan
	@$(CMAKE_BUILD) asan
	@ctest --preset asan --parallel $(JOBS)

sanitizers: setup  ## readers, recipes, threads and linear systems under sanitizers without optimisation: some minutes
	@for preset in asan-quick tsan-quick; do cmake --preset $$preset && $(CMAKE_BUILD) $$preset || exit 1; done
	@bash tests/scripts/sanitizers_test.sh . build

tsan: setup  ## the tests of what runs on several threads under the thread sanitizer
	@cmake --preset tsan
	@$(CMAKE_BUILD) tsan
	@ctest --preset tsan --parallel $(JOBS)

mutants:  ## plant some 140 mistakes one by one and see whether the tests notice; an hour or two, in build/mutants
	@sh tools/setup.sh
	@python3 tools/mutants.py --jobs $(JOBS)

fuzz:  ## random bytes for every reader, SECONDS (30) for each, or for READERS="png recipe"; finds stay in build/fuzz/found
	@sh tools/setup.sh clang
	@cmake --preset fuzz
	@$(CMAKE_BUILD) fuzz --target input_fuzzer
	@sh tools/fuzz.sh $(or $(SECONDS),30) $(READERS)

format:  ## bring all sources into the house's format
	@clang-format -i $(CXX_FILES)

format-check:
	@clang-format --dry-run -Werror $(CXX_FILES)

# g++ knows warning options that clang does not.
tidy:  ## static analysis of src/ and apps/
	@sh tools/setup.sh clang-tidy
	@cmake --preset debug -DPELAGE_TESTS=OFF
	@git ls-files 'src/*.cpp' 'apps/*.cpp' | xargs -P $(JOBS) -n 4 clang-tidy -p build/debug --quiet \
		--extra-arg=-Wno-unknown-warning-option

clean:
	@rm -rf build out
