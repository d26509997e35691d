/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elastic bodies of RKPM: exact displacements, moduli, patch tests by all rules and constraints, conjugate gradients against
 * elimination, any number of threads, the frequency of a bar. */
#include "base/memory.h"
#include "base/threads.h"
#include "diagonalise.h"
#include "most_threads.h"
#include "rkpm_fixture.h"

/* --- exact displacements --- */

static void check_deformation(enum rkpm_function function, int dimension, enum plane_mode plane)
{
    const struct scene_rkpm words = {.function = function, .dimension = dimension, .plane = plane, .young = 3, .poisson = 0.3, .beam_load = -0.2,
                                     .box = {0.5, 4.5, -1, 1, 0, 1}};
    const struct deformation deformation = deformation_of(&words);
    const double x[3] = {1.3, 0.4, dimension == 3 ? 0.7 : 0}, step = 1e-4;
    double gradient[3][3], slope = 0, balance = 0, force[3] = {0};
    deformation_gradient(&deformation, x, gradient);
    for (int b = 0; b < dimension; b++) {
        double up[3] = {x[0], x[1], x[2]}, down[3] = {x[0], x[1], x[2]}, u[3], before[3], near[3][3], stress[3][3];
        up[b] += step;
        down[b] -= step;
        deformation_value(&deformation, up, u);
        deformation_value(&deformation, down, before);
        for (int a = 0; a < dimension; a++)
            slope = fmax(slope, fabs((u[a] - before[a]) / (2 * step) - gradient[a][b]));
        for (int s = -1; s <= 1; s += 2) {
            deformation_gradient(&deformation, s > 0 ? up : down, near);
            deformation_stress(dimension, deformation.moduli, near, stress);
            for (int a = 0; a < dimension; a++)
                force[a] += s * stress[a][b] / (2 * step);
        }
    }
    for (int a = 0; a < dimension; a++)
        balance = fmax(balance, fabs(force[a]));
    check_near("gradient of displacements, by differences", slope, 0, 1e-8);
    check_near("their stresses are in equilibrium, by differences", balance, 0, 1e-9);
}

/* The beam's sides are free, and its end carries the load. */
static void check_beam(enum plane_mode plane)
{
    const struct scene_rkpm words = {.function = FUNCTION_BEAM, .dimension = 2, .plane = plane, .young = 3, .poisson = 0.3, .beam_load = -0.2,
                                     .box = {0, 4, -1, 1}};
    const struct deformation deformation = deformation_of(&words);
    double gradient[3][3], stress[3][3], load = 0, side = 0;
    enum { POINTS = 1000 };
    for (int i = 0; i < POINTS; i++) {
        deformation_gradient(&deformation, (const double[3]){4, -1 + 2 * (i + 0.5) / POINTS, 0}, gradient);
        deformation_stress(2, deformation.moduli, gradient, stress);
        load += stress[0][1] * 2 / POINTS;
        side = fmax(side, fabs(stress[0][0]));
        deformation_gradient(&deformation, (const double[3]){4 * (i + 0.5) / POINTS, 1, 0}, gradient);
        deformation_stress(2, deformation.moduli, gradient, stress);
        side = fmax(side, fmax(fabs(stress[1][1]), fabs(stress[0][1])));
    }
    check_near("load at the beam's end", load, -0.2, 1e-6);
    check_near("no stress on its sides, nor along it at its end", side, 0, 1e-14);
}

/* By hand: uniaxial strain e in plane stress has E/(1 - nu^2) e along and nu of it across; in space Lame's constants. */
static void check_moduli(void)
{
    const struct moduli stress = body_moduli(2, PLANE_STRESS, 10, 0.25), strain = body_moduli(2, PLANE_STRAIN, 10, 0.25), bar = body_moduli(1, PLANE_STRESS, 10, 0.25);
    check_near("plane stress", stress.lambda + 2 * stress.mu, 10 / (1 - 0.0625), 1e-13);
    check_near("across", stress.lambda, 0.25 * 10 / (1 - 0.0625), 1e-13);
    check_near("plane strain", strain.lambda, 4, 1e-13);
    check_near("shear", strain.mu, 4, 1e-13);
    check_near("a bar", bar.lambda + 2 * bar.mu, 10, 1e-13);
}

/* --- problems --- */

static void check_patch(const char *what, const char *words)
{
    char block[400], name[400];
    snprintf(block, sizeof block, "prob elastic func patch modu 1000 0.3 %s", words);
    snprintf(name, sizeof name, "patch test %s: %s", what, words);
    const struct rkpm_result result = result_of(block);
    check_near(name, result.l2, 0, 1e-12);
    check_near("and its strains", result.energy, 0, 1e-11);
}

/* Linear displacements are exact with smoothing over cells or corrected test functions, and Nitsche's method (spec rkpm 11.2, D3 to
 * D5); with a bilinear basis on a lattice by all constraints (D2). */
static void check_patches(void)
{
    static const char *const rules[] = {"scni", "nsci", "dni vci on", "snni vci on", "nsni vci on", "gauss vci on"};
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        char words[200];
        snprintf(words, sizeof words, "dime 1 node box 0 1 9 supp 1.75 cons nits held x0 inte %s", rules[i]);
        check_patch("in one dimension", words);
        snprintf(words, sizeof words, "dime 2 plan strain node box 0 2 0 1 9 6 supp 2 pert 0.3 5 cons nits held x1 y0 inte %s", rules[i]);
        check_patch("of plane strain, on scattered nodes", words);
        snprintf(words, sizeof words, "dime 3 node box 0 1 0 1 0 1 4 5 6 supp 1.75 cons nits held z0 inte %s", rules[i]);
        check_patch("in space", words);
    }
    check_patch("by multipliers", "dime 2 node box 0 1 0 1 6 6 basi bilinear supp 1.75 cons lagr held x0 y1");
    check_patch("by transformation", "dime 3 node box 0 1 0 1 0 1 4 5 4 basi bilinear supp 1.75 cons tran held x0 y1");
    check_patch("of a quadratic basis", "dime 2 node box 0 1 0 1 7 7 basi quad supp 2.5 cons nits vci on");
}

/* The penalty's error falls with its factor. */
static void check_penalty(void)
{
    const double weak = result_of("dime 2 node box 0 1 0 1 6 6 basi bilinear supp 1.75 prob elastic func patch modu 7 0.3 cons pena beta 1e3").l2;
    const double strong = result_of("dime 2 node box 0 1 0 1 6 6 basi bilinear supp 1.75 prob elastic func patch modu 7 0.3 cons pena beta 1e5").l2;
    check_near("a penalty a hundred times as large has a hundredth of the error", strong / weak, 0.01, 1e-3);
}

/* --- conjugate gradients --- */

/* The largest difference between coefficients by elimination and by conjugate gradients, over the largest of them. */
static double difference_of(const char *block, long *iterations)
{
    struct problem problem;
    open_problem(&problem, block);
    struct rkpm_level *level = problem.rkpm->levels;
    const size_t count = level->count * (size_t)level->box.dimension;
    double worst = 0, largest = 0, *direct = memory_array(count, sizeof *direct, "a test");
    check_true("few unknowns are found by elimination", !solver_iterates(&level->solver));
    rkpm_elastic_solve(problem.rkpm, level);
    memcpy(direct, level->coefficient, count * sizeof *direct);
    solver_close(&level->solver);
    solver_open(&level->solver, &level->body, 0);
    check_true("where no work is allowed by an iteration", level->solver.kind == (level->body.is_symmetric ? SOLVER_CONJUGATE : SOLVER_BICGSTAB));
    rkpm_elastic_solve(problem.rkpm, level);
    for (size_t i = 0; i < count; i++) {
        worst = fmax(worst, fabs(direct[i] - level->coefficient[i]));
        largest = fmax(largest, fabs(direct[i]));
    }
    *iterations = level->solver.iteration.iterations;
    memory_free(direct);
    close_problem(&problem);
    return worst / largest;
}

static void check_iteration(void)
{
    static const char *const blocks[] = {"dime 2 node box 0 4 -0.5 0.5 41 11 supp 1.75 prob elastic func beam modu 3e7 0.3 forc -1000 held x0 cons tran",
                                         "dime 2 node box 0 1 0 1 31 31 pert 0.3 1 supp 2 inte nsci prob elastic func patch modu 1 0.3 cons nits",
                                         "dime 2 node box 0 1 0 1 31 31 supp 1.75 prob elastic func patch modu 1 0.3 cons tran",
                                         "dime 3 node box 0 1 0 1 0 1 7 7 7 supp 1.75 prob elastic func patch modu 1 0.3 held x0 x1 cons tran",
                                         "dime 3 node box 0 1 0 1 0 1 9 9 9 supp 1.75 inte nsni prob elastic func patch modu 1 0.3 cons nits",
                                         "dime 2 node box 0 1 0 1 31 31 pert 0.3 1 supp 2 inte nsni vci on prob elastic func patch modu 1 0.3 cons nits",
                                         "dime 2 node box 0 1 0 1 31 31 pert 0.3 1 supp 2 inte dni vci on prob elastic func patch modu 1 0.3 cons tran",
                                         "dime 2 node box 0 4 -0.5 0.5 41 11 supp 1.75 gaus 2 vci on prob elastic func beam modu 3e7 0.3 forc -1000 held x0 cons tran",
                                         "dime 3 node box 0 1 0 1 0 1 7 7 7 supp 1.75 inte snni vci on prob elastic func patch modu 1 0.3 cons nits"};
    for (size_t i = 0; i < sizeof blocks / sizeof blocks[0]; i++) {
        long iterations;
        check_near("an iteration finds what elimination finds", difference_of(blocks[i], &iterations), 0, 1e-7);
        check_true("in few iterations", iterations < 250);
    }
}

/* Next to incompressible the iteration stagnates, and elimination takes over. */
static void check_giving_up(void)
{
    static const char block[] = "dime 2 node box 0 1 0 1 21 21 pert 0.3 1 supp 2 inte nsni vci on plan strain prob elastic func patch modu 1 0.4999 "
                                "cons nits beta 1e6 /h";
    struct problem problem;
    open_problem(&problem, block);
    struct rkpm_level *level = problem.rkpm->levels;
    solver_close(&level->solver);
    solver_open(&level->solver, &level->body, 0);
    rkpm_elastic_solve(problem.rkpm, level);
    check_true("an iteration that stagnates gives up", level->solver.has_given_up && level->solver.kind == SOLVER_BANDED);
    check_true("and the run goes on", !problem.rkpm->instability.is_stopped);
    close_problem(&problem);
    check_near("with what elimination finds", difference_of(block, &(long){0}), 0, 1e-12);
}

/* The same numbers on any number of threads. */
static void check_threads(const char *block, double most_work)
{
    const int threads = threads_available();
    double *first = NULL;
    bool same = true;
    for (int run = 0; run < 3; run++) {
        threads_set(run == 0 ? 1 : run == 1 ? 2 : 5);
        struct problem problem;
        open_problem(&problem, block);
        struct rkpm_level *level = problem.rkpm->levels;
        const size_t count = level->count * (size_t)level->box.dimension;
        solver_close(&level->solver);
        solver_open(&level->solver, &level->body, most_work);
        rkpm_elastic_solve(problem.rkpm, level);
        if (!first) {
            first = memory_array(count, sizeof *first, "a test");
            memcpy(first, level->coefficient, count * sizeof *first);
        }
        same = same && memcmp(first, level->coefficient, count * sizeof *first) == 0;
        close_problem(&problem);
    }
    check_true("the same bits on 1, 2 and 5 threads", same);
    memory_free(first);
    threads_set(threads);
}

/* --- E5: a bar of length, modulus and density 1, held at x = 0: first frequency pi/2, and the largest with the mass lumped --- */

enum { BAR_MOST = 41 };

/* Smallest and largest eigenvalue of a symmetric matrix. */
static void find_eigenvalues(int n, double m[BAR_MOST][BAR_MOST], double *least, double *largest)
{
    diagonalise(n, BAR_MOST, m[0]);
    *least = *largest = m[0][0];
    for (int i = 0; i < n; i++) {
        *least = fmin(*least, m[i][i]);
        *largest = fmax(*largest, m[i][i]);
    }
}

/* The first frequency over pi/2, less 1; 2/omega_max in spacings. The mass of a node is the integral of its shape function; the
 * held node is taken out by d_0 = -(sum of others' shape functions there)/Psi_0(0). */
static void find_frequencies(int nodes, double *error, double *critical)
{
    char block[200];
    static double k[BAR_MOST][BAR_MOST], m[BAR_MOST][BAR_MOST], lower[BAR_MOST][BAR_MOST], a[BAR_MOST][BAR_MOST];
    double mass[BAR_MOST] = {0};
    double least, largest, psi[BAR_MOST] = {0};
    snprintf(block, sizeof block, "dime 1 node box 0 1 %d supp 2 gaus 8 prob elastic func patch modu 1 0.3 held x0 cons tran", nodes);
    struct problem problem;
    open_problem(&problem, block);
    struct body *body = &problem.rkpm->levels[0].body;
    body_assemble(body, problem.rkpm->deformation.moduli);
    memset(k, 0, sizeof k);
    memset(m, 0, sizeof m);
    for (int32_t row = 0; row < nodes; row++)
        for (size_t i = body->matrix.first[row]; i < body->matrix.first[row + 1]; i++)
            k[body->node[row]][body->node[body->matrix.column[i]]] = body->matrix.value[i];
    for (size_t t = 0; t < body->held.terms; t++)
        psi[body->held.term[t].node] = body->held.term[t].value;
    for (size_t i = 0; i < body->inside.count; i++)
        for (int q = 0; q < body->inside.neighbours[i]; q++) {
            const size_t pair = i * (size_t)body->inside.stride + (size_t)q;
            mass[body->inside.neighbour[pair]] += points_weight(&body->inside, i, 0) * body->inside.value[pair];
        }
    close_problem(&problem);
    /* K and M of the others: columns, then rows, of the held node go to them */
    const int n = nodes - 1;
    static double stiff[BAR_MOST][BAR_MOST];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const double own = -psi[i + 1] / psi[0], other = -psi[j + 1] / psi[0];
            stiff[i][j] = k[i + 1][j + 1] + own * k[0][j + 1] + other * k[i + 1][0] + own * other * k[0][0];
            m[i][j] = (i == j ? mass[i + 1] : 0) + own * other * mass[0];
        }
    /* M = L L^T; L^-1 K L^-T */
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            double sum = m[i][j];
            for (int q = 0; q < j; q++)
                sum -= lower[i][q] * lower[j][q];
            lower[i][j] = i == j ? sqrt(sum) : sum / lower[j][j];
        }
    for (int pass = 0; pass < 2; pass++) {
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++) {
                double sum = stiff[i][j];
                for (int q = 0; q < i; q++)
                    sum -= lower[i][q] * a[q][j];
                a[i][j] = sum / lower[i][i];
            }
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                stiff[i][j] = a[j][i];
    }
    find_eigenvalues(n, stiff, &least, &largest);
    *error = sqrt(least) / (acos(-1) / 2) - 1;
    *critical = 2 / sqrt(largest) * n;
}

static void check_bar(void)
{
    static const struct {
        int nodes;
        double error;
    } rows[] = {{11, -3.8646e-3}, {21, -9.9732e-4}, {41, -2.5320e-4}}; /* spec rkpm 11.2, E5: independent prototype */
    double error, critical = 0;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        find_frequencies(rows[i].nodes, &error, &critical);
        check_near("E5 first frequency of a bar", error / rows[i].error, 1, 1e-3);
    }
    check_near("E5 critical time step", critical, 1.4384, 1e-3 * 1.4384);
}

int main(void)
{
    begin_with_threads(5);
    for (int dimension = 1; dimension <= 3; dimension++)
        check_deformation(FUNCTION_PATCH, dimension, PLANE_STRESS);
    check_deformation(FUNCTION_BEAM, 2, PLANE_STRESS);
    check_deformation(FUNCTION_BEAM, 2, PLANE_STRAIN);
    check_beam(PLANE_STRESS);
    check_beam(PLANE_STRAIN);
    check_moduli();
    check_patches();
    check_penalty();
    check_iteration();
    check_giving_up();
    check_threads("dime 2 node box 0 1 0 1 51 51 pert 0.3 1 supp 2 inte nsci prob elastic func patch modu 1 0.3 cons nits", 0);
    check_threads("dime 2 node box 0 1 0 1 21 21 supp 1.75 prob elastic func patch modu 1 0.3 cons tran", SOLVER_MOST_WORK);
    check_threads("dime 2 node box 0 1 0 1 51 51 supp 1.75 inte dni vci on prob elastic func patch modu 1 0.3 cons tran", 0);
    check_bar();
    return check_result();
}
