/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Properties of a material that melts, as functions of temperature: tables with straight lines between their rows
 * and constant beyond them, and the enthalpy that follows (spec am-sph 8.2, 10). */
#ifndef MATERIAL_PROPERTIES_H
#define MATERIAL_PROPERTIES_H

#include <stdbool.h>
#include <stddef.h>

enum property {
    PROPERTY_DENSITY,
    PROPERTY_VISCOSITY,
    PROPERTY_CAPACITY,     /* specific heat without latent heat */
    PROPERTY_CONDUCTIVITY,
    PROPERTY_SURFACE_TENSION,
    PROPERTY_ABSORPTIVITY,
    PROPERTY_COUNT
};

/* Temperatures increase; count 0: the property was not given. */
struct property_table {
    size_t count, capacity;
    double *temperatures, *values;
    bool goes_on; /* beyond the last row along its last line, else constant */
};

/* Sahoo, DebRoy and McNallan (1988), with a surface-active element: reference tension at the melting point of the
 * pure metal, -d/dT, surface excess at saturation, entropy factor, activity, heat of segregation. */
struct surface_formula {
    bool is_given;
    double tension, slope, melting_point, excess, entropy_factor, activity, segregation;
};

struct properties {
    bool is_given;
    struct property_table tables[PROPERTY_COUNT];
    struct surface_formula surface;
    bool melts;
    double solidus, liquidus, latent_heat;
    bool boils;
    double boiling_point, vaporisation_heat, molar_mass;
    /* Made by properties_prepare: enthalpy at the temperatures where its slope has kinks. */
    size_t n_kinks;
    double *kink_temperatures, *kink_enthalpies, *kink_capacities[2]; /* apparent capacity just above, and how it grows from there */
    double lowest_capacity; /* below the first kink */
    char message[120];      /* what properties_prepare found wrong */
};

/* The word of a property in decks, its unit and what it is, for help and messages. */
struct property_row {
    const char *name, *unit, *doc;
    bool is_positive; /* else: not negative */
};
const struct property_row *property_row(enum property property);

/* Value of a table at a temperature, and its slope there (that of the line above at a row). */
double property_value(const struct property_table *table, double temperature);
double property_slope(const struct property_table *table, double temperature);

/* Surface tension, at least SURFACE_LEAST, and its slope: 0 where the floor holds. */
double properties_surface_tension(const struct properties *properties, double temperature);
double properties_surface_slope(const struct properties *properties, double temperature);

/* Tables the enthalpy; call once after the tables are complete (capacity has to be given). Returns NULL, or what is
 * wrong: the text lives as long as `properties`. */
const char *properties_prepare(struct properties *properties);

/* Frees the tables and what properties_prepare made. */
void properties_close(struct properties *properties);

/* Specific enthalpy, 0 at PROPERTIES_ZERO, with latent heat spread evenly from solidus to liquidus; and back. */
double properties_enthalpy(const struct properties *properties, double temperature);
double properties_temperature(const struct properties *properties, double enthalpy);

/* Slope of the enthalpy: specific heat, with the latent heat over the melting range between solidus and liquidus. */
double properties_capacity(const struct properties *properties, double temperature);

/* The least of the rows of the specific heat, without latent heat; infinite where it was not given. */
double properties_least_capacity(const struct properties *properties);

/* Liquid fraction: 0 below the solidus, 1 above the liquidus, linear between; 1 where nothing melts. */
double properties_liquid(const struct properties *properties, double temperature);

/* Vapour pressure over the liquid (Clausius-Clapeyron) at an ambient pressure. */
double properties_vapour_pressure(const struct properties *properties, double temperature, double ambient_pressure);

#define PROPERTIES_ZERO 293.0
#define PROPERTIES_GAS_CONSTANT 8.3145
#define SURFACE_LEAST 0.05

#endif
