# A thin wrapper over CMake: every goal installs the Debian packages it lacks, configures and builds.
BUILD ?= build
SIZE  ?=
JOBS  ?= $(shell nproc)

.PHONY: all build figures test validate bench bench-peers bench-scaling \
        bench-figures precision check-asan check-tsan check-clang check-valgrind \
        check clean format

all: build

build:
	@tools/install-packages packages.txt
	@cmake -S . -B $(BUILD) -G Ninja -DCMAKE_BUILD_TYPE=Release >$(BUILD).configure.log 2>&1 \
	    || { cat $(BUILD).configure.log; exit 1; }
	@rm -f $(BUILD).configure.log
	@cmake --build $(BUILD) -j $(JOBS)

# All studies in half an hour: those whose published size takes longer run at `brief`. SIZE=published runs all whole.
# A study that fails keeps no other from its page.
figures: build
	@CLAST_SIZE=$(or $(SIZE),fit) cmake --build $(BUILD) --target figures -- -k 0

figures-%: build
	@CLAST_SIZE=$(SIZE) cmake --build $(BUILD) --target figures-$*

validate: build
	@CLAST_SIZE=$(SIZE) cmake --build $(BUILD) --target validate

validate-%: build
	@CLAST_SIZE=$(SIZE) cmake --build $(BUILD) --target validate-$*

# Speed: the engine's scenes and the renderer; beside the peers; against size; against error.
bench bench-peers bench-scaling bench-figures precision: build
	@cmake --build $(BUILD) --target $@

test: build
	@ctest --test-dir $(BUILD) --output-on-failure -j $(JOBS)

# The slower proofs: other compiler, sanitizers, valgrind. `make check` runs them all.
check: check-clang check-asan check-tsan check-valgrind

check-clang check-asan check-tsan:
	@tools/install-packages packages.txt
	@cmake --preset $(@:check-%=%) >/dev/null
	@cmake --build --preset $(@:check-%=%) -j $(JOBS)
	@ctest --preset $(@:check-%=%) -j $(JOBS)

check-valgrind: build
	@tests/valgrind $(BUILD)

format:
	@git ls-files '*.c' '*.h' | xargs clang-format -i

clean:
	@rm -rf build build-*
