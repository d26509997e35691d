/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words of smoothed particles, as echo.h asks for. */
#include "deck/echo_sph.h"
#include "deck/echo.h"
#include "deck/keyword.h"

#include <math.h>
#include <string.h>

static void print_line(FILE *stream, const char *word, const double *values, int count)
{
    fputs(word, stream);
    echo_numbers(stream, values, count);
    fputc('\n', stream);
}

static void echo_tables(const struct properties *properties, int material, FILE *stream)
{
    for (int i = 0; i < PROPERTY_COUNT; i++) {
        const struct property_table *table = &properties->tables[i];
        if (table->count == 0)
            continue;
        fprintf(stream, "prop %d %s %zu", material, property_row((enum property)i)->name, table->count);
        for (size_t k = 0; k < table->count; k++)
            echo_numbers(stream, (double[]){table->temperatures[k], table->values[k]}, 2);
        fputs(table->goes_on ? " extr\n" : "\n", stream);
    }
}

void echo_properties(const struct scene *scene, FILE *stream)
{
    for (size_t i = 0; i < scene->n_materials; i++) {
        const struct properties *p = &scene->materials[i].properties;
        const struct surface_formula *s = &p->surface;
        echo_tables(p, (int)i + 1, stream);
        if (s->is_given) {
            fprintf(stream, "prop %zu sahu", i + 1);
            print_line(stream, "",
                       (double[]){s->tension, s->slope, s->melting_point, s->excess, s->entropy_factor, s->activity, s->segregation}, 7);
        }
        if (p->melts) {
            fprintf(stream, "prop %zu melt", i + 1);
            print_line(stream, "", (double[]){p->solidus, p->liquidus, p->latent_heat}, 3);
        }
        if (p->boils) {
            fprintf(stream, "prop %zu boil", i + 1);
            print_line(stream, "", (double[]){p->boiling_point, p->vaporisation_heat, p->molar_mass}, 3);
        }
    }
}

static void echo_walls(const struct scene_sph *sph, FILE *stream)
{
    for (size_t i = 0; i < sph->n_walls; i++) {
        const struct scene_wall *wall = &sph->walls[i];
        fprintf(stream, "  wall %ld velo", wall->body + 1);
        echo_numbers(stream, wall->velocity, 3);
        fputs(wall->heat == WALL_TEMPERATURE ? " temp" : " adia", stream);
        echo_numbers(stream, &wall->temperature, wall->heat == WALL_TEMPERATURE);
        fputs(wall->no_stick ? " nost\n" : "\n", stream);
    }
}

static void echo_bodies(const struct scene_sph *sph, FILE *stream)
{
    for (size_t i = 0; i < sph->n_temperatures; i++) {
        fprintf(stream, "  temp %ld", sph->temperatures[i].body + 1);
        print_line(stream, "", &sph->temperatures[i].value, 1);
    }
    for (size_t i = 0; i < sph->n_swellings; i++) {
        const struct scene_swelling *swelling = &sph->swellings[i];
        static const char *const forms[] = {[SWELLING_CYCLE] = "cycl", [SWELLING_GROWING] = "grow", [SWELLING_STEADY] = "rate"};
        fprintf(stream, "  swel %ld %s", swelling->body + 1, forms[swelling->form]);
        echo_numbers(stream, (double[]){swelling->amplitude, swelling->frequency}, swelling->form == SWELLING_STEADY ? 1 : 2);
        print_line(stream, isfinite(swelling->end) ? " until" : "", &swelling->end, isfinite(swelling->end));
    }
    for (size_t i = 0; i < sph->n_stretches; i++) {
        fprintf(stream, "  stre %ld", sph->stretches[i].body + 1);
        print_line(stream, "", sph->stretches[i].factor, 3);
    }
}

static void echo_beam(const struct scene_beam *beam, FILE *stream)
{
    if (!beam->is_on)
        return;
    fprintf(stream, "  beam");
    echo_numbers(stream, (double[]){beam->power, beam->radius, beam->absorptivity}, 3);
    if (beam->depth > 0) {
        fprintf(stream, " alpha");
        echo_numbers(stream, &beam->depth, 1);
    }
    fputs(beam->reading == BEAM_SLICE ? " slic" : " line", stream);
    echo_numbers(stream, &beam->thickness, beam->reading == BEAM_LINE);
    print_line(stream, " bins", &beam->bin, 1);
    for (size_t i = 0; i < beam->n_pieces; i++) {
        const struct scene_beam_piece *piece = &beam->pieces[i];
        fprintf(stream, "  path");
        echo_numbers(stream, piece->times, 2);
        echo_numbers(stream, piece->from, 3);
        print_line(stream, "", piece->to, 3);
    }
}

/* A word whose argument is stored as it is. */
static void echo_word(const struct scene *scene, const struct keyword *row, FILE *stream)
{
    const char *field = (const char *)scene + row->field;
    fprintf(stream, "  %s", row->name);
    if (row->choice)
        fprintf(stream, " %s", echo_choice(scene, row->choice));
    else if (row->arguments[0].kind == ARGUMENT_INTEGER)
        fprintf(stream, " %ld", *(const long *)(const void *)field);
    else
        echo_numbers(stream, (const double *)(const void *)field, 1);
    if (strcmp(row->name, "delt") == 0)
        fprintf(stream, "%s%s", scene->sph.diffuses_gradient ? " grad" : "", scene->sph.diffuses_reference ? " dens" : "");
    if (strcmp(row->name, "ejec") == 0 && scene->sph.lets_beam_through)
        fprintf(stream, " thru");
    fputc('\n', stream);
}

void echo_sph(const struct scene *scene, FILE *stream)
{
    const struct scene_sph *sph = &scene->sph;
    fprintf(stream, "sph\n");
    for (const struct keyword *row = sph_keywords; row->name; row++) {
        const bool is_left_out = (strcmp(row->name, "redu") == 0 && !sph->reduces_pressure) || (strcmp(row->name, "evap") == 0 && !sph->evaporates);
        if ((row->choice || row->field != KEYWORD_NO_FIELD) && !is_left_out)
            echo_word(scene, row, stream);
    }
    fprintf(stream, "  c0");
    if (sph->sound_speed > 0)
        echo_numbers(stream, &sph->sound_speed, 1);
    else
        fprintf(stream, " auto");
    fprintf(stream, "%s\n", sph->adapts_sound ? " adapt" : "");
    if (sph->radiates)
        print_line(stream, "  radi", (double[]){sph->emissivity, sph->ambient}, 2);
    fprintf(stream, "  jitt");
    echo_numbers(stream, &sph->jitter, 1);
    fprintf(stream, " %ld%s\n", sph->seed, sph->jitters_solids ? " solids" : "");
    echo_walls(sph, stream);
    echo_bodies(sph, stream);
    echo_beam(&sph->beam, stream);
    fprintf(stream, "ends\n");
}
