/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of laws. */
#include "material/law.h"

#include <string.h>
#include <strings.h>

static const struct law *const rows[] = {&law_elas, &law_pla1, &law_pla2, &law_john, &law_sjc, &law_sjcf,
                                         &law_jcf,  &law_hiex, &law_null, &law_dpm,  &law_neoh, &law_maxw,
                                         &law_fmax, &law_oldr, &law_powl, &law_flui, NULL};

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
