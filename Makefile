# SPDX-License-Identifier: GPL-3.0-or-later
# mpm3d: make, make run, make test. `make help` lists the targets.
#   CC=clang      another compiler          CFLAGS="-O2 -g"  your own flags
#   NATIVE=1      this machine's instructions   SAN=1        address and undefined sanitizers

CFLAGS ?= -O3 -g
PREFIX ?= /usr/local
NATIVE ?= 0
SAN    ?= 0

build := build/$(notdir $(CC))$(if $(filter 1,$(NATIVE)),-native)$(if $(filter 1,$(SAN)),-san)
# One rounding per product and per sum: the same bits from every compiler, processor and thread count.
flags := -std=c11 -Wall -Wextra -Wpedantic -Isrc -MMD -MP -ffp-contract=off
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
tools   := $(build)/tecdiff $(build)/tecstat

all: mpm3d $(tools)

# The program at the top is the one of the last build.
mpm3d: $(build)/mpm3d
	cp -f $< $@

$(build)/mpm3d: $(objects)
	$(CC) $(CFLAGS) $(san) $(openmp) $(LDFLAGS) $^ -lm -o $@

$(build)/%.o: src/%.c
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(flags) $(CFLAGS) $(san) $(openmp) -c $< -o $@

$(build)/tec%: tools/tec%.c tools/tecplot_read.c tools/tecplot_read.h
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(flags) $(CFLAGS) $(san) $< tools/tecplot_read.c -lm -o $@

-include $(objects:.o=.d)
