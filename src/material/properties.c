/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "material/properties.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>

/* Below this temperature the formulas with 1/T are taken at it. */
static const double COLDEST = 1;
/* exp of more than this is so large that ln(1 + exp x) = x. */
static const double LARGEST_EXPONENT = 40;

static const struct property_row rows[PROPERTY_COUNT] = {
    [PROPERTY_DENSITY] = {"dens", "mass/length^3", "density without pressure", true},
    [PROPERTY_VISCOSITY] = {"visc", "stress*time", "dynamic viscosity", false},
    [PROPERTY_CAPACITY] = {"capa", "energy/(mass*temperature)", "specific heat without latent heat", true},
    [PROPERTY_CONDUCTIVITY] = {"cond", "power/(length*temperature)", "heat conductivity", false},
    [PROPERTY_SURFACE_TENSION] = {"surf", "force/length", "surface tension", false},
    [PROPERTY_ABSORPTIVITY] = {"abso", NULL, "part of the beam's power that is not reflected", false},
};

const struct property_row *property_row(enum property property)
{
    return &rows[property];
}

/* --- tables --- */

/* The last row at or below a value that is not below the first. */
static size_t row_below(const double *values, size_t count, double value)
{
    size_t low = 0, high = count;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (values[middle] <= value)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Slope of the line from row i to the next. */
static double line_slope(const struct property_table *table, size_t i)
{
    return (table->values[i + 1] - table->values[i]) / (table->temperatures[i + 1] - table->temperatures[i]);
}

/* Where the line of a temperature starts, and its slope; false below the first row or in an empty table. */
static bool find_line(const struct property_table *table, double temperature, size_t *row, double *slope)
{
    const size_t count = table->count;
    if (count == 0 || !(temperature >= table->temperatures[0]))
        return false;
    *row = row_below(table->temperatures, count, temperature);
    if (*row + 1 < count)
        *slope = line_slope(table, *row);
    else
        *slope = table->goes_on && count > 1 ? line_slope(table, count - 2) : 0;
    return true;
}

double property_value(const struct property_table *table, double temperature)
{
    size_t row;
    double slope;
    if (!find_line(table, temperature, &row, &slope))
        return table->count ? table->values[0] : 0;
    return table->values[row] + slope * (temperature - table->temperatures[row]);
}

double property_slope(const struct property_table *table, double temperature)
{
    size_t row;
    double slope;
    return find_line(table, temperature, &row, &slope) ? slope : 0;
}

/* --- surface tension --- */

/* Part of the surface's sites that the active element takes, and ln(1 + K a) (spec 10). */
static double adsorption(const struct surface_formula *formula, double temperature, double *logarithm)
{
    const double x = log(formula->entropy_factor * formula->activity)
                   - formula->segregation / (PROPERTIES_GAS_CONSTANT * temperature);
    *logarithm = x > LARGEST_EXPONENT ? x : log1p(exp(x));
    return 1 / (1 + exp(-x));
}

static double formula_tension(const struct surface_formula *formula, double temperature)
{
    double logarithm;
    const double t = fmax(temperature, COLDEST);
    adsorption(formula, t, &logarithm);
    return formula->tension - formula->slope * (t - formula->melting_point)
         - PROPERTIES_GAS_CONSTANT * t * formula->excess * logarithm;
}

static double formula_slope(const struct surface_formula *formula, double temperature)
{
    double logarithm;
    const double t = fmax(temperature, COLDEST), covered = adsorption(formula, t, &logarithm);
    return -formula->slope - PROPERTIES_GAS_CONSTANT * formula->excess * logarithm
         - covered * formula->excess * formula->segregation / t;
}

static double free_tension(const struct properties *properties, double temperature)
{
    return properties->surface.is_given ? formula_tension(&properties->surface, temperature)
                                        : property_value(&properties->tables[PROPERTY_SURFACE_TENSION], temperature);
}

double properties_surface_tension(const struct properties *properties, double temperature)
{
    return fmax(free_tension(properties, temperature), SURFACE_LEAST);
}

double properties_surface_slope(const struct properties *properties, double temperature)
{
    if (free_tension(properties, temperature) < SURFACE_LEAST)
        return 0;
    return properties->surface.is_given ? formula_slope(&properties->surface, temperature)
                                        : property_slope(&properties->tables[PROPERTY_SURFACE_TENSION], temperature);
}

/* --- melting and boiling --- */

double properties_liquid(const struct properties *properties, double temperature)
{
    if (!properties->melts)
        return 1;
    const double part = (temperature - properties->solidus) / (properties->liquidus - properties->solidus);
    return part > 1 ? 1 : part > 0 ? part : 0;
}

double properties_vapour_pressure(const struct properties *properties, double temperature, double ambient_pressure)
{
    if (!properties->boils)
        return 0;
    const double scale = properties->molar_mass * properties->vaporisation_heat / PROPERTIES_GAS_CONSTANT;
    return ambient_pressure * exp(scale * (1 / properties->boiling_point - 1 / fmax(temperature, COLDEST)));
}

/* --- enthalpy --- */

double properties_enthalpy(const struct properties *properties, double temperature)
{
    if (temperature < properties->kink_temperatures[0])
        return properties->kink_enthalpies[0] + properties->lowest_capacity * (temperature - properties->kink_temperatures[0]);
    const size_t i = row_below(properties->kink_temperatures, properties->n_kinks, temperature);
    const double above = temperature - properties->kink_temperatures[i];
    return properties->kink_enthalpies[i]
         + above * (properties->kink_capacities[0][i] + 0.5 * properties->kink_capacities[1][i] * above);
}

double properties_temperature(const struct properties *properties, double enthalpy)
{
    if (enthalpy < properties->kink_enthalpies[0])
        return properties->kink_temperatures[0] + (enthalpy - properties->kink_enthalpies[0]) / properties->lowest_capacity;
    const size_t i = row_below(properties->kink_enthalpies, properties->n_kinks, enthalpy);
    const double rest = enthalpy - properties->kink_enthalpies[i], capacity = properties->kink_capacities[0][i];
    /* the root of capacity y + growth y^2/2 = rest, in the form that has no difference of near numbers */
    const double root = sqrt(capacity * capacity + 2 * properties->kink_capacities[1][i] * rest);
    return properties->kink_temperatures[i] + 2 * rest / (capacity + root);
}

double properties_capacity(const struct properties *properties, double temperature)
{
    if (temperature < properties->kink_temperatures[0])
        return properties->lowest_capacity;
    const size_t i = row_below(properties->kink_temperatures, properties->n_kinks, temperature);
    return properties->kink_capacities[0][i]
         + properties->kink_capacities[1][i] * (temperature - properties->kink_temperatures[i]);
}

double properties_least_capacity(const struct properties *properties)
{
    const struct property_table *table = &properties->tables[PROPERTY_CAPACITY];
    double least = INFINITY;
    for (size_t i = 0; i < table->count; i++)
        least = fmin(least, table->values[i]);
    return least;
}

/* Puts a temperature into the increasing list of kinks, once. */
static void add_kink(struct properties *properties, double temperature)
{
    double *kinks = properties->kink_temperatures;
    size_t i = properties->n_kinks;
    while (i > 0 && kinks[i - 1] >= temperature)
        i--;
    if (i < properties->n_kinks && kinks[i] == temperature)
        return;
    for (size_t k = properties->n_kinks; k > i; k--)
        kinks[k] = kinks[k - 1];
    kinks[i] = temperature;
    properties->n_kinks++;
}

static void find_kinks(struct properties *properties)
{
    const struct property_table *table = &properties->tables[PROPERTY_CAPACITY];
    double **const arrays[] = {&properties->kink_temperatures, &properties->kink_enthalpies,
                               &properties->kink_capacities[0], &properties->kink_capacities[1]};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        memory_free(*arrays[i]);
        *arrays[i] = memory_array(table->count + 2, sizeof(double), "enthalpy");
    }
    properties->n_kinks = 0;
    for (size_t i = 0; i < table->count; i++)
        add_kink(properties, table->temperatures[i]);
    if (properties->melts) {
        add_kink(properties, properties->solidus);
        add_kink(properties, properties->liquidus);
    }
}

/* Capacities by kink, with latent heat over the melting range (spec 8.3), then the enthalpy by summing up. */
static void sum_enthalpy(struct properties *properties)
{
    const struct property_table *table = &properties->tables[PROPERTY_CAPACITY];
    const double *t = properties->kink_temperatures;
    double *enthalpy = properties->kink_enthalpies;
    const double latent = properties->melts ? properties->latent_heat / (properties->liquidus - properties->solidus) : 0;
    properties->lowest_capacity = property_value(table, t[0]);
    for (size_t i = 0; i < properties->n_kinks; i++) {
        const bool in_range = properties->melts && t[i] >= properties->solidus && t[i] < properties->liquidus;
        properties->kink_capacities[0][i] = property_value(table, t[i]) + (in_range ? latent : 0);
        properties->kink_capacities[1][i] = property_slope(table, t[i]);
    }
    enthalpy[0] = 0;
    for (size_t i = 0; i + 1 < properties->n_kinks; i++) {
        const double width = t[i + 1] - t[i];
        enthalpy[i + 1] = enthalpy[i] + width * (properties->kink_capacities[0][i] + 0.5 * properties->kink_capacities[1][i] * width);
    }
    const double zero = properties_enthalpy(properties, PROPERTIES_ZERO);
    for (size_t i = 0; i < properties->n_kinks; i++)
        enthalpy[i] -= zero;
}

/* --- what may be wrong --- */

static const char *fault(struct properties *properties, enum property property, const char *what)
{
    snprintf(properties->message, sizeof properties->message, "%s (%s) %s", rows[property].doc, rows[property].name, what);
    return properties->message;
}

static const char *fault_of_melting(struct properties *properties)
{
    if (properties->latent_heat != 0 && !properties->melts)
        return "latent heat needs a solidus and a liquidus";
    if (!properties->melts)
        return NULL;
    if (!(properties->liquidus > properties->solidus))
        return "the liquidus has to be above the solidus";
    return properties->latent_heat >= 0 ? NULL : "the latent heat is negative";
}

/* A table that ends inside the melting range says nothing of the rest of it. */
static bool leaves_gap(const struct properties *properties, const struct property_table *table)
{
    const double first = table->temperatures[0], last = table->temperatures[table->count - 1];
    const bool starts_inside = first > properties->solidus && first < properties->liquidus;
    const bool ends_inside = last > properties->solidus && last < properties->liquidus && !table->goes_on;
    return properties->melts && table->count > 1 && (starts_inside || ends_inside);
}

static const char *fault_of_table(struct properties *properties, enum property property)
{
    const struct property_table *table = &properties->tables[property];
    for (size_t i = 0; i < table->count; i++) {
        const double value = table->values[i];
        if (!isfinite(table->temperatures[i]) || !isfinite(value))
            return fault(properties, property, "is not a number");
        if (i > 0 && !(table->temperatures[i] > table->temperatures[i - 1]))
            return fault(properties, property, "has temperatures that do not increase");
        if (rows[property].is_positive && !(value > 0))
            return fault(properties, property, "has to be positive");
        if (value < 0)
            return fault(properties, property, "is negative");
        if (property == PROPERTY_ABSORPTIVITY && value > 1)
            return fault(properties, property, "is more than 1");
    }
    if (table->count && property != PROPERTY_SURFACE_TENSION && property != PROPERTY_ABSORPTIVITY && leaves_gap(properties, table))
        return fault(properties, property, "has a table that leaves a gap between solidus and liquidus");
    if (property == PROPERTY_CAPACITY && table->goes_on && table->count > 1 && line_slope(table, table->count - 2) < 0)
        return fault(properties, property, "falls to 0 beyond its table");
    return NULL;
}

const char *properties_prepare(struct properties *properties)
{
    const char *wrong = fault_of_melting(properties);
    for (int i = 0; i < PROPERTY_COUNT && !wrong; i++)
        wrong = fault_of_table(properties, (enum property)i);
    if (!wrong && properties->tables[PROPERTY_CAPACITY].count == 0)
        wrong = fault(properties, PROPERTY_CAPACITY, "is missing");
    if (wrong)
        return wrong;
    find_kinks(properties);
    sum_enthalpy(properties);
    return NULL;
}

void properties_close(struct properties *properties)
{
    double **const arrays[] = {&properties->kink_temperatures, &properties->kink_enthalpies,
                               &properties->kink_capacities[0], &properties->kink_capacities[1]};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        memory_free(*arrays[i]);
        *arrays[i] = NULL;
    }
    properties->n_kinks = 0;
    for (int i = 0; i < PROPERTY_COUNT; i++) {
        memory_free(properties->tables[i].temperatures);
        memory_free(properties->tables[i].values);
        properties->tables[i] = (struct property_table){0};
    }
}
