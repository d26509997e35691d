/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "deck/help.h"
#include "deck/keyword.h"
#include "material/eos.h"
#include "material/law.h"
#include "material/properties.h"
#include "particles/generate.h"
#include "particles/results.h"
#include "particles/solid.h"

#include <string.h>

static void print_arguments(FILE *stream, const struct argument *arguments)
{
    for (int i = 0; i < argument_count(arguments); i++)
        fprintf(stream, " %s", arguments[i].name);
}

static void print_argument_table(FILE *stream, const struct argument *arguments)
{
    static const char *const kinds[] = {
        [ARGUMENT_REAL] = "number", [ARGUMENT_INTEGER] = "whole number", [ARGUMENT_WORD] = "word"};
    for (int i = 0; i < argument_count(arguments); i++) {
        const char *limit = argument_limit_text(arguments[i].limit);
        fprintf(stream, "    %-12s %s", arguments[i].name, kinds[arguments[i].kind]);
        if (arguments[i].unit)
            fprintf(stream, ", %s", arguments[i].unit);
        fprintf(stream, "%s%s\n", *limit ? ", " : "", limit);
    }
}

/* The words of a law in the order of the deck: parameters, elements, words that may follow. */
static void print_law_order(FILE *stream, const struct law *law)
{
    print_arguments(stream, law->parameters);
    if (law->element) {
        fprintf(stream, " n");
        for (int i = 1; i <= 2; i++)
            for (int k = 0; k < argument_count(law->element); k++)
                fprintf(stream, "%s %s_%s", i == 2 && k == 0 ? " ..." : "", law->element[k].name, i == 1 ? "1" : "n");
    }
    for (int i = 0; law->words && law->words[i]; i++)
        fprintf(stream, " [%s]", law->words[i]);
    fprintf(stream, "\n");
}

/* What the doc of a row ends with that not all methods have. */
struct note {
    char text[40];
};

static struct note note_of(unsigned methods)
{
    struct note note = {""};
    char names[30];
    methods_text(methods, "", "", ", ", names, sizeof names);
    if (methods != 0)
        snprintf(note.text, sizeof note.text, " [%s]", names);
    return note;
}

static void print_line(FILE *stream, const char *name, const char *doc, const char *later, unsigned methods)
{
    fprintf(stream, "  %-5s %s%s%s\n", name, doc, note_of(methods).text, later ? " (not in this version)" : "");
}

void help_words(FILE *stream)
{
    for (int c = 0; c < CATEGORY_COUNT; c++) {
        fprintf(stream, "\n%s\n", keyword_category_title((enum category)c));
        for (const struct keyword *row = keyword_table((enum category)c); row->name; row++)
            print_line(stream, row->name, row->doc, row->later, row->methods);
    }
    fprintf(stream, "\n[mpm], [sph] and [rkpm] are words of those `meth` alone. mpm3d --help WORD tells more of a word, law, generator or result.\n");
}

static void print_laws(FILE *stream)
{
    for (const struct law *const *law = law_rows(); *law; law++)
        print_line(stream, (*law)->name, (*law)->doc, (*law)->later, (*law)->methods);
}

static void print_equations(FILE *stream)
{
    for (const struct eos *eos = eos_rows(); eos->type; eos++) {
        fprintf(stream, "  %d     %s: %s\n        seos material %d", eos->type, eos->name, eos->doc, eos->type);
        print_arguments(stream, eos->arguments);
        fprintf(stream, "\n");
    }
}

static void print_generators(FILE *stream)
{
    int count;
    const struct generator_row *rows = generator_rows(&count);
    for (int i = 0; i < count; i++)
        print_line(stream, rows[i].name, rows[i].doc, NULL, 0);
}

/* Those in which a particle or a curve has it. */
static unsigned methods_of_result(const struct result *result)
{
    const unsigned curve = result_curve_methods(result);
    return !result->value ? curve : curve == 0 ? 0 : result->methods | curve;
}

static void print_results(FILE *stream)
{
    int count;
    const struct result *rows = result_rows(&count);
    for (int i = 0; i < count; i++)
        print_line(stream, rows[i].name, rows[i].doc, rows[i].later, methods_of_result(&rows[i]));
}

static void print_table(FILE *stream, const struct keyword *table)
{
    for (const struct keyword *row = table; row->name; row++) {
        print_line(stream, row->name, row->doc, row->later, row->methods);
        fprintf(stream, "        %s", row->name);
        print_arguments(stream, row->arguments);
        fprintf(stream, "\n");
    }
}

/* The rules of part solid, for --help and the manual. */
static const char solid_rules[] =
    "The steps are done in their order; the first must be add. Points stand at the origin plus i + 1/2, j + 1/2, k + 1/2\n"
    "spacings, for all whole i, j, k inside the shapes, and are numbered with x fastest, then y, then z. A point that is\n"
    "inside by no more than 1e-9 spacings is on the surface, which is outside: of an add it does not come, of a cut it\n"
    "stays, of a keep it goes. For stl the 1e-9 grows by the single precision of the file, 1.2e-7 of its largest\n"
    "coordinate. Its surface must be watertight; which way its normals show does not matter. Where two of its shells\n"
    "overlap is outside, as in a hollow part; a warning tells.\n";

static void print_shapes(FILE *stream)
{
    int count;
    const struct solid_shape *rows = solid_shapes(&count);
    fprintf(stream, "\nSteps, up to endp, each with a shape:\n");
    print_table(stream, solid_keywords);
    fprintf(stream, "Shapes:\n");
    for (int i = 0; i < count; i++) {
        print_line(stream, rows[i].name, rows[i].doc, NULL, 0);
        fprintf(stream, "        %s", rows[i].name);
        print_arguments(stream, rows[i].arguments);
        fprintf(stream, "\n");
    }
    fprintf(stream, "Behind the file of stl:\n");
    print_table(stream, surface_keywords);
    fprintf(stream, "\n%s", solid_rules);
}

static void print_properties(FILE *stream)
{
    for (int i = 0; i < PROPERTY_COUNT; i++) {
        const struct property_row *row = property_row((enum property)i);
        print_line(stream, row->name, row->doc, NULL, 0);
        fprintf(stream, "        %s n T1 v1 ... Tn vn%s%s\n", row->name, row->unit ? "   " : "", row->unit ? row->unit : "");
    }
    print_table(stream, property_keywords);
}

/* What belongs below a word: the rows that may stand in its block. */
static void print_below(FILE *stream, const char *name)
{
    if (strcmp(name, "mate") == 0)
        print_laws(stream);
    else if (strcmp(name, "seos") == 0)
        print_equations(stream);
    else if (strcmp(name, "part") == 0)
        print_generators(stream);
    else if (strcmp(name, "load") == 0)
        print_table(stream, load_keywords);
    else if (strcmp(name, "velo") == 0)
        print_table(stream, velocity_keywords);
    else if (strcmp(name, "Ghos") == 0)
        print_table(stream, ghost_keywords);
    else if (strcmp(name, "sph") == 0)
        print_table(stream, sph_keywords);
    else if (strcmp(name, "rkpm") == 0)
        print_table(stream, rkpm_keywords);
    else if (strcmp(name, "prop") == 0)
        print_properties(stream);
    else if (strcmp(name, "outr") == 0 || strcmp(name, "curv") == 0)
        print_results(stream);
}

static bool help_keyword(const char *word, FILE *stream)
{
    enum category category;
    char names[60];
    const struct keyword *row = keyword_find(word, &category);
    if (!row)
        return false;
    methods_text(row->methods, " meth ", "", " or", names, sizeof names);
    fprintf(stream, "%s", row->name);
    print_arguments(stream, row->arguments);
    fprintf(stream, "\n    %s%s\n    category: %s\n", row->doc, row->later ? " (not in this version)" : "",
            keyword_category_title(category));
    if (row->methods)
        fprintf(stream, "    only with%s\n", names);
    print_argument_table(stream, row->arguments);
    if (row->details)
        fprintf(stream, "%s\n", row->details);
    print_below(stream, row->name);
    return true;
}

static bool help_other(const char *word, FILE *stream)
{
    const struct law *law = law_find(word);
    const struct generator_row *generator = generator_find(word);
    const struct result *result = result_find(word);
    if (law) {
        fprintf(stream, "law %s", law->name);
        print_law_order(stream, law);
        fprintf(stream, "    %s%s%s\n", law->doc, note_of(law->methods).text, law->later ? " (not in this version)" : "");
        print_argument_table(stream, law->parameters);
        print_argument_table(stream, law->element);
    }
    if (generator) {
        fprintf(stream, "part %s component\n   ", generator->name);
        print_arguments(stream, generator->arguments);
        fprintf(stream, "\n    %s\n", generator->doc);
        print_argument_table(stream, generator->arguments);
        if (strcmp(generator->name, "soli") == 0)
            print_shapes(stream);
    }
    if (result)
        fprintf(stream, "result %s\n    %s%s%s%s%s\n", result->name, result->doc, result->unit ? ", " : "",
                result->unit ? result->unit : "", note_of(methods_of_result(result)).text, result->later ? " (not in this version)" : "");
    return law || generator || result;
}

bool help_word(const char *word, FILE *stream)
{
    bool is_keyword = help_keyword(word, stream);
    bool is_other = help_other(word, stream);
    if (is_keyword || is_other)
        return true;
    const char *nearest = keyword_nearest_top(word);
    fprintf(stream, nearest ? "no word '%s'; did you mean '%s'?\n" : "no word '%s'; see mpm3d --help\n", word, nearest);
    return false;
}

/* --- the manual --- */

static void manual_arguments(FILE *stream, const struct argument *arguments)
{
    for (int i = 0; i < argument_count(arguments); i++) {
        const char *limit = argument_limit_text(arguments[i].limit);
        fprintf(stream, "%s`%s`", i ? "; " : "", arguments[i].name);
        if (arguments[i].unit)
            fprintf(stream, " (%s)", arguments[i].unit);
        if (*limit)
            fprintf(stream, " %s", limit);
    }
}

static void manual_head(FILE *stream, const char *title)
{
    fprintf(stream, "\n### %s\n\n| word | what | arguments |\n|---|---|---|\n", title);
}

/* A row up to its arguments. */
static void manual_row_begin(FILE *stream, const char *name, const char *doc, const char *later, unsigned methods)
{
    fprintf(stream, "| `%s` | ", name);
    for (const char *c = doc; *c; c++) /* a bar in a text would end its column */
        fprintf(stream, *c == '|' ? "\\|" : "%c", *c);
    fprintf(stream, "%s%s | ", note_of(methods).text, later ? " (not in this version)" : "");
}

static void manual_row(FILE *stream, const char *name, const char *doc, const struct argument *arguments, const char *later,
                       unsigned methods)
{
    manual_row_begin(stream, name, doc, later, methods);
    manual_arguments(stream, arguments);
    fprintf(stream, " |\n");
}

static void manual_law(FILE *stream, const struct law *law)
{
    manual_row_begin(stream, law->name, law->doc, law->later, law->methods);
    manual_arguments(stream, law->parameters);
    if (law->element) {
        fprintf(stream, "; `n`, and n times ");
        manual_arguments(stream, law->element);
    }
    for (int i = 0; law->words && law->words[i]; i++)
        fprintf(stream, "%s`%s`", i == 0 ? "; words: " : ", ", law->words[i]);
    fprintf(stream, " |\n");
}

static void manual_keywords(FILE *stream, const char *title, const struct keyword *table)
{
    manual_head(stream, title);
    for (const struct keyword *row = table; row->name; row++)
        manual_row(stream, row->name, row->doc, row->arguments, row->later, row->methods);
}

static void manual_properties(FILE *stream)
{
    fprintf(stream, "\n### Names of prop\n\n| word | what | numbers |\n|---|---|---|\n");
    for (int i = 0; i < PROPERTY_COUNT; i++) {
        const struct property_row *row = property_row((enum property)i);
        fprintf(stream, "| `%s` | %s%s%s | `n` rows of temperature and value; `extr` behind them: beyond the last row along the last line |\n",
                row->name, row->doc, row->unit ? ", " : "", row->unit ? row->unit : "");
    }
    for (const struct keyword *row = property_keywords; row->name; row++)
        manual_row(stream, row->name, row->doc, row->arguments, row->later, row->methods);
}

void help_manual(FILE *stream)
{
    int count;
    fprintf(stream, "# The words of a deck\n\nWritten by `make manual` from the program's own tables; `mpm3d --help WORD` "
                    "shows the same.\nFour letters count, in any case; numbers may be written 1, .5, +1, 1.0d-3; words are "
                    "separated by blanks or one comma; `!` starts a comment.\n"
                    "[mpm], [sph] and [rkpm] are words of those `meth` alone.\n");
    for (int c = 0; c < CATEGORY_COUNT; c++)
        manual_keywords(stream, keyword_category_title((enum category)c), keyword_table((enum category)c));
    manual_keywords(stream, "Kinds of load", load_keywords);
    manual_keywords(stream, "Kinds of velo", velocity_keywords);
    manual_keywords(stream, "Words of Ghost", ghost_keywords);
    manual_keywords(stream, "Words of sph, up to ends", sph_keywords);
    manual_keywords(stream, "Words of rkpm, up to ends", rkpm_keywords);
    manual_properties(stream);
    manual_head(stream, "Laws of mate");
    for (const struct law *const *law = law_rows(); *law; law++)
        manual_law(stream, *law);
    manual_head(stream, "Types of seos");
    for (const struct eos *eos = eos_rows(); eos->type; eos++) {
        fprintf(stream, "| `%d` | %s: %s | ", eos->type, eos->name, eos->doc);
        manual_arguments(stream, eos->arguments);
        fprintf(stream, " |\n");
    }
    manual_head(stream, "Generators of part");
    const struct generator_row *generators = generator_rows(&count);
    for (int i = 0; i < count; i++)
        manual_row(stream, generators[i].name, generators[i].doc, generators[i].arguments, NULL, 0);
    manual_keywords(stream, "Steps of part solid, up to endp", solid_keywords);
    manual_head(stream, "Shapes of part solid");
    const struct solid_shape *shapes = solid_shapes(&count);
    for (int i = 0; i < count; i++)
        manual_row(stream, shapes[i].name, shapes[i].doc, shapes[i].arguments, NULL, 0);
    manual_keywords(stream, "Words behind the file of stl", surface_keywords);
    fprintf(stream, "\n%s", solid_rules);
    fprintf(stream, "\n### Results of outr, curv, curx\n\n| word | what | unit |\n|---|---|---|\n");
    const struct result *results = result_rows(&count);
    for (int i = 0; i < count; i++)
        fprintf(stream, "| `%s` | %s%s%s | %s |\n", results[i].name, results[i].doc, note_of(methods_of_result(&results[i])).text,
                results[i].later ? " (not in this version)" : "", results[i].unit ? results[i].unit : "");
}
