/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program's step against naive_step.h, which follows the words of the spec: every field of
 * every particle, the sums and the time step, step after step. Deviations are relative to the
 * largest value that the field has had anywhere. The expected numbers are those of naive_step.h. */
#include "base/threads.h"
#include "check.h"
#include "naive_step.h"
#include "random.h"
#include "scene_text.h"

/* --- scenes --- */

static void add_point(struct naive *run, int body, double mass, const double position[3], const double velocity[3])
{
    struct naive_particle *p = &run->particles[run->n_particles++];
    *p = (struct naive_particle){.body = body, .mass = mass};
    run->n_bodies = body + 1;
    memcpy(p->position, position, sizeof p->position);
    memcpy(p->velocity, velocity, sizeof p->velocity);
}

/* Bodies are added in the order of their numbers; the last one is that of the last particle. */
static void add_block(struct naive *run, int body, const double origin[3], const int n[3], double spacing,
                      const double velocity[3])
{
    double density = run->materials[run->bodies[body].material].density;
    for (int k = 0; k < n[2]; k++)
        for (int j = 0; j < n[1]; j++)
            for (int i = 0; i < n[0]; i++) {
                const double position[3] = {origin[0] + (i + 0.5) * spacing, origin[1] + (j + 0.5) * spacing,
                                            origin[2] + (k + 0.5) * spacing};
                add_point(run, body, density * spacing * spacing * spacing, position, velocity);
            }
}

#define VECTOR(x, y, z) ((const double[3]){x, y, z})
#define NUMBERS(x, y, z) ((const int[3]){x, y, z})

/* Three materials and as many bodies, of laws elas, pla2, pla1; sound speeds are near 10. */
static void set_grid(struct naive *run, int nx, int ny, int nz)
{
    *run = (struct naive){.low = {-1, 0.25, 2}, .size = 0.5, .cells = {nx, ny, nz}, .step_scale = 0.3,
                          .quadratic = 1.5, .linear = 0.06, .n_materials = 3};
    run->materials[0] = (struct naive_material){NAIVE_ELAS, 1.0, 100, 0.3, 0, 0};
    run->materials[1] = (struct naive_material){NAIVE_PLA2, 1.5, 160, 0.25, 2, 20};
    run->materials[2] = (struct naive_material){NAIVE_PLA1, 0.8, 60, 0.35, 1.2, 0};
    for (int b = 0; b < 3; b++)
        run->bodies[b] = (struct naive_body){.material = b, .component = 1};
}

static void set_boundary(struct naive *run, const int codes[6])
{
    memcpy(run->boundary, codes, sizeof run->boundary);
}

static void add_load(struct naive *run, enum naive_load_kind kind, int target, const double value[3])
{
    struct naive_load *load = &run->loads[run->n_loads++];
    *load = (struct naive_load){.kind = kind, .target = target};
    memcpy(load->value, value, sizeof load->value);
}

/* Adds random velocities, so that a free body is strained. */
static void shake(struct naive *run, double amplitude)
{
    struct random random = {4};
    for (int i = 0; i < run->n_particles; i++)
        for (int a = 0; a < 3; a++)
            run->particles[i].velocity[a] += random_between(&random, -amplitude, amplitude);
}

/* Bodies that run into each other and share cells from the start. */
static void build_overlap(struct naive *run)
{
    set_grid(run, 8, 6, 6);
    add_block(run, 0, VECTOR(-0.4, 0.6, 2.3), NUMBERS(5, 5, 5), 0.25, VECTOR(1, 0.2, 0));
    add_block(run, 1, VECTOR(0.7, 0.9, 2.6), NUMBERS(4, 4, 4), 0.27, VECTOR(-1, 0.1, 0.3));
    add_block(run, 2, VECTOR(0.2, 1.9, 2.5), NUMBERS(3, 2, 4), 0.21, VECTOR(0, -1, 0.5));
}

/* Points anywhere, of any body and mass. */
static void build_cloud(struct naive *run)
{
    struct random random = {1};
    set_grid(run, 6, 5, 4);
    for (int body = 0; body < 3; body++)
        for (int i = 0; i < 70; i++) {
            double x[3], v[3];
            for (int a = 0; a < 3; a++) {
                x[a] = run->low[a] + random_between(&random, 0.6, run->cells[a] - 0.6) * run->size;
                v[a] = random_between(&random, -0.4, 0.4);
            }
            add_point(run, body, random_between(&random, 0.005, 0.02), x, v);
        }
}

/* Points on cell faces, edges and nodes and in cell centres, from the low to the high grid faces.
 * Half of the faces of the grid are walls; points leave through the others. */
static void build_faces(struct naive *run)
{
    struct random random = {2};
    set_grid(run, 4, 3, 2);
    set_boundary(run, (const int[6]){2, 0, 1, 0, 0, 2});
    for (int k = 0; k <= 4; k++)
        for (int j = 0; j <= 6; j++)
            for (int i = 0; i <= 8; i++) {
                const double x[3] = {run->low[0] + 0.25 * i, run->low[1] + 0.25 * j, run->low[2] + 0.25 * k};
                const double v[3] = {random_between(&random, -0.4, 0.4), random_between(&random, -0.4, 0.4),
                                     random_between(&random, -0.4, 0.4)};
                add_point(run, (i + j + k) % 3, 0.015625, x, v);
            }
}

/* The order of the particles in the deck is by body. */
static void build_faces_by_body(struct naive *run)
{
    static struct naive mixed;
    build_faces(&mixed);
    *run = mixed;
    run->n_particles = 0;
    run->n_bodies = 3;
    for (int body = 0; body < 3; body++)
        for (int i = 0; i < mixed.n_particles; i++)
            if (mixed.particles[i].body == body)
                run->particles[run->n_particles++] = mixed.particles[i];
}

/* Four times as fast as sound: two cells in the first step, then half a cell a step. */
static void build_fast(struct naive *run)
{
    set_grid(run, 44, 8, 8);
    run->step_scale = 0.6;
    add_block(run, 0, VECTOR(-0.7, 1.1, 3.1), NUMBERS(4, 4, 3), 0.23, VECTOR(40, 3, -2));
    add_block(run, 1, VECTOR(0.6, 1.3, 3.2), NUMBERS(4, 3, 4), 0.26, VECTOR(39, 2.5, -3));
    shake(run, 0.2);
}

/* One cell across in two directions, walls around. */
static void build_bar(struct naive *run, int axis)
{
    int cells[3] = {1, 1, 1}, n[3] = {2, 2, 2};
    double origin[3] = {-1, 0.25, 2}, velocity[3] = {0};
    cells[axis] = 13;
    n[axis] = 16;
    origin[axis] += 0.75;
    velocity[axis] = 0.7;
    set_grid(run, cells[0], cells[1], cells[2]);
    set_boundary(run, (const int[6]){2, 2, 2, 2, 2, 2});
    run->bodies[0].material = axis;
    run->bodies[1].material = (axis + 1) % 3;
    add_block(run, 0, origin, n, 0.25, velocity);
    origin[axis] += 4.125;
    n[axis] = 5;
    velocity[axis] = -0.5;
    add_block(run, 1, origin, n, 0.25, velocity);
}

static void build_bar_x(struct naive *run)
{
    build_bar(run, 0);
}

static void build_bar_y(struct naive *run)
{
    build_bar(run, 1);
}

static void build_bar_z(struct naive *run)
{
    build_bar(run, 2);
}

/* A body leaves through upper faces, another through lower ones; some points are outside from the
 * start. */
static void build_leaving(struct naive *run)
{
    set_grid(run, 6, 5, 5);
    add_block(run, 0, VECTOR(0.9, 1.6, 3.3), NUMBERS(5, 5, 4), 0.23, VECTOR(3, 2, 2.5));
    add_block(run, 1, VECTOR(-1.3, 0.3, 2.1), NUMBERS(5, 4, 4), 0.24, VECTOR(-1, -2.5, -2));
    shake(run, 0.4);
}

/* Every code, on faces, edges and corners. */
static void build_walls(struct naive *run)
{
    set_grid(run, 4, 4, 4);
    set_boundary(run, (const int[6]){1, 2, 2, 2, 0, 1});
    add_block(run, 0, VECTOR(-1, 0.25, 2.1), NUMBERS(8, 8, 3), 0.25, VECTOR(0.4, -0.6, -0.5));
    add_block(run, 1, VECTOR(-1, 0.25, 3.0), NUMBERS(7, 8, 4), 0.25, VECTOR(-0.3, 0.5, 0.6));
}

/* Every kind of load, damping; later lines replace earlier ones. */
static void build_loads(struct naive *run)
{
    set_grid(run, 6, 5, 5);
    set_boundary(run, (const int[6]){0, 0, 0, 0, 1, 0});
    run->damping = 3;
    add_block(run, 0, VECTOR(-0.7, 0.9, 2.0), NUMBERS(4, 4, 4), 0.24, VECTOR(0, 0, 0));
    add_block(run, 1, VECTOR(0.4, 0.7, 2.2), NUMBERS(4, 5, 3), 0.23, VECTOR(0, 0.1, 0));
    add_load(run, NAIVE_LOAD_BODY, 0, VECTOR(0.01, 0, -0.02));
    add_load(run, NAIVE_LOAD_PARTICLE, 5, VECTOR(0.3, 0.1, 0));
    add_load(run, NAIVE_LOAD_NODE, 7, VECTOR(9, -5, 4));
    add_load(run, NAIVE_LOAD_NODE, 70, VECTOR(3, 5, 4));
    add_load(run, NAIVE_LOAD_PARTICLE, 7, VECTOR(0.1, 0.2, 0.3));
    add_load(run, NAIVE_LOAD_GRAVITY, 0, VECTOR(7, 7, 7));
    add_load(run, NAIVE_LOAD_GRAVITY, 0, VECTOR(0, 0.5, -9));
    add_load(run, NAIVE_LOAD_GRAVITY, 1, VECTOR(-2, 0, -5));
}

/* Velocities go to zero whenever the kinetic energy falls. */
static void build_kinetic_damping(struct naive *run)
{
    set_grid(run, 4, 4, 5);
    set_boundary(run, (const int[6]){2, 2, 2, 2, 1, 0});
    run->damps_kinetic = true;
    add_block(run, 0, VECTOR(-0.9, 0.5, 2.0), NUMBERS(6, 6, 6), 0.25, VECTOR(0, 0, 0));
    add_load(run, NAIVE_LOAD_GRAVITY, 0, VECTOR(0, 0, -20));
}

/* Strong artificial viscosity in a collision. */
static void build_viscous(struct naive *run)
{
    set_grid(run, 9, 4, 4);
    run->quadratic = 4;
    run->linear = 0.8;
    run->step_scale = 0.15;
    add_block(run, 0, VECTOR(-0.6, 0.6, 2.4), NUMBERS(6, 5, 5), 0.25, VECTOR(3, 0, 0));
    add_block(run, 1, VECTOR(0.95, 0.7, 2.3), NUMBERS(5, 4, 5), 0.26, VECTOR(-3, 0, 0));
}

/* The cell size comes after the materials: no mass cutoff (spec 3.1). */
static void build_uncut(struct naive *run)
{
    set_grid(run, 5, 5, 5);
    run->has_no_cutoff = true;
    add_block(run, 0, VECTOR(-0.5, 0.75, 2.5), NUMBERS(5, 5, 5), 0.25, VECTOR(0.5, 0.3, -0.4));
    shake(run, 0.4);
}

/* Hundreds of points of three laws in eight cells. */
static void build_dense(struct naive *run)
{
    struct random random = {3};
    set_grid(run, 5, 4, 4);
    for (int body = 0; body < 3; body++)
        for (int i = 0; i < 120; i++) {
            double x[3], v[3];
            for (int a = 0; a < 3; a++) {
                x[a] = run->low[a] + random_between(&random, 1, 3) * run->size;
                v[a] = random_between(&random, -0.5, 0.5);
            }
            add_point(run, body, 1.0 / 360, x, v);
        }
}

/* Two components without contact share one velocity field (spec 6 A). */
static void build_components(struct naive *run)
{
    build_overlap(run);
    run->bodies[1].component = 2;
}

/* --- decks --- */

static void write_material(struct deck_builder *deck, int number, const struct naive_material *m)
{
    static const char *const laws[] = {"elas", "pla1", "pla2"};
    deck_add(deck, "%d %s %.17g %.17g %.17g", number, laws[m->law], m->density, m->young, m->poisson);
    if (m->law != NAIVE_ELAS)
        deck_add(deck, " %.17g", m->yield);
    if (m->law == NAIVE_PLA2)
        deck_add(deck, " %.17g", m->tangent);
    deck_add(deck, "\n");
}

static void write_bodies(struct deck_builder *deck, const struct naive *run)
{
    for (int body = 0; body < run->n_bodies; body++) {
        int count = 0;
        for (int i = 0; i < run->n_particles; i++)
            count += run->particles[i].body == body;
        deck_add(deck, "part poin %d %d\n", run->bodies[body].component, count);
        for (int i = 0; i < run->n_particles; i++) {
            const struct naive_particle *p = &run->particles[i];
            if (p->body == body)
                deck_add(deck, "%d %d %.17g %.17g %.17g %.17g\n", i + 1, run->bodies[body].material + 1, p->mass,
                         p->position[0], p->position[1], p->position[2]);
        }
    }
}

static void write_loads(struct deck_builder *deck, const struct naive *run)
{
    static const char *const kinds[] = {"part", "body", "node", "grav"};
    deck_add(deck, "load\n");
    for (int i = 0; i < run->n_loads; i++) {
        const struct naive_load *load = &run->loads[i];
        deck_add(deck, "%s %d %.17g %.17g %.17g\n", kinds[load->kind], load->target + 1, load->value[0],
                 load->value[1], load->value[2]);
    }
    deck_add(deck, "endl\nvelo\n");
    for (int i = 0; i < run->n_particles; i++) {
        const double *v = run->particles[i].velocity;
        deck_add(deck, "node %d %.17g %.17g %.17g\n", i + 1, v[0], v[1], v[2]);
    }
    deck_add(deck, "endv\n");
}

static void write_settings(struct deck_builder *deck, const struct naive *run, bool sorts)
{
    static const char *const schemes[] = {"usf", "usl", "musl"}, *const rotations[] = {"off", "on", "exact"};
    deck_add(deck, "nbco 2\nnbbo %d\nnbmp %d\nnmat %d\ngrid", run->n_bodies, run->n_particles, run->n_materials);
    for (int a = 0; a < 3; a++)
        deck_add(deck, " %.17g %.17g", run->low[a], run->low[a] + run->cells[a] * run->size);
    deck_add(deck, "\nfixed");
    for (int face = 0; face < 6; face++)
        deck_add(deck, " %d", run->boundary[face]);
    deck_add(deck, "\nendt 1\ndtsc %.17g\nbulk %.17g %.17g\nDamp %.17g\n%s on\njaum %s\nsort %s\n", run->step_scale,
             run->quadratic, run->linear, run->damping, schemes[run->scheme], rotations[run->rotation],
             sorts ? "on" : "off");
    if (run->damps_kinetic)
        deck_add(deck, "drda\n");
}

static void write_deck(struct deck_builder *deck, const struct naive *run, bool sorts)
{
    write_settings(deck, run, sorts);
    if (!run->has_no_cutoff)
        deck_add(deck, "dcell %.17g\n", run->size);
    deck_add(deck, "mate\n");
    for (int k = 0; k < run->n_materials; k++)
        write_material(deck, k + 1, &run->materials[k]);
    if (run->has_no_cutoff)
        deck_add(deck, "dcell %.17g\n", run->size);
    write_bodies(deck, run);
    write_loads(deck, run);
    deck_add(deck, "endi\n");
}

/* --- comparison --- */

enum field {
    FIELD_POSITION, FIELD_VELOCITY, FIELD_STRESS, FIELD_VOLUME, FIELD_ENERGY, FIELD_VISCOUS, FIELD_PLASTIC,
    FIELD_YIELD, FIELD_KINETIC, FIELD_INTERNAL, FIELD_MOMENTUM, FIELD_TIME, FIELD_FROZEN, FIELD_COUNT
};

static const char *const field_names[FIELD_COUNT] = {"position", "velocity", "stress", "volume", "energy", "viscosity",
                                                     "plastic strain", "yield stress", "kinetic", "internal",
                                                     "momentum", "time", "frozen"};

/* Largest difference and largest value of each field so far. */
struct comparison {
    double difference[FIELD_COUNT], largest[FIELD_COUNT];
};

static void compare(struct comparison *comparison, enum field field, double value, double expected)
{
    double difference = fabs(value - expected);
    if (!(difference <= comparison->difference[field]))
        comparison->difference[field] = isnan(difference) ? INFINITY : difference;
    comparison->largest[field] = fmax(comparison->largest[field], fabs(expected));
}

static double column(const struct mpm *mpm, enum column column, int a, int id)
{
    return mpm->store->real[column][a][mpm->store->index_of_id[id]];
}

static void compare_particle(struct comparison *comparison, const struct mpm *mpm, const struct naive *run, int id)
{
    const struct naive_particle *p = &run->particles[id];
    enum naive_law law = naive_material_of(run, p)->law;
    for (int a = 0; a < 3; a++) {
        compare(comparison, FIELD_POSITION, column(mpm, COLUMN_POSITION, a, id), p->position[a]);
        compare(comparison, FIELD_VELOCITY, column(mpm, COLUMN_VELOCITY, a, id), p->velocity[a]);
    }
    for (int a = 0; a < 6; a++)
        compare(comparison, FIELD_STRESS, column(mpm, COLUMN_STRESS, a, id), p->deviator[a] + (a < 3 ? p->mean : 0));
    compare(comparison, FIELD_VOLUME, column(mpm, COLUMN_VOLUME, 0, id), p->volume);
    compare(comparison, FIELD_ENERGY, column(mpm, COLUMN_ENERGY, 0, id), p->energy);
    compare(comparison, FIELD_VISCOUS, column(mpm, COLUMN_VISCOUS_PRESSURE, 0, id), p->viscous);
    if (law != NAIVE_ELAS)
        compare(comparison, FIELD_PLASTIC, column(mpm, COLUMN_PLASTIC_STRAIN, 0, id), p->plastic_strain);
    if (law == NAIVE_PLA2)
        compare(comparison, FIELD_YIELD, column(mpm, COLUMN_YIELD_STRESS, 0, id), p->yield_stress);
}

/* Particles that will have no cell in the next step. */
static int naive_frozen(const struct naive *run)
{
    int count = 0;
    for (int i = 0; i < run->n_particles; i++) {
        const struct naive_particle *p = &run->particles[i];
        bool is_in = !p->is_frozen;
        for (int a = 0; a < 3; a++) {
            double high = run->low[a] + run->cells[a] * run->size;
            is_in = is_in && p->position[a] >= run->low[a] && p->position[a] <= high;
        }
        count += !is_in;
    }
    return count;
}

static void compare_all(struct comparison *comparison, const struct mpm *mpm, const struct naive *run)
{
    double momentum = 0;
    for (int id = 0; id < run->n_particles; id++)
        compare_particle(comparison, mpm, run, id);
    compare(comparison, FIELD_KINETIC, mpm->sums.kinetic, run->kinetic);
    compare(comparison, FIELD_INTERNAL, mpm->sums.internal, run->internal);
    for (int i = 0; i < run->n_particles; i++)
        for (int a = 0; a < 3; a++)
            momentum += run->particles[i].mass * fabs(run->particles[i].velocity[a]);
    for (int a = 0; a < 3; a++)
        compare(comparison, FIELD_MOMENTUM, mpm->sums.momentum[a], run->momentum[a]);
    comparison->largest[FIELD_MOMENTUM] = fmax(comparison->largest[FIELD_MOMENTUM], momentum);
    compare(comparison, FIELD_TIME, mpm->time_step, run->time_step);
    compare(comparison, FIELD_TIME, mpm->time, run->time);
    compare(comparison, FIELD_FROZEN, mpm->cells->count - mpm->cells->in_cells, naive_frozen(run));
}

/* The largest relative deviation; prints the fields beyond the tolerance. */
static double worst(const struct comparison *comparison, double tolerance)
{
    double result = 0;
    for (int field = 0; field < FIELD_COUNT; field++) {
        double largest = comparison->largest[field], difference = comparison->difference[field];
        double deviation = difference == 0 ? 0 : difference / largest;
        result = fmax(result, deviation);
        if (!(deviation <= tolerance))
            printf("   %s: %.3g of %.3g\n", field_names[field], difference, largest);
    }
    return result;
}

/* --- cases --- */

struct scene_case {
    const char *name;
    void (*build)(struct naive *run);
    int steps;
    bool all_rotations, is_unsorted;
    bool yields, freezes; /* what the case is for must happen in it */
};

static const double TOLERANCE = 1e-11;

static const struct scene_case cases[] = {
    {"overlap", build_overlap, 50, true, false, true, false},
    {"overlap unsorted", build_overlap, 30, false, true, true, false},
    {"components", build_components, 30, false, false, true, false},
    {"cloud", build_cloud, 60, false, false, true, false},
    {"on faces and nodes", build_faces_by_body, 50, false, false, true, true},
    {"fast", build_fast, 50, false, false, true, false},
    {"bar along x", build_bar_x, 80, false, false, true, false},
    {"bar along y", build_bar_y, 80, false, false, true, false},
    {"bar along z", build_bar_z, 80, false, false, true, false},
    {"leaving", build_leaving, 80, false, false, true, true},
    {"walls", build_walls, 40, true, false, true, false},
    {"loads", build_loads, 80, false, false, true, false},
    {"kinetic damping", build_kinetic_damping, 80, false, false, false, false},
    {"viscous", build_viscous, 80, false, false, true, false},
    {"uncut", build_uncut, 80, false, false, false, false},
    {"dense", build_dense, 40, false, false, true, false},
};

/* USL blows up at nodes of small mass (spec D14), and round-off with it. Smaller steps, and a heavy
 * material that no body has, which lifts the mass cutoff to two per cent of a full cell (spec 3.1),
 * keep it alive here. */
static void tame(struct naive *run)
{
    run->step_scale *= 0.2;
    run->materials[run->n_materials++] = (struct naive_material){NAIVE_ELAS, 8000, 100, 0.3, 0, 0};
}

static void run_case(const struct scene_case *the_case, enum naive_scheme scheme, enum naive_rotation rotation)
{
    static const char *const schemes[] = {"usf", "usl", "musl"}, *const rotations[] = {"off", "on", "exact"};
    static struct naive run;
    char name[100];
    struct deck_builder deck = {0};
    struct test_run opened;
    struct comparison comparison = {{0}, {0}};
    snprintf(name, sizeof name, "step: %s, %s, jaum %s", the_case->name, schemes[scheme], rotations[rotation]);
    the_case->build(&run);
    run.scheme = scheme;
    run.rotation = rotation;
    if (scheme == NAIVE_USL)
        tame(&run);
    naive_start(&run);
    write_deck(&deck, &run, !the_case->is_unsorted);
    test_run_open(&opened, &deck);
    while (run.step < the_case->steps) {
        naive_step(&run);
        mpm_step(opened.mpm);
        if (run.step < 4 || run.step % 4 == 0)
            compare_all(&comparison, opened.mpm, &run);
    }
    double deviation = worst(&comparison, TOLERANCE);
    printf("   largest deviation %.2g\n", deviation);
    check_near(name, deviation, 0, TOLERANCE);
    bool yields = comparison.largest[FIELD_PLASTIC] > 0.001, freezes = comparison.largest[FIELD_FROZEN] >= 10;
    if ((the_case->yields && !yields) || (the_case->freezes && !freezes))
        check_true(name, false);
    test_run_close(&opened);
}

int main(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (int scheme = 0; scheme < 3; scheme++)
            for (int rotation = 0; rotation < 3; rotation++)
                if (cases[i].all_rotations || rotation == NAIVE_EXPLICIT) {
                    run_case(&cases[i], (enum naive_scheme)scheme, (enum naive_rotation)rotation);
                    threads_set(1); /* waiting for other threads takes longer than all the work here */
                }
    return check_result();
}
