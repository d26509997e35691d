/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Properties of a melting material: tables, enthalpy and back, surface tension, what is refused; and the file of steel
 * 304 in decks/sph against numbers that were computed from its formulas on their own (spec am-sph V24). */
#include "check.h"
#include "sph_fixture.h"

#include <stdlib.h>

/* A row of decks/sph/steel304.inc: `prop 1 NAME numbers`. */
static void take_row(struct properties *properties, const char *name, const double *n, size_t count)
{
    for (int i = 0; i < PROPERTY_COUNT; i++)
        if (strcmp(name, property_row((enum property)i)->name) == 0 && count == 1 + 2 * (size_t)n[0])
            fixture_table(properties, (enum property)i, (size_t)n[0], n + 1);
    if (strcmp(name, "sahu") == 0 && count == 7)
        properties->surface = (struct surface_formula){true, n[0], n[1], n[2], n[3], n[4], n[5], n[6]};
    if (strcmp(name, "melt") == 0 && count == 3) {
        properties->melts = true;
        properties->solidus = n[0], properties->liquidus = n[1], properties->latent_heat = n[2];
    }
    if (strcmp(name, "boil") == 0 && count == 3) {
        properties->boils = true;
        properties->boiling_point = n[0], properties->vaporisation_heat = n[1], properties->molar_mass = n[2];
    }
}

static bool read_steel(struct properties *properties)
{
    FILE *file = fopen("decks/sph/steel304.inc", "r");
    char line[400], name[20];
    int length;
    if (!file)
        return false;
    while (fgets(line, sizeof line, file)) {
        double numbers[40];
        size_t count = 0;
        if (sscanf(line, "prop 1 %19s%n", name, &length) != 1)
            continue;
        for (char *at = line + length, *end; count < 40; at = end) {
            numbers[count] = strtod(at, &end);
            if (end == at)
                break;
            count++;
        }
        take_row(properties, name, numbers, count);
    }
    return fclose(file) == 0;
}

/* Numbers of `steel-304` in the reference set of the specification. */
static const struct {
    double t, tension, slope, density, enthalpy;
} expected[] = {
    {293, 0.875728964, 0.000782351413, 8022.505, 0},
    {1000, 1.42881865, 0.000781664608, 7668.298, 502797.19},
    {1672, 1.8361437, 9.09945608e-05, 7331.626, 980703.43},
    {1700, 1.83780362, 2.81148399e-05, 7198.52125, 1074340.62},
    {1723, 1.83788251, -2.07996629e-05, 7085.5625, 1154800.35},
    {1760, 1.83574704, -9.32840886e-05, 6903.84625, 1286746.17},
    {1800, 1.83060398, -0.000162192196, 6821.1, 1359149.05},
    {2000, 1.77383872, -0.00037264926, 6681.1, 1546619.05},
    {2500, 1.5489648, -0.000484712196, 6331.1, 2015294.05},
    {3000, 1.30273178, -0.000496677559, 5981.1, 2483969.05},
    {4000, 0.804052418, -0.000499553682, 5281.1, 3421319.05},
    {5000, 0.304293753, -0.000499876571, 4581.1, 4358669.05},
};

static void test_steel(void)
{
    struct properties steel = {0};
    double tension = 0, slope = 0, density = 0, enthalpy = 0, back = 0, capacity = 0;
    check_true("steel 304: decks/sph/steel304.inc is read", read_steel(&steel));
    const char *wrong = properties_prepare(&steel);
    check_true("steel 304: it is complete", !wrong);
    for (size_t i = 0; !wrong && i < sizeof expected / sizeof expected[0]; i++) {
        const double t = expected[i].t, h = properties_enthalpy(&steel, t);
        tension = fmax(tension, fabs(properties_surface_tension(&steel, t) / expected[i].tension - 1));
        slope = fmax(slope, fabs(properties_surface_slope(&steel, t) / expected[i].slope - 1));
        density = fmax(density, fabs(property_value(&steel.tables[PROPERTY_DENSITY], t) / expected[i].density - 1));
        enthalpy = fmax(enthalpy, fabs(h - expected[i].enthalpy) / fmax(expected[i].enthalpy, 1));
        back = fmax(back, fabs(properties_temperature(&steel, h) - t));
        capacity = fmax(capacity, fabs((properties_enthalpy(&steel, t + 0.01) - properties_enthalpy(&steel, t - 0.01)) / 0.02
                                           / properties_capacity(&steel, t) - 1));
    }
    check_near("steel 304: surface tension", tension, 0, 1e-4);
    check_near("steel 304: its slope", slope, 0, 1e-4);
    check_near("steel 304: density", density, 0, 1e-4);
    check_near("steel 304: enthalpy", enthalpy, 0, 1e-4);
    check_near("steel 304: temperature back from the enthalpy", back, 0, 1e-9);
    check_near("steel 304: apparent capacity is the slope of the enthalpy", capacity, 0, 1e-6);
    check_true("steel 304: the slope of the tension changes sign at 1713.06 K",
               properties_surface_slope(&steel, 1713.0618) > 0 && properties_surface_slope(&steel, 1713.0619) < 0);
    check_near("steel 304: above 5610 K the tension is at its floor", properties_surface_tension(&steel, 5700), 0.05, 0);
    check_near("steel 304: and has no slope", properties_surface_slope(&steel, 5700), 0, 0);
    check_true("steel 304: a tension near 0 K is a number", isfinite(properties_surface_tension(&steel, 0)));
    check_near("steel 304: half is liquid in the middle", properties_liquid(&steel, 1723), 0.5, 1e-15);
    check_near("steel 304: vapour has the ambient pressure at the boiling point",
               properties_vapour_pressure(&steel, 3090, 101325), 101325, 1e-9);
    /* by hand: 0.0555 6.4e6/8.3145 (1/3090 - 1/3300) = 0.87978, e to that 2.41038 */
    check_near("steel 304: and more above it", properties_vapour_pressure(&steel, 3300, 101325) / 101325, 2.41038, 1e-4);
    properties_close(&steel);
}

/* Capacity that rises and falls in pieces, with the melting range across one of its rows: back and forth, and the
 * integral by small steps. */
static void test_general_enthalpy(void)
{
    struct properties p = {.melts = true, .solidus = 500, .liquidus = 700, .latent_heat = 3e4};
    double back = 0, sum = 0;
    fixture_table(&p, PROPERTY_CAPACITY, 4, (double[]){300, 100, 600, 400, 650, 50, 900, 80});
    p.tables[PROPERTY_CAPACITY].goes_on = true;
    check_true("enthalpy: a table of four rows", !properties_prepare(&p));
    for (double t = 100; t < 1200; t += 7.3)
        back = fmax(back, fabs(properties_temperature(&p, properties_enthalpy(&p, t)) - t));
    check_near("enthalpy: temperature back", back, 0, 1e-10);
    /* Midpoint sums are exact for pieces of straight lines whose ends are multiples of the step. */
    for (int i = 0; i < 1400; i++)
        sum += 0.5 * properties_capacity(&p, 400.25 + 0.5 * i);
    check_near("enthalpy: integral of the capacity", properties_enthalpy(&p, 1100) - properties_enthalpy(&p, 400), sum, 1e-6);
    /* by hand: 200 .. 400 over 100 K: 35000 from 500 to 600 K; 11250 to 650; 50 .. 56 over 50 K: 2650; 30000 latent */
    check_near("enthalpy: across the melting range", properties_enthalpy(&p, 700) - properties_enthalpy(&p, 500), 35000 + 11250 + 2650 + 30000, 1e-8);
    properties_close(&p);
}

static void test_tables(void)
{
    struct properties p = {0};
    fixture_table(&p, PROPERTY_DENSITY, 3, (double[]){100, 5, 200, 7, 400, 3});
    struct property_table *table = &p.tables[PROPERTY_DENSITY];
    check_near("tables: between rows", property_value(table, 300), 5, 1e-15);
    check_near("tables: constant below", property_value(table, 0), 5, 0);
    check_near("tables: constant above", property_value(table, 900), 3, 0);
    check_near("tables: slope of the line above a row", property_slope(table, 200), -0.02, 1e-16);
    check_near("tables: no slope above", property_slope(table, 500), 0, 0);
    table->goes_on = true;
    check_near("tables: one that goes on", property_value(table, 450), 2, 1e-14);
    check_near("tables: an empty one", property_value(&p.tables[PROPERTY_VISCOSITY], 300), 0, 0);
    properties_close(&p);
}

/* One fault each: what properties_prepare says has to contain `part`. */
static void check_fault(const char *name, const struct properties *melting, enum property property, size_t rows, const double *numbers,
                        const char *part)
{
    struct properties p = *melting;
    fixture_constant(&p, PROPERTY_DENSITY, 1);
    if (property != PROPERTY_CAPACITY)
        fixture_constant(&p, PROPERTY_CAPACITY, 1);
    memory_free(p.tables[property].temperatures);
    memory_free(p.tables[property].values);
    fixture_table(&p, property, rows, numbers);
    const char *wrong = properties_prepare(&p);
    check_true(name, wrong && strstr(wrong, part));
    properties_close(&p);
}

static void test_faults(void)
{
    const struct properties plain = {0}, melting = {.melts = true, .solidus = 10, .liquidus = 20};
    const struct properties unsaid = {.latent_heat = 1}, turned = {.melts = true, .solidus = 20, .liquidus = 20};
    check_fault("faults: temperatures do not increase", &plain, PROPERTY_DENSITY, 2, (double[]){5, 1, 5, 2}, "do not increase");
    check_fault("faults: no capacity", &plain, PROPERTY_CAPACITY, 0, NULL, "missing");
    check_fault("faults: density 0", &plain, PROPERTY_DENSITY, 1, (double[]){5, 0}, "positive");
    check_fault("faults: viscosity below 0", &plain, PROPERTY_VISCOSITY, 1, (double[]){5, -1}, "negative");
    check_fault("faults: absorptivity above 1", &plain, PROPERTY_ABSORPTIVITY, 1, (double[]){5, 1.1}, "more than 1");
    check_fault("faults: not a number", &plain, PROPERTY_CONDUCTIVITY, 1, (double[]){5, NAN}, "not a number");
    check_fault("faults: latent heat without melting", &unsaid, PROPERTY_DENSITY, 1, (double[]){5, 1}, "solidus");
    check_fault("faults: solidus not below liquidus", &turned, PROPERTY_DENSITY, 1, (double[]){5, 1}, "above the solidus");
    check_fault("faults: a gap in the melting range", &melting, PROPERTY_DENSITY, 2, (double[]){5, 1, 15, 2}, "gap");
}

int main(void)
{
    test_steel();
    test_general_enthalpy();
    test_tables();
    test_faults();
    return check_result();
}
