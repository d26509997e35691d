/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "deck/echo.h"
#include "deck/echo_rkpm.h"
#include "deck/echo_sph.h"
#include "deck/keyword.h"
#include "material/eos.h"
#include "particles/solid.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { SHOWN_LINES = 20 };

static const char *const face_names[] = {"x-", "x+", "y-", "y+", "z-", "z+"};

/* A number with as many digits as it takes to read the same one again. */
static void print_number(FILE *stream, double value)
{
    char text[40];
    int digits = 6;
    do
        snprintf(text, sizeof text, "%.*g", digits, value);
    while (digits++ < 17 && strtod(text, NULL) != value);
    fprintf(stream, " %s", text);
}

void echo_numbers(FILE *stream, const double *values, int count)
{
    for (int i = 0; i < count; i++)
        print_number(stream, values[i]);
}

static void print_line(FILE *stream, const char *word, const double *values, int count)
{
    fputs(word, stream);
    echo_numbers(stream, values, count);
    fputc('\n', stream);
}

/* Words whose arguments are stored as they are. */
static void echo_plain(const struct scene *scene, FILE *stream, enum category category)
{
    const struct keyword *table = keyword_table(category);
    for (const struct keyword *row = table; row->name; row++) {
        bool is_given = scene->given[category] >> (row - table) & 1;
        if (!methods_include(row->methods, scene_method(scene)))
            continue;
        if (row->choice)
            fprintf(stream, "%s %s%s\n", row->name, echo_choice(scene, row->choice), is_given ? "" : "   ! default");
        if (row->field == KEYWORD_NO_FIELD || strncmp(row->name, "sp", 2) == 0 || strcmp(row->name, "dcel") == 0)
            continue;
        const char *field = (const char *)scene + row->field;
        fprintf(stream, "%s", row->name);
        for (int i = 0; i < argument_count(row->arguments); i++) {
            if (row->arguments[i].kind == ARGUMENT_INTEGER)
                fprintf(stream, " %ld", ((const long *)(const void *)field)[i]);
            else
                print_number(stream, ((const double *)(const void *)field)[i]);
        }
        bool is_grid = strcmp(row->name, "grid") == 0;
        fprintf(stream, "%s\n", is_given || is_grid ? "" : "   ! default");
    }
}

const char *echo_choice(const struct scene *scene, const struct keyword_choice *choice)
{
    const char *field = (const char *)scene + choice->field;
    int index = 0;
    bool is_on = false;
    if (choice->is_flag)
        memcpy(&is_on, field, sizeof is_on);
    else
        memcpy(&index, field, sizeof index); /* enums have the size of int */
    return choice->names[choice->is_flag ? is_on : index];
}

static bool was_given(const struct scene *scene, enum category category, const char *name)
{
    const struct keyword *table = keyword_table(category);
    return scene->given[category] >> (keyword_in(table, name) - table) & 1;
}

/* How the grid is gone through. */
static void echo_scheme(const struct scene *scene, FILE *stream)
{
    static const char *const schemes[] = {[SCHEME_USF] = "usf", [SCHEME_USL] = "usl", [SCHEME_MUSL] = "musl"};
    static const char *const rotations[] = {[ROTATION_OFF] = "off", [ROTATION_EXPLICIT] = "on", [ROTATION_EXACT] = "exact"};
    bool is_given = was_given(scene, CATEGORY_SOLVING, schemes[scene->scheme]);
    fprintf(stream, "%s on%s\n", schemes[scene->scheme], is_given ? "" : "   ! default");
    fprintf(stream, "jaum %s%s\n", rotations[scene->rotation],
            was_given(scene, CATEGORY_SOLVING, "jaum") ? "" : "   ! default");
    static const char *const interpolations[] = {[INTERPOLATION_LINEAR] = "", [INTERPOLATION_GIMP] = "gimp\n",
                                                 [INTERPOLATION_GIMP_OWN] = "gimp cp\n", [INTERPOLATION_BIMP] = "bimp\n",
                                                 [INTERPOLATION_STAGGERED] = "sgmp\n"};
    fputs(interpolations[scene->interpolation], stream);
    if (scene->contact != CONTACT_NONE)
        fprintf(stream, "cont %s", scene->contact == CONTACT_LAGRANGE ? "lagr" : "othe");
    if (scene->contact != CONTACT_NONE) {
        print_number(stream, scene->contact_friction);
        fprintf(stream, " %ld%s\n", scene->contact_normal, scene->contact_joins ? " join" : "");
    }
}

static void echo_solving(const struct scene *scene, FILE *stream)
{
    echo_plain(scene, stream, CATEGORY_SOLVING);
    if (scene->method == METHOD_RKPM)
        return;
    if (scene->method == METHOD_MPM)
        echo_scheme(scene, stream);
    fprintf(stream, "sort %s%s\n", scene->sorts ? "on" : "off",
            was_given(scene, CATEGORY_SOLVING, "sort") ? "" : "   ! default");
    if (scene->is_total)
        fprintf(stream, "TLmp\n");
    if (scene->tracks_deformation)
        fprintf(stream, "UVFp\n");
    if (scene->is_small)
        fprintf(stream, "smal\n");
    if (scene->nodal_damping[0] > 0 || scene->nodal_damping[1] > 0)
        print_line(stream, "ndam", scene->nodal_damping, 2);
    if (scene->kinetic_damping)
        fprintf(stream, "drda\n");
    if (scene->finds_equilibrium) {
        fprintf(stream, "quas");
        print_number(stream, scene->equilibrium_tolerance);
        fprintf(stream, " %ld\n", scene->equilibrium_steps);
    }
    if (scene->averages_volume)
        fprintf(stream, "bbar\n");
    if (scene->transfer == TRANSFER_AFFINE)
        fprintf(stream, "xfer apic\n");
    else if (scene->transfer == TRANSFER_BLEND)
        print_line(stream, "xfer blend", &scene->flip_share, 1);
    if (scene->lost != LOST_KEEP || scene->writes_lost)
        fprintf(stream, "lost %s%s\n", scene->lost == LOST_KEEP ? "keep" : scene->lost == LOST_DROP ? "drop" : "stop",
                scene->writes_lost ? " write" : "");
    if (scene->loading_time > 0)
        print_line(stream, "QuLo", &scene->loading_time, 1);
    if (scene->loading_time > 0 && scene->settling[1] > 0)
        print_line(stream, "quli", scene->settling, 2);
}

/* The elements of a law that has some, and the words behind them. */
static void echo_elements(const struct material *material, FILE *stream)
{
    if (!material->law->element)
        return;
    fprintf(stream, " %d", material->n_elements);
    for (int i = 0; i < material->n_elements; i++)
        echo_numbers(stream, (const double[]){material->elements[i].strength, material->elements[i].time}, 2);
    for (int i = 0; material->law->words[i]; i++)
        if (material->words >> i & 1)
            fprintf(stream, " %s", material->law->words[i]);
}

/* The mass cutoff comes from the cell size that is known when mate is read (spec 3.1). */
static void echo_materials(const struct scene *scene, FILE *stream)
{
    if (scene->cutoff_cell_size > 0)
        print_line(stream, "dcel", &scene->cutoff_cell_size, 1);
    fprintf(stream, "mate\n");
    for (size_t i = 0; i < scene->n_materials; i++) {
        const struct material *material = &scene->materials[i].material;
        fprintf(stream, "  %zu %s", i + 1, material->law->name);
        echo_numbers(stream, material->parameter, argument_count(material->law->parameters));
        echo_elements(material, stream);
        fprintf(stream, "\n");
    }
    for (size_t i = 0; i < scene->n_materials; i++) {
        const struct material *material = &scene->materials[i].material;
        if (!material->eos)
            continue;
        fprintf(stream, "seos %zu %d", i + 1, material->eos->type);
        echo_numbers(stream, material->eos_number, argument_count(material->eos->arguments));
        fprintf(stream, "\n");
    }
    for (size_t i = 0; i < scene->n_detonations; i++) {
        fprintf(stream, "deto");
        echo_numbers(stream, scene->detonations[i].position, 3);
        fprintf(stream, "\n");
    }
    if (scene->method == METHOD_SPH)
        echo_properties(scene, stream);
    if (scene->cutoff_cell_size != scene->cell_size) {
        fprintf(stream, "! the mass cutoff has the cell size that comes before mate, or is zero\n");
        print_line(stream, "dcel", &scene->cell_size, 1);
    }
}

static void echo_points(const struct generator *generator, FILE *stream, long first, bool whole)
{
    for (long i = 0; i < generator->n_points; i++) {
        if (!whole && i == SHOWN_LINES) {
            fprintf(stream, "  ! ... %ld points more\n", generator->n_points - i);
            break;
        }
        fprintf(stream, "  %ld %d", first + i + 1, generator->material + 1);
        echo_numbers(stream, &generator->points[i].mass, 1);
        echo_numbers(stream, generator->points[i].position, 3);
        fprintf(stream, "\n");
    }
}

/* A file's name, in quotes as it may have blanks. */
static void print_file(FILE *stream, const char *file)
{
    const char *quote = strchr(file, '"') ? "" : "\"";
    fprintf(stream, " %s%s%s", quote, file, quote);
}

static void echo_steps(const struct solid *solid, FILE *stream)
{
    static const char *const operations[] = {[SOLID_ADD] = "add", [SOLID_CUT] = "cut", [SOLID_KEEP] = "keep"};
    for (size_t s = 0; s < solid->n_steps; s++) {
        const struct solid_step *step = &solid->steps[s];
        const struct argument *arguments = step->shape->arguments;
        fprintf(stream, "  %s %s", operations[step->operation], step->shape->name);
        for (int i = 0; i < argument_count(arguments) && !step->file; i++) {
            if (arguments[i].kind == ARGUMENT_WORD)
                fprintf(stream, " %c", "xyz"[(int)step->number[i]]);
            else
                print_number(stream, step->number[i]);
        }
        if (step->file) {
            print_file(stream, step->file);
            fprintf(stream, " scale");
            print_number(stream, step->scale);
            fprintf(stream, " move");
            echo_numbers(stream, step->move, 3);
        }
        fprintf(stream, "\n");
    }
    fprintf(stream, "endp\n");
}

static void echo_bodies(const struct scene *scene, FILE *stream, bool whole)
{
    for (size_t b = 0; b < scene->n_bodies; b++) {
        const struct scene_body *body = &scene->bodies[b];
        const struct generator *generator = &body->generator;
        bool new_box = body->has_plot_box
                    && (b == 0 || memcmp(body->plot_box, scene->bodies[b - 1].plot_box, sizeof body->plot_box) != 0);
        if (new_box) {
            fprintf(stream, "pt2d");
            echo_numbers(stream, body->plot_box, 6);
            fprintf(stream, "\n");
        }
        fprintf(stream, "part %s %d", generator->row->name, body->component + 1);
        if (!generator->row->arguments) {
            fprintf(stream, " %ld\n", generator->n_points);
            echo_points(generator, stream, body->first, whole);
            continue;
        }
        fprintf(stream, "\n  %d", generator->material + 1);
        echo_numbers(stream, (double[]){generator->density, generator->spacing}, 2);
        for (int i = 3; i < argument_count(generator->row->arguments); i++) {
            bool is_axis = generator->row->arguments[i].kind == ARGUMENT_WORD;
            print_number(stream, generator->number[i - 3] + is_axis);
        }
        fprintf(stream, "   ! particles %ld to %ld\n", body->first + 1, body->first + body->count);
        if (generator->solid)
            echo_steps(generator->solid, stream);
    }
}

static void echo_loads(const struct scene *scene, FILE *stream, bool whole)
{
    static const char *const kinds[] = {[LOAD_PARTICLE] = "part", [LOAD_BODY] = "body", [LOAD_GRAVITY] = "grav",
                                        [LOAD_DENSITY] = "node", [LOAD_FACE] = "face", [LOAD_BOX] = "box"};
    if (scene->n_loads == 0)
        return;
    fprintf(stream, "load\n");
    for (size_t i = 0; i < scene->n_loads; i++) {
        const struct scene_load *load = &scene->loads[i];
        if (!whole && i == SHOWN_LINES) {
            fprintf(stream, "  ! ... %zu lines more\n", scene->n_loads - i);
            break;
        }
        fprintf(stream, "  %s", kinds[load->kind]);
        if (load->kind == LOAD_FACE)
            fprintf(stream, " %s", face_names[2 * load->axis + (load->side > 0)]);
        if (load->kind == LOAD_BOX)
            echo_numbers(stream, load->box, 6);
        else
            fprintf(stream, " %ld", load->target + 1);
        echo_numbers(stream, load->value, 3);
        fprintf(stream, "\n");
    }
    fprintf(stream, "endl\n");
}

static void echo_velocities(const struct scene *scene, FILE *stream, bool whole)
{
    if (scene->n_velocities == 0)
        return;
    fprintf(stream, "velo\n");
    for (size_t i = 0; i < scene->n_velocities; i++) {
        const struct scene_velocity *velocity = &scene->velocities[i];
        if (!whole && i == SHOWN_LINES) {
            fprintf(stream, "  ! ... %zu lines more\n", scene->n_velocities - i);
            break;
        }
        static const char *const kinds[] = {[VELOCITY_PARTICLE] = "node", [VELOCITY_BODY] = "body", [VELOCITY_SINE] = "vsin",
                                            [VELOCITY_ROWS] = "ksin", [VELOCITY_BENDING] = "nuli"};
        bool is_field = velocity->kind != VELOCITY_PARTICLE && velocity->kind != VELOCITY_BODY;
        fprintf(stream, "  %s", kinds[velocity->kind]);
        if (!is_field)
            fprintf(stream, " %ld", velocity->target + 1);
        echo_numbers(stream, velocity->value, is_field ? 1 : 3);
        fprintf(stream, velocity->kind == VELOCITY_ROWS ? " 1\n" : "\n");
    }
    fprintf(stream, "endv\n");
}

static void echo_output(const struct scene *scene, FILE *stream)
{
    echo_plain(scene, stream, CATEGORY_OUTPUT);
    if (scene_method(scene) != METHOD_RKPM)
        fprintf(stream, "name %s\n", scene->bare_names ? "mpm3d" : "job");
    fprintf(stream, "head %s\n", scene->bare_headers ? "mpm3d" : "tecplot");
    if (scene->writes_animation)
        fprintf(stream, "tecp\n");
    if (scene->zones_by_body)
        fprintf(stream, "zone body\n");
    if (scene->writes_vtk)
        fprintf(stream, "para%s\n", scene->vtk_format == VTK_TEXT ? " ascii" : scene->vtk_format == VTK_BINARY ? " binary" : "");
    if (scene->smooths_pressure)
        fprintf(stream, "smoo\n");
    if (scene->restart_steps > 0)
        fprintf(stream, "rest every %ld steps\n", scene->restart_steps);
    else if (scene->restart_interval > 0)
        fputs("rest every", stream), echo_numbers(stream, &scene->restart_interval, 1), fputs(" time\n", stream);
    for (size_t i = 0; i < scene->n_results; i++)
        fprintf(stream, "outr %s\n", scene->results[i]->name);
    for (size_t i = 0; i < scene->n_curves; i++) {
        const struct scene_curve *curve = &scene->curves[i];
        fprintf(stream, "%s %s", curve->is_near ? "curx" : "curv", curve->result->name);
        if (curve->is_near)
            echo_numbers(stream, curve->point, 3);
        else
            fprintf(stream, " %ld", curve->particle + 1);
        fprintf(stream, curve->is_near ? "   ! particle %ld\n" : "\n", curve->particle + 1);
    }
}

/* Whole ranges of one state, as GPD has them. */
static void echo_building(const struct scene *scene, FILE *stream)
{
    const struct scene_building *building = &scene->building;
    for (size_t i = 0; i < building->n_ghosts || (i == 0 && building->has_ghosts); i++) {
        if (i == 0)
            fprintf(stream, "Ghost\n");
        if (i < building->n_ghosts)
            fprintf(stream, "  GPD %ld %ld %d\n", building->ghosts[i].first + 1, building->ghosts[i].last + 1, building->ghosts[i].is_open);
    }
    if (building->has_ghosts)
        fprintf(stream, "endG\n");
    if (building->shows_ghosts)
        fprintf(stream, "ghos show\n");
    if (building->opening == OPENING_ALL)
        fprintf(stream, "open all\n");
    else if (building->opening == OPENING_LAYERS)
        fprintf(stream, "open layer every %ld\n", building->interval);
    else if (building->opening == OPENING_POINTS)
        fprintf(stream, "open group %ld every %ld\n", building->group, building->interval);
    if (building->settling >= 0)
        fprintf(stream, "open settle %ld\n", building->settling);
    if (building->until >= 0)
        fprintf(stream, "open until %ld\n", building->until + 1);
    if (building->axis != 2 || building->thickness > 0) {
        fprintf(stream, "buil %c", "xyz"[building->axis]);
        echo_numbers(stream, &building->thickness, building->thickness > 0);
        fprintf(stream, "\n");
    }
    if (building->order == SCAN_RASTER || building->n_angles > 0) {
        fprintf(stream, "scan %s%s", building->order == SCAN_RASTER ? "raster" : "deck", building->is_serpentine ? " serpentine" : "");
        echo_numbers(stream, building->angles, (int)building->n_angles);
        fprintf(stream, "\n");
    }
}

static void echo_transformations(const struct scene *scene, FILE *stream)
{
    for (size_t i = 0; i < scene->n_materials; i++) {
        const struct scene_transformation *t = &scene->materials[i].transformation;
        const int number = (int)i + 1;
        if (t->has_residual)
            fprintf(stream, "resi %d", number), print_line(stream, "", t->residual, 3);
        if (t->has_phase)
            fprintf(stream, "phas %d", number), print_line(stream, "", t->phase_densities, 2);
        if (t->has_heat) {
            fprintf(stream, "ther %d", number);
            echo_numbers(stream, (double[]){t->expansion, t->temperature, t->radius}, 3);
            fprintf(stream, " %s\n", t->cools ? "cool" : "heat");
        }
    }
}

static void echo_holds(const struct scene *scene, FILE *stream)
{
    for (size_t i = 0; i < scene->n_holds; i++) {
        const struct scene_hold *hold = &scene->holds[i];
        fprintf(stream, "fixn");
        if (hold->is_annulus) {
            fprintf(stream, " cyli %c", "xyz"[hold->axis]);
            echo_numbers(stream, hold->centre, 2);
            echo_numbers(stream, hold->radius, 2);
        } else {
            echo_numbers(stream, hold->box, 6);
        }
        fprintf(stream, " %d %d %d\n", hold->holds[0], hold->holds[1], hold->holds[2]);
    }
}

void echo_scene(const struct scene *scene, FILE *stream, bool whole)
{
    fprintf(stream, "%s%s\n", strncasecmp(scene->title, "mpm3", 4) == 0 ? "" : "mpm3d ", scene->title);
    echo_plain(scene, stream, CATEGORY_GENERAL);
    echo_plain(scene, stream, CATEGORY_GRID);
    echo_holds(scene, stream);
    echo_solving(scene, stream);
    if (scene->method == METHOD_RKPM) {
        if (scene_method(scene) == METHOD_DYNAMIC)
            echo_materials(scene, stream);
        if (scene_method(scene) == METHOD_DYNAMIC)
            echo_building(scene, stream);
        echo_rkpm(scene, stream);
        echo_output(scene, stream);
        fprintf(stream, "endi\n");
        return;
    }
    echo_materials(scene, stream);
    echo_bodies(scene, stream, whole);
    echo_building(scene, stream);
    echo_transformations(scene, stream);
    if (scene->method == METHOD_SPH)
        echo_sph(scene, stream);
    echo_loads(scene, stream, whole);
    echo_velocities(scene, stream, whole);
    echo_output(scene, stream);
    fprintf(stream, "endi\n");
}
