/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One step of the material point method as the words of the spec's sections 4 to 7.1 and 9.4, 9.5
 * put it: plain loops over particles and their eight nodes on a dense grid. Written from the spec
 * alone, for tests only; it shares no code with the program. */
#ifndef UNIT_NAIVE_STEP_H
#define UNIT_NAIVE_STEP_H

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { NAIVE_PARTICLES = 800, NAIVE_NODES = 4200, NAIVE_BODIES = 6, NAIVE_LOADS = 8 };

enum naive_law { NAIVE_ELAS, NAIVE_PLA1, NAIVE_PLA2 };
enum naive_scheme { NAIVE_USF, NAIVE_USL, NAIVE_MUSL };
enum naive_rotation { NAIVE_UNROTATED, NAIVE_EXPLICIT, NAIVE_ORTHOGONAL };
enum naive_load_kind { NAIVE_LOAD_PARTICLE, NAIVE_LOAD_BODY, NAIVE_LOAD_NODE, NAIVE_LOAD_GRAVITY };

struct naive_material {
    enum naive_law law;
    double density, young, poisson, yield, tangent;
};

struct naive_body {
    int material, component;
    double gravity[3];
};

struct naive_load {
    enum naive_load_kind kind;
    int target;
    double value[3];
};

struct naive_node {
    double mass, momentum[3], force[3];
    bool is_fixed[3];
};

/* A node of a particle's cell with its shape function. */
struct naive_support {
    struct naive_node *node;
    double value, slope[3];
};

struct naive_particle {
    int body;
    bool is_frozen;
    int cell[3];
    double mass, volume, load[3];
    double position[3], next_position[3], velocity[3];
    double mean, deviator[6];
    double energy, viscous, plastic_strain, yield_stress;
    struct naive_support supports[8];
};

struct naive {
    double low[3], size;
    int cells[3], boundary[6];
    double step_scale, quadratic, linear, damping;
    bool has_no_cutoff, damps_kinetic;
    enum naive_scheme scheme;
    enum naive_rotation rotation;
    struct naive_material materials[NAIVE_BODIES];
    int n_materials;
    struct naive_body bodies[NAIVE_BODIES];
    int n_bodies;
    struct naive_load loads[NAIVE_LOADS];
    int n_loads;
    struct naive_particle particles[NAIVE_PARTICLES];
    int n_particles;

    struct naive_node nodes[NAIVE_NODES];
    double cutoff, time, time_step;
    long step;
    double kinetic, internal, momentum[3], previous_kinetic;
};

/* --- material constants (spec 3.3, 5, 8) --- */

static double naive_wave_speed(const struct naive_material *m)
{
    double e = m->young, nu = m->poisson;
    return sqrt(e * (1 - nu) / ((1 + nu) * (1 - 2 * nu) * m->density));
}

static const struct naive_material *naive_material_of(const struct naive *run, const struct naive_particle *p)
{
    return &run->materials[run->bodies[p->body].material];
}

/* --- grid (spec 4) --- */

static int naive_nodes(const struct naive *run, int axis)
{
    return run->cells[axis] + 1;
}

static void naive_mark_fixed(struct naive *run, const int at[3], struct naive_node *node)
{
    for (int face = 0; face < 6; face++) {
        int axis = face / 2, layer = face % 2 ? naive_nodes(run, axis) - 1 : 0;
        if (at[axis] != layer || run->boundary[face] == 0)
            continue;
        for (int a = 0; a < 3; a++)
            if (run->boundary[face] == 1 || a == axis)
                node->is_fixed[a] = true;
    }
}

static struct naive_node *naive_node_at(struct naive *run, int x, int y, int z)
{
    return &run->nodes[(z * naive_nodes(run, 1) + y) * naive_nodes(run, 0) + x];
}

static int naive_node_count(const struct naive *run)
{
    return naive_nodes(run, 0) * naive_nodes(run, 1) * naive_nodes(run, 2);
}

/* 4.2: no cell outside the closed box; on an upper face the last cell (D5). */
static void naive_find_cell(struct naive *run, struct naive_particle *p)
{
    for (int a = 0; a < 3; a++) {
        double x = p->position[a], high = run->low[a] + run->cells[a] * run->size;
        if (!(x >= run->low[a] && x <= high))
            p->is_frozen = true;
        if (p->is_frozen)
            return;
        p->cell[a] = (int)((x - run->low[a]) / run->size);
        if (p->cell[a] == run->cells[a])
            p->cell[a]--;
    }
}

/* 7.1, with the corners in the order of 4.1. */
static struct naive_support naive_support_of(struct naive *run, const struct naive_particle *p, int corner)
{
    static const int offsets[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                      {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const int *offset = offsets[corner];
    double factor[3], sign[3];
    for (int a = 0; a < 3; a++) {
        double centre = run->low[a] + (p->cell[a] + 0.5) * run->size;
        sign[a] = 2 * offset[a] - 1;
        factor[a] = 1 + sign[a] * (2 * (p->position[a] - centre) / run->size);
    }
    struct naive_support support;
    support.node = naive_node_at(run, p->cell[0] + offset[0], p->cell[1] + offset[1], p->cell[2] + offset[2]);
    support.value = 0.125 * factor[0] * factor[1] * factor[2];
    for (int a = 0; a < 3; a++)
        support.slope[a] = sign[a] / (4 * run->size) * factor[(a + 1) % 3] * factor[(a + 2) % 3];
    return support;
}

/* 6: cells and shape functions at the beginning of the step hold for all of it. */
static void naive_find_supports(struct naive *run)
{
    for (int i = 0; i < run->n_particles; i++) {
        struct naive_particle *p = &run->particles[i];
        naive_find_cell(run, p);
        for (int c = 0; c < 8 && !p->is_frozen; c++)
            p->supports[c] = naive_support_of(run, p, c);
    }
}

/* --- start state (spec 3.3, 3.4) --- */

static void naive_apply_load(struct naive *run, const struct naive_load *load)
{
    if (load->kind == NAIVE_LOAD_GRAVITY)
        memcpy(run->bodies[load->target].gravity, load->value, sizeof load->value);
    for (int i = 0; i < run->n_particles; i++) {
        struct naive_particle *p = &run->particles[i];
        bool is_of_body = load->kind == NAIVE_LOAD_BODY && p->body == load->target;
        bool is_one = (load->kind == NAIVE_LOAD_PARTICLE || load->kind == NAIVE_LOAD_NODE) && i == load->target;
        for (int a = 0; a < 3 && (is_of_body || is_one); a++)
            p->load[a] = load->value[a] * (load->kind == NAIVE_LOAD_NODE ? p->volume : 1);
    }
}

static void naive_sums(struct naive *run)
{
    run->kinetic = run->internal = 0;
    for (int a = 0; a < 3; a++)
        run->momentum[a] = 0;
    for (int i = 0; i < run->n_particles; i++) {
        const struct naive_particle *p = &run->particles[i];
        run->internal += p->energy;
        for (int a = 0; a < 3; a++) {
            run->kinetic += 0.5 * p->mass * p->velocity[a] * p->velocity[a];
            run->momentum[a] += p->mass * p->velocity[a];
        }
    }
}

/* 5: the largest velocity component counts, but not in the first step. */
static void naive_next_time_step(struct naive *run, bool is_first)
{
    double fastest = 0, smallest = INFINITY;
    for (int i = 0; i < run->n_particles && !is_first; i++)
        for (int a = 0; a < 3; a++)
            fastest = fmax(fastest, fabs(run->particles[i].velocity[a]));
    for (int k = 0; k < run->n_materials; k++)
        smallest = fmin(smallest, run->size / (naive_wave_speed(&run->materials[k]) + fastest));
    run->time_step = run->step_scale * smallest;
}

/* Settings, positions, velocities, masses and bodies are given; the rest follows here. */
static void naive_start(struct naive *run)
{
    double density = 0;
    for (int k = 0; k < run->n_materials; k++)
        density += run->materials[k].density / run->n_materials;
    run->cutoff = run->has_no_cutoff ? 0 : 1e-5 * density * run->size * run->size * run->size;
    for (int i = 0; i < run->n_particles; i++) {
        struct naive_particle *p = &run->particles[i];
        p->volume = p->mass / naive_material_of(run, p)->density;
        p->yield_stress = naive_material_of(run, p)->yield;
    }
    for (int i = 0; i < run->n_loads; i++)
        naive_apply_load(run, &run->loads[i]);
    int at[3];
    for (at[2] = 0; at[2] < naive_nodes(run, 2); at[2]++)
        for (at[1] = 0; at[1] < naive_nodes(run, 1); at[1]++)
            for (at[0] = 0; at[0] < naive_nodes(run, 0); at[0]++)
                naive_mark_fixed(run, at, naive_node_at(run, at[0], at[1], at[2]));
    naive_sums(run);
    run->previous_kinetic = run->kinetic;
    naive_next_time_step(run, true);
}

/* --- particles to grid (spec 6 A, C, G) --- */

static void naive_scatter_momentum(struct naive *run, bool with_mass)
{
    for (int n = 0; n < naive_node_count(run); n++) {
        struct naive_node *node = &run->nodes[n];
        node->mass = with_mass ? 0 : node->mass;
        for (int a = 0; a < 3; a++)
            node->momentum[a] = 0;
    }
    for (int i = 0; i < run->n_particles; i++) {
        const struct naive_particle *p = &run->particles[i];
        for (int c = 0; c < 8 && !p->is_frozen; c++) {
            const struct naive_support *s = &p->supports[c];
            s->node->mass += with_mass ? s->value * p->mass : 0;
            for (int a = 0; a < 3; a++)
                s->node->momentum[a] += s->value * p->mass * p->velocity[a];
        }
    }
}

/* What a particle gives to the nodes' forces: stress with the artificial viscosity, and the rest. */
static void naive_particle_force(const struct naive *run, const struct naive_particle *p, double stress[3][3],
                                 double external[3])
{
    static const int component[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
    for (int a = 0; a < 3; a++) {
        external[a] = p->load[a] - run->damping * p->mass * p->velocity[a]
                    + p->mass * run->bodies[p->body].gravity[a];
        for (int b = 0; b < 3; b++)
            stress[a][b] = p->deviator[component[a][b]] + (a == b ? p->mean - p->viscous : 0);
    }
}

static void naive_scatter_forces(struct naive *run)
{
    for (int n = 0; n < naive_node_count(run); n++)
        for (int a = 0; a < 3; a++)
            run->nodes[n].force[a] = 0;
    for (int i = 0; i < run->n_particles; i++) {
        const struct naive_particle *p = &run->particles[i];
        double stress[3][3], external[3];
        naive_particle_force(run, p, stress, external);
        for (int c = 0; c < 8 && !p->is_frozen; c++) {
            const struct naive_support *s = &p->supports[c];
            for (int a = 0; a < 3; a++) {
                const double *row = stress[a];
                double internal = row[0] * s->slope[0] + row[1] * s->slope[1] + row[2] * s->slope[2];
                s->node->force[a] += s->value * external[a] - p->volume * internal;
            }
        }
    }
}

static void naive_fix_momentum(struct naive *run)
{
    for (int n = 0; n < naive_node_count(run); n++)
        for (int a = 0; a < 3; a++)
            if (run->nodes[n].is_fixed[a])
                run->nodes[n].momentum[a] = 0;
}

/* D */
static void naive_update_grid(struct naive *run, double step)
{
    for (int n = 0; n < naive_node_count(run); n++)
        for (int a = 0; a < 3; a++) {
            struct naive_node *node = &run->nodes[n];
            node->momentum[a] += node->force[a] * step;
            if (node->is_fixed[a])
                node->momentum[a] = node->force[a] = 0;
        }
}

/* --- grid to particles (spec 6 F) --- */

static void naive_move_particles(struct naive *run, double step)
{
    for (int i = 0; i < run->n_particles; i++) {
        struct naive_particle *p = &run->particles[i];
        double velocity[3] = {0}, acceleration[3] = {0};
        if (p->is_frozen)
            continue;
        for (int c = 0; c < 8; c++) {
            const struct naive_support *s = &p->supports[c];
            for (int a = 0; a < 3 && s->node->mass > run->cutoff; a++) {
                velocity[a] += s->value * s->node->momentum[a] / s->node->mass;
                acceleration[a] += s->value * s->node->force[a] / s->node->mass;
            }
        }
        for (int a = 0; a < 3; a++) {
            p->next_position[a] = p->position[a] + velocity[a] * run->time_step;
            p->velocity[a] += acceleration[a] * step;
        }
    }
}

static void naive_take_positions(struct naive *run)
{
    for (int i = 0; i < run->n_particles; i++)
        if (!run->particles[i].is_frozen)
            memcpy(run->particles[i].position, run->particles[i].next_position, sizeof run->particles[i].position);
}

/* --- stress update (spec 6.2 to 6.6, 8.1) --- */

/* 6.3 in its own words; s holds the full old stress, the result goes to r. */
static void naive_rotate_explicit(const double s[6], const double w[3], double r[6])
{
    double w1 = w[0], w2 = w[1], w3 = w[2];
    double q1 = 2 * s[5] * w3, q2 = 2 * s[4] * w2, q3 = 2 * s[3] * w1;
    r[0] = s[0] - q1 + q2;
    r[1] = s[1] + q1 - q3;
    r[2] = s[2] - q2 + q3;
    r[3] = s[3] + w1 * (s[1] - s[2]) + w3 * s[4] - w2 * s[5];
    r[4] = s[4] + w2 * (s[2] - s[0]) + w1 * s[5] - w3 * s[3];
    r[5] = s[5] + w3 * (s[0] - s[1]) + w2 * s[3] - w1 * s[4];
}

/* Inverse of a 3 x 3 matrix by its cofactors. */
static void naive_invert(double m[3][3], double inverse[3][3])
{
    double determinant = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            inverse[j][i] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    for (int j = 0; j < 3; j++)
        determinant += m[0][j] * inverse[j][0];
    for (int i = 0; i < 9; i++)
        inverse[i / 3][i % 3] /= determinant;
}

static void naive_multiply(double a[3][3], double b[3][3], double product[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            product[i][j] = 0;
            for (int k = 0; k < 3; k++)
                product[i][j] += a[i][k] * b[k][j];
        }
}

/* Q s Q^T with Q = (1 - W/2)^-1 (1 + W/2) (Hughes and Winget 1980). */
static void naive_rotate_orthogonal(const double s[6], const double w[3], double r[6])
{
    double spin[3][3] = {{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}};
    double minus[3][3], plus[3][3], inverse[3][3], q[3][3], transposed[3][3], left[3][3], turned[3][3];
    double stress[3][3] = {{s[0], s[5], s[4]}, {s[5], s[1], s[3]}, {s[4], s[3], s[2]}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            minus[i][j] = (i == j) - 0.5 * spin[i][j];
            plus[i][j] = (i == j) + 0.5 * spin[i][j];
        }
    naive_invert(minus, inverse);
    naive_multiply(inverse, plus, q);
    for (int i = 0; i < 9; i++)
        transposed[i % 3][i / 3] = q[i / 3][i % 3];
    naive_multiply(q, stress, left);
    naive_multiply(left, transposed, turned);
    const double result[6] = {turned[0][0], turned[1][1], turned[2][2], turned[1][2], turned[0][2], turned[0][1]};
    memcpy(r, result, sizeof result);
}

/* 6.2: L_ab = dv_a / dx_b. */
static void naive_gradient(const struct naive *run, const struct naive_particle *p, double gradient[3][3])
{
    memset(gradient, 0, 9 * sizeof(double));
    for (int c = 0; c < 8; c++) {
        const struct naive_support *s = &p->supports[c];
        for (int a = 0; a < 3 && s->node->mass > run->cutoff; a++) {
            double velocity = s->node->momentum[a] / s->node->mass;
            for (int b = 0; b < 3; b++)
                gradient[a][b] += velocity * s->slope[b];
        }
    }
}

/* Elastic deviator, return to the yield surface, elastic pressure (8.1). */
static void naive_law_update(const struct naive_material *m, struct naive_particle *p, const double strain[6])
{
    double shear = m->young / (2 * (1 + m->poisson)), three_bulk = m->young / (1 - 2 * m->poisson);
    double trace = strain[0] + strain[1] + strain[2], j2 = 0;
    for (int a = 0; a < 3; a++) {
        p->deviator[a] += 2 * shear * (strain[a] - trace / 3);
        p->deviator[a + 3] += shear * strain[a + 3];
    }
    for (int a = 0; a < 6; a++)
        j2 += (a < 3 ? 0.5 : 1) * p->deviator[a] * p->deviator[a];
    double equivalent = sqrt(3 * j2);
    if (m->law != NAIVE_ELAS && equivalent > p->yield_stress) {
        double hardening = m->law == NAIVE_PLA2 ? m->young * m->tangent / (m->young - m->tangent) : 0;
        double increment = (equivalent - p->yield_stress) / (3 * shear + hardening);
        p->plastic_strain += increment;
        p->yield_stress += hardening * increment;
        for (int a = 0; a < 6; a++)
            p->deviator[a] *= p->yield_stress / equivalent;
    }
    p->mean += three_bulk * trace / 3;
}

/* The old stress, rotated, split into mean and deviator of the particle. */
static void naive_rotate(const struct naive *run, struct naive_particle *p, const double spin[3])
{
    double old[6], rotated[6];
    for (int a = 0; a < 6; a++)
        old[a] = p->deviator[a] + (a < 3 ? p->mean : 0);
    memcpy(rotated, old, sizeof old);
    if (run->rotation == NAIVE_EXPLICIT)
        naive_rotate_explicit(old, spin, rotated);
    if (run->rotation == NAIVE_ORTHOGONAL)
        naive_rotate_orthogonal(old, spin, rotated);
    p->mean = (rotated[0] + rotated[1] + rotated[2]) / 3;
    for (int a = 0; a < 6; a++)
        p->deviator[a] = rotated[a] - (a < 3 ? p->mean : 0);
}

static double naive_work(const struct naive_particle *p, const double strain[6])
{
    double work = 0;
    for (int a = 0; a < 6; a++)
        work += (p->deviator[a] + (a < 3 ? p->mean : 0)) * strain[a];
    return work;
}

/* 6.5 */
static double naive_viscous(const struct naive *run, const struct naive_particle *p, double trace)
{
    const struct naive_material *m = naive_material_of(run, p);
    double rate = fmin(trace / run->time_step, 0), density = p->mass / p->volume;
    double speed = m->law == NAIVE_ELAS ? naive_wave_speed(m) : 0;
    return density * run->size * run->size * run->quadratic * rate * rate
         - run->linear * density * run->size * speed * rate;
}

static void naive_update_stress_of(struct naive *run, struct naive_particle *p)
{
    double l[3][3], dt = run->time_step, old_volume = p->volume;
    naive_gradient(run, p, l);
    const double strain[6] = {dt * l[0][0], dt * l[1][1], dt * l[2][2],
                              dt * (l[1][2] + l[2][1]), dt * (l[0][2] + l[2][0]), dt * (l[0][1] + l[1][0])};
    const double spin[3] = {dt * (l[2][1] - l[1][2]) / 2, dt * (l[0][2] - l[2][0]) / 2,
                            dt * (l[1][0] - l[0][1]) / 2};
    double trace = strain[0] + strain[1] + strain[2];
    naive_rotate(run, p, spin);
    p->volume = old_volume * (1 + trace);
    p->viscous = 0;
    double work = naive_work(p, strain);
    naive_law_update(naive_material_of(run, p), p, strain);
    work += naive_work(p, strain);
    if (p->mean < 0)
        p->viscous = naive_viscous(run, p, trace);
    work -= 2 * p->viscous * trace;
    p->energy += 0.25 * (old_volume + p->volume) * work;
}

static void naive_update_stress(struct naive *run)
{
    for (int i = 0; i < run->n_particles; i++)
        if (!run->particles[i].is_frozen)
            naive_update_stress_of(run, &run->particles[i]);
}

/* --- one step (spec 6) --- */

/* 9.5 */
static void naive_damp_kinetic(struct naive *run)
{
    if (run->kinetic <= run->previous_kinetic) {
        for (int i = 0; i < run->n_particles; i++)
            memset(run->particles[i].velocity, 0, sizeof run->particles[i].velocity);
        run->kinetic = 0;
    }
    run->previous_kinetic = run->kinetic;
}

static void naive_step(struct naive *run)
{
    run->step++;
    run->time += run->time_step;
    double force_step = run->step == 1 ? run->time_step / 2 : run->time_step;
    naive_find_supports(run);
    naive_scatter_momentum(run, true);
    if (run->scheme == NAIVE_USF) {
        naive_fix_momentum(run);
        naive_update_stress(run);
    }
    naive_scatter_forces(run);
    naive_update_grid(run, force_step);
    naive_move_particles(run, force_step);
    if (run->scheme == NAIVE_MUSL) {
        naive_scatter_momentum(run, false);
        naive_fix_momentum(run);
    }
    if (run->scheme != NAIVE_USF)
        naive_update_stress(run);
    naive_take_positions(run);
    naive_sums(run);
    naive_next_time_step(run, false);
    if (run->damps_kinetic)
        naive_damp_kinetic(run);
}

#endif
