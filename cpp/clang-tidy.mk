# Runs clang-tidy on the C++ sources that changed since it last passed; called by `make lint` from the project's root.
sources := $(shell find cpp tests/cpp -name '*.cpp')
headers := $(shell find cpp tests/cpp -name '*.hpp')
stamps := $(sources:%=build/lint/tidy/%)

.PHONY: all
all: $(stamps)

build/lint/tidy/%: % $(headers) .clang-tidy cpp/CMakeLists.txt tests/cpp/.clang-tidy
	@echo "clang-tidy $<"
	@clang-tidy --quiet -p build/lint $<
	@mkdir -p $(@D) && touch $@
