/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies of RKPM that relax: creep of a point in plane stress against the closed form, a jump in a step of no length, load steps,
 * the balance of each step, any number of threads. */
#include "base/memory.h"
#include "base/threads.h"
#include "most_threads.h"
#include "rkpm_fixture.h"

/* --- a point in plane stress under sigma_xx = 1 from t = 0 on --- */

static struct scene_rkpm creep_words(enum maxwell_rule rule, bool relaxes_volume)
{
    return (struct scene_rkpm){.dimension = 2, .plane = PLANE_STRESS, .young = 1e5, .poisson = 0.3, .n_elements = 1, .elements = {{4e5, 1}},
                               .rule = rule, .relaxes_volume = relaxes_volume};
}

/* One step to the stress: the increment that is missing after the strain before has relaxed. */
static void load_point(struct relaxation *relaxation, double time_step, double strain[4], double stress[4])
{
    const struct moduli moduli = relaxation_moduli(relaxation, time_step);
    relaxation_step(relaxation, time_step, NULL, stress, false);
    const double along = 1 - stress[0], across = -stress[3], direct = moduli.lambda + 2 * moduli.mu;
    const double determinant = direct * direct - moduli.lambda * moduli.lambda;
    strain[0] += (direct * along - moduli.lambda * across) / determinant;
    strain[3] += (direct * across - moduli.lambda * along) / determinant;
    relaxation_step(relaxation, time_step, strain, stress, true);
}

/* Strains at t = 0 and at t = 10. */
static void creep_point(enum maxwell_rule rule, bool relaxes_volume, int steps, double early[2], double late[2])
{
    const struct scene_rkpm words = creep_words(rule, relaxes_volume);
    struct relaxation relaxation;
    double strain[4] = {0}, stress[4], worst = 0;
    relaxation_open(&relaxation, &words, 1);
    load_point(&relaxation, 0, strain, stress);
    early[0] = strain[0];
    early[1] = strain[3];
    for (int i = 0; i < steps; i++) {
        load_point(&relaxation, 10.0 / steps, strain, stress);
        worst = fmax(worst, fmax(fabs(stress[0] - 1), fabs(stress[3])));
    }
    late[0] = strain[0];
    late[1] = strain[3];
    check_near("one solution per step leaves no residual", worst, 0, 1e-12);
    relaxation_close(&relaxation);
}

static void check_creep_point(enum maxwell_rule rule, bool relaxes_volume, double along, double across, double bound)
{
    double early[2], late[2], fine[2];
    creep_point(rule, relaxes_volume, 100, early, late);
    /* at once a body of Young's modulus 5e5; closed forms at t = 10: spec rkpm 11.3, M6 and M7 */
    check_near("M6 strain at once", early[0], 2e-6, 1e-18);
    check_near("M6 strain across at once", early[1], -6e-7, 1e-18);
    check_near("M6, M7 strain at 10", late[0] / along, 1, bound);
    check_near("M6, M7 strain across at 10", late[1] / across, 1, bound);
    creep_point(rule, relaxes_volume, 200, early, fine);
    check_near("M6, M7 of second order", (late[0] - along) / (fine[0] - along), 4, 0.05);
}

/* A jump in a step of no length is elastic with all moduli, and does not touch what follows: then the strain is kept. */
static void check_jump(void)
{
    const struct scene_rkpm words = creep_words(MAXWELL_EXPONENTIAL, true);
    struct relaxation relaxation;
    const double strain[4] = {1e-3, 2e-4, 2e-4, -5e-4};
    double stress[4], later[4];
    relaxation_open(&relaxation, &words, 1);
    relaxation_step(&relaxation, 0, strain, stress, true);
    const double direct = 5e5 / (1 - 0.09);
    check_near("stress at once", stress[0], direct * (strain[0] + 0.3 * strain[3]), 1e-9);
    check_near("shear at once", stress[1], 5e5 / 1.3 * strain[1], 1e-9);
    for (int i = 0; i < 7; i++)
        relaxation_step(&relaxation, 0.1 * i, strain, later, true);
    /* all moduli relax alike: 1/5 + 4/5 exp(-t) of the stress, any steps; t = 2.1 */
    for (int c = 0; c < 4; c++)
        check_near("relaxation of a strain that is kept", later[c], stress[c] * (0.2 + 0.8 * exp(-2.1)), 1e-9);
    relaxation_close(&relaxation);
}

/* --- problems --- */

/* Steps end at changes of the load and at the end, and no step is longer than asked for. */
static void check_steps(void)
{
    struct problem problem;
    open_problem(&problem, "dime 2 node box 0 4 0 1 5 3 supp 1.75 prob creep func load forc 1 modu 1 0.3 elem 2 3 held x0 "
                                          "span 1 0.3 from 0.5 2 from 1 3");
    static const struct creep_step expected[] = {{0.25, 0.25, 0}, {0.5, 0.25, 0}, {0.5, 0, 2}, {0.75, 0.25, 2}, {1, 0.25, 2}, {1, 0, 3}};
    const struct creep *creep = &problem.rkpm->creep;
    bool good = creep->n_steps == sizeof expected / sizeof expected[0];
    for (size_t i = 0; i < creep->n_steps && good; i++)
        good = creep->steps[i].time == expected[i].time && creep->steps[i].length == expected[i].length && creep->steps[i].load == expected[i].load;
    check_true("steps to the moments when the load changes", good);
    while (rkpm_goes_on(problem.rkpm))
        check_true("the step is solved", !rkpm_advance(problem.rkpm).is_stopped);
    check_near("the last moment", problem.rkpm->time, 1, 0);
    close_problem(&problem);
}

/* All moduli relax alike, so that displacements are those of an elastic body times J(t) E_0, for each rule and way of holding. */
static void check_scaling(const char *words, double bound)
{
    char block[300];
    snprintf(block, sizeof block, "%s prob creep func load forc 1 modu 1 0.3 elem 4 1 vrel on held x0 span 10 0.02 from 0 1", words);
    struct problem problem;
    open_problem(&problem, block);
    rkpm_advance(problem.rkpm);
    const double at_once = problem.rkpm->tip;
    while (rkpm_goes_on(problem.rkpm) && !rkpm_advance(problem.rkpm).is_stopped)
        continue;
    /* J E_0 = 5 - 4 exp(-t/5): the retardation time is that of relaxation times E_0/E_inf */
    check_near(words, problem.rkpm->tip / at_once / (5 - 4 * exp(-2)), 1, bound);
    close_problem(&problem);
}

static void check_threads(const char *block)
{
    const int threads = threads_available();
    double tip[3];
    for (int run = 0; run < 3; run++) {
        threads_set(run == 0 ? 1 : run == 1 ? 2 : 5);
        struct problem problem;
        open_problem(&problem, block);
        while (rkpm_goes_on(problem.rkpm) && !rkpm_advance(problem.rkpm).is_stopped)
            continue;
        tip[run] = problem.rkpm->tip;
        close_problem(&problem);
    }
    check_true("the same bits on 1, 2 and 5 threads", tip[0] == tip[1] && tip[0] == tip[2] && tip[0] != 0);
    threads_set(threads);
}

int main(void)
{
    begin_with_threads(5);
    check_creep_point(MAXWELL_MIDPOINT, false, 7.995008703e-6, -3.597504351e-6, 1e-4);
    check_creep_point(MAXWELL_EXPONENTIAL, false, 7.995008703e-6, -3.597504351e-6, 1e-4);
    /* with all moduli relaxing alike Poisson's ratio stays */
    check_creep_point(MAXWELL_MIDPOINT, true, 8.91731773e-6, -0.3 * 8.91731773e-6, 1e-4);
    check_jump();
    check_steps();
    check_scaling("dime 2 node box 0 4 0 1 9 3 supp 1.75", 1e-5);
    check_scaling("dime 2 node box 0 4 0 1 9 3 supp 1.75 plan strain cons lagr", 1e-5);
    check_scaling("dime 2 node box 0 4 0 1 9 3 supp 1.75 inte nsci", 1e-5);
    check_scaling("dime 3 node box 0 4 0 1 0 1 5 3 3 supp 1.75 inte nsni", 1e-5);
    check_scaling("dime 2 node box 0 4 0 1 9 3 supp 1.75 rule midpoint", 1e-4);
    check_threads("dime 2 node box 0 4 0 1 33 9 supp 1.75 inte nsci prob creep func load forc 1 modu 1 0.3 elem 4 1 held x0 span 1 0.2 from 0 1");
    return check_result();
}
