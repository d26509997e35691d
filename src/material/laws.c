/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of laws. */
#include "material/law.h"

#include <string.h>
#include <strings.h>

#define LATER(word, text) {.name = word, .doc = text, .later = text}

static const struct law law_john = LATER("john", "Johnson-Cook plasticity with temperature");
static const struct law law_sjc = LATER("sjc", "simplified Johnson-Cook plasticity with equation of state");
static const struct law law_sjcf = LATER("sjcf", "simplified Johnson-Cook plasticity with failure");
static const struct law law_jcf = LATER("jcf", "Johnson-Cook plasticity with damage and failure");
static const struct law law_hiex = LATER("hiex", "high explosive");
static const struct law law_null = LATER("null", "viscous fluid with equation of state");
static const struct law law_dpm = LATER("dpm", "Drucker-Prager with tension cut-off");
static const struct law law_neoh = LATER("neoh", "neo-Hookean hyperelasticity");

static const struct law *const rows[] = {&law_elas, &law_pla1, &law_pla2, &law_john, &law_sjc, &law_sjcf,
                                         &law_jcf,  &law_hiex, &law_null, &law_dpm,  &law_neoh, NULL};

const struct law *law_find(const char *name)
{
    for (const struct law *const *row = rows; *row; row++)
        if (strncasecmp(name, (*row)->name, 4) == 0)
            return *row;
    return NULL;
}

const struct law *const *law_rows(void)
{
    return rows;
}
