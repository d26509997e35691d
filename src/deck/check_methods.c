/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words that only some methods have: noted where they are read, and looked at when the whole deck is known, as `meth` may
 * come last. */
#include "base/memory.h"
#include "deck/reader.h"

void reader_use(struct reader *reader, const char *kind, const char *name, unsigned methods, struct deck_place place)
{
    if (methods == 0)
        return;
    for (size_t i = 0; i < reader->n_uses; i++)
        if (reader->uses[i].name == name && reader->uses[i].methods == methods)
            return;
    reader->uses = memory_grow(reader->uses, &reader->uses_capacity, reader->n_uses + 1, sizeof *reader->uses, "words");
    reader->uses[reader->n_uses++] = (struct reader_use){kind, name, methods, place};
}

bool reader_check_methods(struct reader *reader)
{
    const enum method_name method = reader->scene->method, other = method == METHOD_MPM ? METHOD_SPH : METHOD_MPM;
    static const char *const names[] = {[METHOD_MPM] = "mpm", [METHOD_SPH] = "sph"};
    for (size_t i = 0; i < reader->n_uses; i++) {
        const struct reader_use *use = &reader->uses[i];
        if (methods_include(use->methods, method))
            continue;
        if (reader->method_place.line == 0) {
            diagnostics_error(reader->diagnostics, use->place, "%s'%s' needs 'meth %s'", use->kind, use->name, names[other]);
            return false;
        }
        diagnostics_error(reader->diagnostics, use->place, "%s'%s' goes only with 'meth %s'; this deck has 'meth %s'", use->kind,
                          use->name, names[other], names[method]);
    }
    return true;
}
