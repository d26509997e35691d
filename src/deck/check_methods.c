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
    const enum method_name method = scene_method(reader->scene);
    for (size_t i = 0; i < reader->n_uses; i++) {
        const struct reader_use *use = &reader->uses[i];
        char expected[80];
        if (methods_include(use->methods, method))
            continue;
        methods_text(use->methods, "'meth ", "'", " or ", expected, sizeof expected);
        if (reader->method_place.line == 0) {
            diagnostics_error(reader->diagnostics, use->place, "%s'%s' needs %s", use->kind, use->name, expected);
            return false;
        }
        diagnostics_error(reader->diagnostics, use->place, "%s'%s' goes only with %s; this deck has 'meth %s'", use->kind, use->name,
                          expected, methods_name(method));
    }
    return true;
}
