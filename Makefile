# SPDX-License-Identifier: GPL-3.0-or-later
# mpm3d: make, make run, make test. `make help` lists the targets.
#   CC=clang      another compiler          CFLAGS="-O2 -g"  your own flags
#   NATIVE=1      this machine's instructions   SAN=1        address and undefined sanitizers

CFLAGS ?= -O3 -g
PREFIX ?= /usr/local
NATIVE ?= 0
SAN    ?= 0

build := build/$(notdir $(CC))$(if $(filter 1,$(NATIVE)),-native)$(if $(filter 1,$(SAN)),-san)
# One rounding per product and per sum: the same bits from every compiler, processor and thread
# count. The two other flags change no result; without them gcc leaves selections unvectorised.
flags := -std=c11 -Wall -Wextra -Wpedantic -Isrc -MMD -MP -ffp-contract=off -fno-math-errno -fno-trapping-math
# Clang says so where it leaves a loop unvectorised; that is no fault.
flags += $(if $(findstring clang,$(CC)),-Wno-pass-failed)
flags += $(if $(filter 1,$(NATIVE)),-march=native)
flags += $(if $(WERROR),-Werror)
ifeq ($(SAN),1)
san := -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer -DNO_CLONES
endif
openmp := $(shell echo 'int main(void){return 0;}' | $(CC) -fopenmp -x c - -o /dev/null 2>/dev/null && echo -fopenmp)
$(if $(openmp),,$(warning $(CC) has no OpenMP here: mpm3d will use one thread))

sources := $(wildcard src/*.c src/*/*.c)
objects := $(sources:src/%.c=$(build)/%.o)
library := $(filter-out $(build)/main.o,$(objects))
tools   := $(build)/tecdiff $(build)/tecstat $(build)/tecview

# Parts of the tools, which share nothing with the program but src/base.
tool_parts      := $(patsubst tools/%.c,$(build)/tools/%.o,$(wildcard tools/*.c))
tecplot_objects := $(filter $(build)/tools/tecplot_% $(build)/tools/words.o,$(tool_parts))
draw_objects    := $(filter $(build)/tools/draw_%,$(tool_parts)) $(build)/base/memory.o $(build)/base/status.o
view_objects    := $(filter-out $(build)/tools/tecview.o,$(filter $(build)/tools/tecview_%,$(tool_parts)))

# The program at the top is that of the last plain build.
all: $(build)/mpm3d $(tools) $(if $(filter 1,$(SAN)),,mpm3d)

mpm3d: $(build)/mpm3d always
	@cmp -s $< $@ || cp -f $< $@

$(build)/mpm3d: $(objects)
	@echo "  CC  $@"
	@$(CC) $(CFLAGS) $(san) $(openmp) $(LDFLAGS) $^ -lm -o $@

$(build)/%.o: src/%.c Makefile
	@mkdir -p $(@D)
	@echo "  CC  $@"
	@$(CC) $(CPPFLAGS) $(flags) $(CFLAGS) $(san) $(openmp) -c $< -o $@

$(build)/tools/%.o: tools/%.c Makefile
	@mkdir -p $(@D)
	@echo "  CC  $@"
	@$(CC) $(CPPFLAGS) $(flags) $(CFLAGS) $(san) -c $< -o $@

$(build)/tecview: $(view_objects) $(draw_objects)
$(build)/tecstat: $(build)/tools/swing.o

$(build)/tec%: $(build)/tools/tec%.o $(tecplot_objects)
	@echo "  CC  $@"
	@$(CC) $(CFLAGS) $(san) $(LDFLAGS) $^ -lm -o $@

unit_tests := $(patsubst tests/unit/%.c,$(build)/tests/%,$(wildcard tests/unit/test_*.c))

$(build)/tests/%: tests/unit/%.c tests/unit/check.h tests/unit/sph_fixture.h $(library)
	@mkdir -p $(@D)
	@echo "  CC  $@"
	@$(CC) $(CPPFLAGS) $(filter-out -MMD -MP,$(flags)) $(CFLAGS) $(san) $(openmp) $< $(library) -lm -o $@

$(build)/tests/test_draw: tests/unit/test_draw.c tests/unit/check.h tests/unit/read_png.h \
    $(draw_objects) $(build)/tools/tecview_chart.o
	@mkdir -p $(@D)
	@echo "  CC  $@"
	@$(CC) $(CPPFLAGS) $(filter-out -MMD -MP,$(flags)) $(CFLAGS) $(san) $(openmp) $< $(filter %.o,$^) -lm -o $@

# Builds and runs the tensile test of the thesis, and prints its result beside the theory.
run: all
	$(build)/mpm3d -o build/run decks/thesis/tensile.mpm
	@sh tools/show_tensile.sh $(build)/tecstat build/run/tensile_anim.dat

fuzz_replays := $(patsubst tests/fuzz/fuzz_%.c,$(build)/fuzz_replay_%,$(wildcard tests/fuzz/fuzz_*.c))

# The whole suite; the last line counts.
test: all $(unit_tests) $(fuzz_replays)
	@sh tests/run.sh $(build)

# All decks of decks/ and of the tests, also those that take minutes, with their times.
decks: all
	@sh tests/decks/run_decks.sh $(build) all

# Speed, against the memory bandwidth of this machine.
bench: $(build)/bench
	$(build)/bench $(if $(QUICK),quick)

$(build)/bench: tests/bench/bench.c $(library)
	@echo "  CC  $@"
	@$(CC) $(CPPFLAGS) $(filter-out -MMD -MP,$(flags)) $(CFLAGS) $(openmp) $< $(library) -lm -o $@

# Accuracy by scheme: order of convergence, energy and momentum, cell crossing.
study: $(build)/tests/test_wave $(build)/tests/test_conservation
	$(build)/tests/test_wave
	$(build)/tests/test_conservation

# Accuracy and cost by case, scheme and resolution, as the page report/index.html and the table report/table.txt.
report: all
	@sh tests/report/report.sh $(build) report $(if $(QUICK),quick,full)

# The largest stable time step by scheme and shape, and how extreme scenes end: report/stability.txt.
stability: all
	@QUICK=$(QUICK) sh tests/stability/stability.sh $(build) report

# Runs that are killed at random moments and go on, and disks that fill up: KILLS=300 SEED=1.
kills: all
	@KILLS=$(KILLS) SEED=$(SEED) sh tests/stability/kills.sh $(build)

# The last state of decks of each chapter of the thesis, of smoothed and of reproducing kernel particles, as pictures in report/pictures.
pictures: all
	@sh tools/pictures.sh $(build) report/pictures
	@sh tools/pictures_sph.sh $(build) report/pictures
	@sh tools/pictures_rkpm.sh $(build) report/pictures

# MANUAL.md, from the program's own tables.
manual: $(build)/mpm3d
	$(build)/mpm3d --manual >MANUAL.md

# The suite under address and undefined sanitizers with gcc and clang, warnings as errors, the module prefixes of all
# functions that are visible outside their file, gcc's analyser, and valgrind where it is there.
check:
	$(MAKE) WERROR=1 SAN=1 CFLAGS="-O1 -g" CC=gcc test
	@if command -v clang >/dev/null; then $(MAKE) WERROR=1 SAN=1 CFLAGS="-O1 -g" CC=clang test && \
	    $(MAKE) WERROR=1 CC=clang test; else echo "no clang here: its half of the check is left out"; fi
	$(MAKE) WERROR=1 CC=gcc test
	$(MAKE) CC=gcc decks
	sh tools/check_names.sh build/gcc
	sh tests/check/analyse.sh
	sh tests/check/memcheck.sh build/gcc
	sh tests/check/leave_out.sh build/gcc

install: all
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/share/mpm3d
	install -m 755 $(build)/mpm3d $(tools) $(DESTDIR)$(PREFIX)/bin
	cp -r decks $(DESTDIR)$(PREFIX)/share/mpm3d

uninstall:
	rm -f $(addprefix $(DESTDIR)$(PREFIX)/bin/,mpm3d $(notdir $(tools)))
	rm -rf $(DESTDIR)$(PREFIX)/share/mpm3d

clean:
	rm -rf build mpm3d

help:
	@echo "make          builds mpm3d and the tools tecdiff (compares), tecstat (numbers), tecview (pictures)"
	@echo "make run      builds, runs the tensile test, prints its result beside the theory"
	@echo "make test     runs all tests; the last line counts"
	@echo "make decks    runs all decks, also the long ones, and compares their numbers"
	@echo "make check    the tests under sanitizers, with gcc and clang, warnings as errors; make decks; gcc's analyser,"
	@echo "              valgrind on small decks of every method, instructions in files of features that are off"
	@echo "make bench    speed: cost by phase, threads, size; against this machine's memory bandwidth"
	@echo "make study    accuracy: convergence and conservation by scheme"
	@echo "make report   accuracy against run time by case and scheme: report/index.html; QUICK=1 for the short form"
	@echo "make stability the largest stable step by scheme and shape, extreme scenes (QUICK=1: less of it)"
	@echo "make kills    runs killed at random moments that go on, and full disks (KILLS=300, 3 minutes)"
	@echo "make pictures draws decks of each chapter of the thesis, of smoothed and reproducing kernel particles (7 minutes)"
	@echo "make manual   writes MANUAL.md from the program's tables"
	@echo "make fuzz     fuzzes the readers of decks, checkpoints, STL files (clang); FUZZ=stl: one of them; FUZZ_TIME=seconds"
	@echo "make install  PREFIX=$(PREFIX), DESTDIR; make uninstall; make clean"
	@echo "options: CC, CFLAGS, NATIVE=1 (this machine's instructions), SAN=1 (sanitizers)"

.PHONY: all run test decks check kills bench study manual fuzz install uninstall clean help pictures report stability
.PHONY: always
.SECONDARY: $(tool_parts)
.DEFAULT_GOAL := all

-include $(objects:.o=.d) $(tool_parts:.o=.d)

# --- fuzzing: `make fuzz FUZZ_TIME=900` searches, a third of the time for each reader; `make fuzz FUZZ=stl` searches
# one; fuzz_replay_* give the kept seeds to any build ---

FUZZ_TIME ?= 900
FUZZ      ?= deck checkpoint stl
fuzz_flags := -std=c11 -g -O1 -Isrc -DNO_CLONES -MMD -MP -fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all
fuzz_share  = $(shell echo $$(($(FUZZ_TIME) / $(words $(FUZZ)))))
fuzz_objects := $(sources:src/%.c=build/fuzz/%.o)
fuzz_library := $(filter-out build/fuzz/main.o,$(fuzz_objects))
fuzz_parts   := tests/fuzz/folder.c tests/fuzz/fuzz.h tests/fuzz/folder.h

# How each is searched: longest input in bytes, seconds that none may exceed; messages of runs are not shown.
fuzz_options_deck       := -max_len=4096 -timeout=1
fuzz_options_checkpoint := -max_len=1024 -timeout=5 -entropic=0 -close_fd_mask=2
fuzz_options_stl        := -max_len=4096 -timeout=2

$(build)/fuzz_replay_%: tests/fuzz/replay.c tests/fuzz/fuzz_%.c $(fuzz_parts) $(library)
	@echo "  CC  $@"
	@$(CC) $(CPPFLAGS) $(filter-out -MMD -MP,$(flags)) $(CFLAGS) $(san) $(openmp) $(filter %.c %.o,$^) -lm -o $@

# The method counts where it was, but not what it compares: numbers of particles are no words to find.
fuzz_watch = $(if $(filter mpm/% material/%,$*),-fsanitize-coverage=inline-8bit-counters$(comma)pc-table,-fsanitize=fuzzer-no-link)
comma := ,

build/fuzz/%.o: src/%.c Makefile
	@mkdir -p $(@D)
	@echo "  CC  $@"
	@clang $(fuzz_flags) $(fuzz_watch) -c $< -o $@

build/fuzz_%: tests/fuzz/libfuzzer.c tests/fuzz/fuzz_%.c $(fuzz_parts) $(fuzz_library)
	@echo "  CC  $@"
	@clang $(filter-out -MMD -MP,$(fuzz_flags)) -fsanitize=fuzzer $(filter %.c %.o,$^) -lm -o $@

fuzz:
	@if ! echo 'int LLVMFuzzerTestOneInput(const char *b, long n) { (void)b; (void)n; return 0; }' | \
	    clang -fsanitize=fuzzer -x c - -o /dev/null 2>/dev/null; then \
	    echo "fuzz: no clang with libFuzzer here, nothing is searched"; exit 0; fi; \
	$(MAKE) $(FUZZ:%=fuzz-%)

fuzz-%: build/fuzz_%
	@mkdir -p build/corpus_$*
	build/fuzz_$* -max_total_time=$(fuzz_share) $(fuzz_options_$*) -rss_limit_mb=2048 -print_final_stats=1 \
	    -dict=tests/fuzz/$*.dict -artifact_prefix=build/$*- build/corpus_$* tests/fuzz/seeds_$*

.SECONDARY: $(fuzz_objects) $(FUZZ:%=build/fuzz_%)
-include $(fuzz_objects:.o=.d)
