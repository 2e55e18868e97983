# rt.h: the demos, the tests and the checks. "make help" lists what there is.
#
# Nothing about packages is decided while make reads this file, because "make deps demo07"
# must work where "deps" has yet to install them: OPENMP, SDL and STB are asked for when a
# recipe needs them (= and not :=).

CXX     ?= c++
PREFIX  ?= /usr/local
CFLAGS  ?= -O3 -fno-math-errno
BUILD   ?= build
ARGS    ?=

# MACHINE: compile for the machine that runs make. Packets have 16 rays if it has AVX-512,
# otherwise 8. In a lab of mixed machines, "make -B demos MACHINE=" makes programs that run on all.
MACHINE  = $(eval MACHINE := $(shell $(CC) -march=native -E -x c /dev/null >/dev/null 2>&1 && \
    echo -march=native))$(MACHINE)

# gcc for Windows may put vectors where the stack is not aligned to them; its assembler knows moves
# that do not mind.
MOVES    = $(eval MOVES := $(shell $(CC) -dumpmachine 2>/dev/null | grep -q mingw && \
    echo -Wa,-muse-unaligned-vector-move))$(MOVES)

# -ffp-contract=off: the same bits everywhere; otherwise gcc would contract a*b+c where it can.
FLAGS    = -std=c99 $(CPPFLAGS) $(MACHINE) $(MOVES) $(CFLAGS) -ffp-contract=off $(WARNINGS)
WARNINGS = -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion
OPENMP   = $(eval OPENMP := $(shell .ci/deps openmp '$(CC)'))$(OPENMP)
STB      = $(shell .ci/deps stb '$(CC)')
FONT     = $(shell .ci/deps font '$(CC)')
TTF      = $(and $(FONT),$(shell pkg-config --exists SDL2_ttf 2>/dev/null && echo SDL2_ttf))
SDL      = $(patsubst -I%,-isystem %,$(shell pkg-config --cflags sdl2 $(TTF) 2>/dev/null)) $(TTF:%=-DHAVE_TTF '-DFONT="$(FONT)"')
SDL_LIBS = $(filter-out -mwindows,$(shell pkg-config --libs sdl2 $(TTF) 2>/dev/null))
# assimp reads meshes from files for demos 16 and 17; they also work without it.
ASSIMP   = $(shell pkg-config --exists assimp 2>/dev/null && echo -DHAVE_ASSIMP $(patsubst -I%,-isystem %,$(shell pkg-config --cflags assimp 2>/dev/null)))
LIBS     = $(LDFLAGS) $(SDL_LIBS) $(shell pkg-config --libs assimp 2>/dev/null)
CMOCKA   = $(shell pkg-config --cflags --libs cmocka libcjson 2>/dev/null)

# Waiting threads should sleep: otherwise, beside other programs, they take the core from
# the threads that they wait for.
export OMP_WAIT_POLICY ?= passive

DEMOS    = demo01 demo02 demo03 demo04 demo05 demo06 demo07 demo08 demo09 demo10 \
           demo11 demo12 demo13 demo14 demo15 demo16 demo17
# Chapter 18 has no picture of its own; mpicc compiles it, if it is there.
MPICC    = $(shell command -v mpicc)
MPIRUN   = mpirun -np 2
HEADERS := rt.h $(wildcard demos/*.h)
PROGRAM  = $(patsubst %,$(BUILD)/%.o,main command files load parts platform progress window viewer)
TESTS   := $(patsubst tests/%.c,%,$(sort $(wildcard tests/[0-9]*.c)))

.PHONY: help deps demos test golden check bench bench-rays docs deps-docs web deps-web deps-mpi demo18 cluster windows starters try grade install clean $(DEMOS)

help: ## this list
	@echo '  make demo01 ... demo18  build and run a chapter; ARGS="1280 960 --samples 64"'
	@sed -n 's/^\([a-z%-]*\):.*## \(.*\)/\1|\2/p' Makefile | \
	    awk -F'|' '{ printf "  make %-18s %s\n", $$1, $$2 }'

deps: ## install what is missing: SDL2, SDL2_ttf, a font, stb, cmocka, cJSON, OpenMP
	@.ci/deps install '$(CC)'

deps-web: ## the same for "make web": clang, lld and wasi-libc, node, npm, chromium
	@.ci/deps web

deps-docs: ## the same for the site and the PDF of "make docs": pandoc, chromium, pdfinfo, a maths font
	@.ci/deps docs

deps-mpi: ## the same for "make cluster": Open MPI
	@.ci/deps mpi

ifneq (,$(filter deps deps-web deps-docs deps-mpi,$(MAKECMDGOALS)))
.NOTPARALLEL: # with -j, too, "deps" comes first
endif

# ---------------------------------------------------------------------------- the demos

demos: $(DEMOS:%=$(BUILD)/%) ## render all to build/, without windows
	@for demo in $^; do $$demo --no-window $(ARGS) || exit; done

$(DEMOS): %: $(BUILD)/%
	$(BUILD)/$@ $(ARGS)

$(BUILD)/demo18: demos/demo18_many_machines.c $(BUILD)/program.a $(HEADERS) $(BUILD)/with$(if $(MPICC),,out)-mpi
	$(or $(MPICC),$(CC)) $(FLAGS) $(MPICC:%=-DHAVE_MPI) $(OPENMP) -o $@ $< $(BUILD)/program.a $(LIBS) -lm

# A mark, so that demo18 is compiled again once there is MPI.
$(BUILD)/with-mpi $(BUILD)/without-mpi:
	@mkdir -p $(BUILD)
	@rm -f $(BUILD)/with-mpi $(BUILD)/without-mpi
	@touch $@

demo18: $(BUILD)/demo18
	$(BUILD)/demo18 $(ARGS)

$(BUILD)/tests/machines: tests/machines.c demos/demo18_many_machines.c $(BUILD)/program.a $(HEADERS)
	@mkdir -p $(BUILD)/tests
	$(MPICC) $(FLAGS) -DHAVE_MPI $(OPENMP) -o $@ $< $(BUILD)/program.a $(LIBS) -lm

cluster: ## chapter 18 by MPI, two processes; or MPIRUN="mpirun --oversubscribe -np 4"
	@command -v mpirun >/dev/null || { echo "make: mpirun is missing: run 'make deps-mpi'" >&2; exit 1; }
	@$(MAKE) --no-print-directory $(BUILD)/demo18 # by a make that looks for mpicc anew, after deps-mpi
	[ "$$(id -u)" != 0 ] || export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; \
	    $(MPIRUN) $(BUILD)/demo18 --no-window $(ARGS)

.SECONDEXPANSION:
$(DEMOS:%=$(BUILD)/%): $(BUILD)/%: $$(wildcard demos/$$*_*.c) $(BUILD)/program.a $(HEADERS)
	$(CC) $(FLAGS) $(OPENMP) -o $@ $< $(BUILD)/program.a $(LIBS) -lm

$(BUILD)/program.a: $(PROGRAM)
	@rm -f $@
	$(AR) -rcs $@ $^

$(PROGRAM): $(BUILD)/%.o: demos/%.c $(HEADERS)
	@.ci/deps found '$(CC)' sdl2 stb openmp SDL2_ttf font
	@mkdir -p $(BUILD)
	$(CC) $(FLAGS) $(OPENMP) $(SDL) $(STB) $(ASSIMP) -c -o $@ $<

# ---------------------------------------------------------------------------- the tests

# What users' builds may do; "make check" leaves it out where it has been run already.
USERS    = tests/compile/run

test: $(TESTS:%=$(BUILD)/tests/%) $(BUILD)/tests/render_scene $(DEMOS:%=$(BUILD)/%) ## run the tests (seconds)
	@CC='$(CC)' CXX='$(CXX)' BUILD='$(BUILD)' tests/run $(TESTS:%=$(BUILD)/tests/%) $(USERS)

# Most tests are linked with rt.o. These look inside rt.h, or give it memory of their own.
WHOLE    = $(filter 12% 13% 14% 15% 17% 18% 19% 28%,$*)

$(BUILD)/rt.o: rt.h
	@.ci/deps found '$(CC)' openmp
	@mkdir -p $(BUILD)
	printf '#include "rt.h"\n' | $(CC) $(FLAGS) $(OPENMP) -DRT_IMPLEMENTATION -c -o $@ -x c -

$(BUILD)/tests/%: tests/%.c $(BUILD)/rt.o $(wildcard tests/*.h) $(HEADERS) $(wildcard demos/demo[0-9]*.c)
	@.ci/deps found '$(CC)' cmocka libcjson
	@mkdir -p $(BUILD)/tests
	$(CC) $(FLAGS) -Wno-double-promotion -Wno-enum-float-conversion $(OPENMP) -o $@ $< \
	    $(if $(WHOLE),,-DLINKED $(BUILD)/rt.o) $(LDFLAGS) $(CMOCKA) -lm

$(BUILD)/tests/29_parts: $(BUILD)/tests/broken
$(BUILD)/tests/broken: tests/broken.c $(BUILD)/program.a $(HEADERS)
	@mkdir -p $(BUILD)/tests
	$(CC) $(FLAGS) $(OPENMP) -o $@ $< $(BUILD)/program.a $(LIBS) -lm

# --------------------------------------------------------------------------- the classroom

export FILE SEED ONLY OUT SCENE

starters: ## files to begin with, one for each routine, in build/starters
	@tests/classroom/starter $(BUILD)/starters
	@echo "$(BUILD)/starters: copy one, fill it in, then make try FILE=..."

try: $(BUILD)/program.a ## your own routine in place of rt.h's: FILE=my_hit_sphere.c SCENE=96601
	@.ci/deps found '$(CC)' cmocka libcjson
	@CC='$(CC)' FLAGS='$(FLAGS) $(OPENMP)' LIBS='$(LIBS)' BUILD='$(BUILD)' \
	    tests/classroom/run try "$$FILE" $(ARGS)

grade: ## marks for a file or a folder: FILE=submissions SEED=7 ONLY=rt_hit_sphere OUT=marks.csv
	@CC='$(CC)' BUILD='$(BUILD)' tests/classroom/run grade "$$FILE"

# -------------------------------------------------------------------- the tests, once more

golden: $(TESTS:%=$(BUILD)/tests/%) ## record the small pictures and hashes to compare with
	-GOLDEN=record tests/run $^
	@tests/check record

check: test ## all that a maintainer runs before a release (minutes)
	@tests/check

check-%: $(DEMOS:%=$(BUILD)/%) ## one check: tsan fuzz coverage mutate arm windows mac editor standards levels, or see tests/check
	@tests/check $*

# ---------------------------------------------------------------------------- the rest

bench: ## speed against the report's way and other renderers (two minutes)
	@CC='$(CC)' CXX='$(CXX)' CFLAGS='$(MACHINE) $(CFLAGS)' OPENMP='$(OPENMP)' BUILD='$(BUILD)' tests/bench/run

bench-rays: ## single rays beside Embree and tinybvh: TINYBVH=where tiny_bvh.h is
	@CC='$(CC)' CXX='$(CXX)' CFLAGS='$(MACHINE) $(CFLAGS)' OPENMP='$(OPENMP)' BUILD='$(BUILD)' \
	    TINYBVH='$(TINYBVH)' tests/bench/run --rays 5

docs: $(DEMOS:%=$(BUILD)/%) ## renew code, numbers, pictures in docs/; build/site/index.html, build/rt.pdf
	@for demo in $(DEMOS); do \
	    $(BUILD)/$$demo --no-window --quiet --out docs/images/$$demo.png || exit; \
	done
	$(BUILD)/demo07 --no-window --quiet --samples 256 --out docs/images/demo07-256.png
	@for sampler in random sobol; do \
	    $(BUILD)/demo09 320 240 --sampler $$sampler --no-window --quiet \
	        --out docs/images/demo09-$$sampler.png || exit; \
	done
	$(BUILD)/demo09 --no-window --quiet --samples 16 --out docs/images/demo10-noisy.png
	$(BUILD)/demo10 --no-window --quiet --samples 4 --out docs/images/demo10-4.png
	$(BUILD)/demo14 --no-window --quiet --samples 64 --out docs/images/demo14-64.png
	$(BUILD)/demo15 --no-window --quiet --texture docs/images/demo09.png \
	    --out docs/images/demo15-texture.png
	docs/pictures.sh
	@tests/check screenshots
	docs/numbers.sh
	docs/renew.sh README.md docs/*.md
	docs/gallery.sh
	tests/classroom/session --docs
	docs/site.sh

web: ## the chapters' pictures alive in a browser: build/web/pages/index.html
	@docs/web.sh

windows: ## the demos for Windows, made on Linux: build/windows, build/rt-windows.zip
	@docs/windows.sh

install: ## rt.h and rt.pc to PREFIX (/usr/local), under DESTDIR
	install -d -m 755 '$(DESTDIR)$(PREFIX)/include' '$(DESTDIR)$(PREFIX)/share/pkgconfig'
	install -m 644 rt.h '$(DESTDIR)$(PREFIX)/include/rt.h'
	awk -v prefix='$(PREFIX)' '/^#define RT_VERSION_/ { v = v dot $$3; dot = "." } END { \
	    printf "prefix=%s\n\nName: rt\nDescription: a small ray tracer in one C header\n", prefix; \
	    printf "Version: %s\nCflags: -I$${prefix}/include\nLibs: -lm\n", v }' rt.h \
	    > '$(DESTDIR)$(PREFIX)/share/pkgconfig/rt.pc'
	chmod 644 '$(DESTDIR)$(PREFIX)/share/pkgconfig/rt.pc'

clean: ## remove build/
	rm -rf $(BUILD)
