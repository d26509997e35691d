/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Beds of powder: grains lie on the floor, touch and stay between the ends. */
#include "check.h"
#include "particles/bed.h"

#include <math.h>

enum { MOST = 200 };

static long collect(struct bed bed, struct grain *grains)
{
    long count = 0;
    while (count < MOST && bed_next(&bed, &grains[count]))
        count++;
    return count;
}

static void test_row(void)
{
    struct grain all[MOST], third[MOST];
    struct bed bed = {.x = {-1, 9}, .floor = 0.5, .least = 0.1, .most = 0.3, .seed = 4, .pick = 1, .among = 1, .is_flat = true};
    const long count = collect(bed, all);
    double gap = 0, least = 1, most = 0;
    bool lie = count > 0;
    for (long i = 0; i < count; i++) {
        const struct grain *g = &all[i];
        lie = lie && fabs(g->centre[1] - 0.5 - g->radius) < 1e-15 && g->centre[0] - g->radius >= -1 - 1e-12 && g->centre[0] + g->radius <= 9 + 1e-8;
        least = fmin(least, g->radius);
        most = fmax(most, g->radius);
        if (i > 0)
            gap = fmax(gap, fabs(hypot(g->centre[0] - all[i - 1].centre[0], g->centre[1] - all[i - 1].centre[1]) - g->radius - all[i - 1].radius));
    }
    check_true("a row lies on its floor between its ends", lie);
    check_near("its grains touch", gap, 0, 1e-12);
    check_true("radii are drawn between both", least >= 0.1 && least < 0.14 && most <= 0.3 && most > 0.26);
    check_true("it is as long as it can be", 9 - all[count - 1].centre[0] - all[count - 1].radius < 0.6);
    bed.pick = 2;
    bed.among = 3;
    const long picked = collect(bed, third);
    bool are_same = picked == (count + 1) / 3;
    for (long i = 0; i < picked; i++)
        are_same = are_same && third[i].centre[0] == all[3 * i + 1].centre[0] && third[i].radius == all[3 * i + 1].radius;
    check_true("pick takes some of the same grains", are_same);
    bed = (struct bed){.x = {-1, 9}, .least = 0.1, .most = 0.3, .seed = 5, .pick = 1, .among = 1, .is_flat = true};
    collect(bed, third);
    check_true("another seed draws other radii", third[3].radius != all[3].radius);
}

static void test_rows(void)
{
    struct grain grains[MOST];
    const struct bed bed = {.x = {0, 6}, .y = {0, 4}, .floor = 0, .least = 0.5, .most = 0.5, .seed = 1, .pick = 1, .among = 1};
    const long count = collect(bed, grains);
    double sum[3] = {0};
    for (long i = 0; i < count; i++)
        for (int a = 0; a < 3; a++)
            sum[a] += grains[i].centre[a] / (double)count;
    check_near("equal balls fill the rows", (double)count, 24, 0);
    check_near("evenly along x", sum[0], 3, 1e-12);
    check_near("evenly along y", sum[1], 2, 1e-12);
    check_near("and lie on the floor", sum[2], 0.5, 1e-12);
}

int main(void)
{
    test_row();
    test_rows();
    return check_result();
}
