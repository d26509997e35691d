/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "deck/echo_rkpm.h"
#include "deck/echo.h"
#include "deck/keyword.h"

#include <string.h>

static void print_numbers(FILE *stream, const char *words, const double *values, int count)
{
    fprintf(stream, "  %s", words);
    echo_numbers(stream, values, count);
}

/* Words that only some problems have are left out of the others. */
static bool has_word(const struct scene_rkpm *rkpm, const char *name)
{
    static const char *const dynamic[] = {"mode", "spin", "stab", NULL};
    const bool is_dynamic = rkpm->problem == PROBLEM_DYNAMIC, is_solved = rkpm->problem != PROBLEM_APPROXIMATION && !is_dynamic;
    const bool is_creep = rkpm->problem == PROBLEM_CREEP, is_body = scene_rkpm_has_body(rkpm);
    const bool has_beta = rkpm->constraint == CONSTRAINT_PENALTY || rkpm->constraint == CONSTRAINT_NITSCHE;
    for (int i = 0; dynamic[i]; i++)
        if (strcmp(name, dynamic[i]) == 0)
            return is_dynamic && (strcmp(name, "stab") != 0 || rkpm->dynamic.stabilisation >= 0);
    if (is_dynamic && strcmp(name, "inte") == 0)
        return true;
    if (is_dynamic && (strcmp(name, "func") == 0 || strcmp(name, "wave") == 0))
        return false;
    if (strcmp(name, "grad") == 0)
        return !is_dynamic || rkpm->integration == INTEGRATION_DNI;
    if (strcmp(name, "cons") == 0)
        return is_solved;
    if (strcmp(name, "beta") == 0)
        return is_solved && has_beta;
    if (strcmp(name, "wave") == 0)
        return rkpm->problem == PROBLEM_HELMHOLTZ || rkpm->function == FUNCTION_WAVE;
    if (strcmp(name, "plan") == 0)
        return is_body && rkpm->dimension == 2;
    if (strcmp(name, "modu") == 0 || strcmp(name, "inte") == 0)
        return is_body;
    if (strcmp(name, "vci") == 0)
        return is_body && !is_creep;
    if (strcmp(name, "rule") == 0 || strcmp(name, "vrel") == 0 || strcmp(name, "span") == 0)
        return is_creep;
    if (strcmp(name, "forc") == 0)
        return rkpm->function == FUNCTION_BEAM || rkpm->function == FUNCTION_LOAD;
    if (strcmp(name, "pert") == 0)
        return rkpm->jitter[0] > 0;
    if (strcmp(name, "gaus") == 0)
        return rkpm->gauss > 0;
    if (strcmp(name, "gbou") == 0)
        return rkpm->boundary_gauss > 0;
    return strcmp(name, "gnor") != 0 || rkpm->norm_gauss > 0;
}

static void echo_word(const struct scene *scene, const struct keyword *row, FILE *stream)
{
    const char *field = (const char *)scene + row->field;
    if (row->choice)
        fprintf(stream, "  %s %s", row->name, echo_choice(scene, row->choice));
    else if (row->arguments[0].kind == ARGUMENT_INTEGER)
        fprintf(stream, "  %s %ld", row->name, *(const long *)(const void *)field);
    else
        print_numbers(stream, row->name, (const double *)(const void *)field, argument_count(row->arguments));
    const bool is_over_spacing = (strcmp(row->name, "beta") == 0 && scene->rkpm.beta_over_spacing) ||
                                 (strcmp(row->name, "wave") == 0 && scene->rkpm.wave_over_spacing);
    fputs(is_over_spacing ? " /h\n" : "\n", stream);
}

static void echo_brick(const struct ball_lattice *lattice, FILE *stream)
{
    fprintf(stream, "  node brick");
    for (int a = 0; a < lattice->dimension; a++) {
        const double low = lattice_low(lattice, a);
        echo_numbers(stream, (const double[]){low, low + (double)lattice->numbers[a] * lattice->spacing}, 2);
    }
}

static void echo_dynamic(const struct scene_dynamic *dynamic, FILE *stream)
{
    const struct ball_lattice *lattice = &dynamic->lattice;
    if (lattice->numbers[0] > 0)
        echo_brick(lattice, stream);
    else {
        print_numbers(stream, lattice->dimension == 2 ? "node disc" : "node sphere", lattice->centre, lattice->dimension);
        echo_numbers(stream, &lattice->radius, 1);
    }
    echo_numbers(stream, &lattice->spacing, 1);
    fputc('\n', stream);
    print_numbers(stream, "star", dynamic->velocity, 3);
    fputc('\n', stream);
    print_numbers(stream, "grav", dynamic->gravity, 3);
    fputc('\n', stream);
    if (dynamic->wall == RKPM_WALL_NONE)
        return;
    fprintf(stream, "  wall %s %c", dynamic->wall == RKPM_WALL_SPRING ? "spring" : "natural", "xyz"[dynamic->wall_axis]);
    echo_numbers(stream, &dynamic->wall_position, 1);
    if (dynamic->wall == RKPM_WALL_SPRING)
        echo_numbers(stream, &dynamic->wall_modulus, 1);
    fputs(dynamic->wall == RKPM_WALL_NATURAL ? (dynamic->wall_releases ? "\n" : " keep\n") : dynamic->wall_sticks ? " stick\n" : " free\n", stream);
}

static void echo_held(const struct scene_rkpm *rkpm, FILE *stream)
{
    static const char *const sides[] = {"x0", "x1", "y0", "y1", "z0", "z1"};
    if (!scene_rkpm_has_body(rkpm))
        return;
    fprintf(stream, "  held");
    for (int side = 0; side < 6; side++)
        if (rkpm->held[side])
            fprintf(stream, " %s", sides[side]);
    fputc('\n', stream);
}

static void echo_pairs(const char *word, const double (*pairs)[2], int count, FILE *stream)
{
    for (int i = 0; i < count; i++) {
        print_numbers(stream, word, pairs[i], 2);
        fputc('\n', stream);
    }
}

void echo_rkpm(const struct scene *scene, FILE *stream)
{
    const struct scene_rkpm *rkpm = &scene->rkpm;
    fprintf(stream, "rkpm\n");
    for (const struct keyword *row = rkpm_keywords; row->name; row++)
        if ((row->choice || row->field != KEYWORD_NO_FIELD) && has_word(rkpm, row->name))
            echo_word(scene, row, stream);
    if (rkpm->file)
        fprintf(stream, "  file \"%s\"\n", rkpm->file);
    echo_held(rkpm, stream);
    if (rkpm->weight[0] != 0 || rkpm->weight[1] != 0 || rkpm->weight[2] != 0) {
        print_numbers(stream, "weig", rkpm->weight, 3);
        fputc('\n', stream);
    }
    echo_pairs("elem", rkpm->elements, rkpm->n_elements, stream);
    echo_pairs("from", rkpm->loads, rkpm->n_loads, stream);
    print_numbers(stream, "supp", rkpm->support, rkpm->n_support);
    fputc('\n', stream);
    if (rkpm->problem == PROBLEM_DYNAMIC) {
        echo_dynamic(&rkpm->dynamic, stream);
        fprintf(stream, "ends\n");
        return;
    }
    print_numbers(stream, "node box", rkpm->box_read, rkpm->n_box);
    fputs(rkpm->n_refinements > 0 ? "\n  refi" : "\n", stream);
    for (size_t i = 0; i < rkpm->n_refinements; i++)
        fprintf(stream, " %ld", rkpm->refinements[i]);
    fputs(rkpm->n_refinements > 0 ? "\nends\n" : "ends\n", stream);
}
