/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "particles/results.h"
#include "base/tensor.h"
#include "material/law.h"

#include <math.h>
#include <strings.h>

#define REAL(source, column, component) ((source)->store->real[column][component][p])

static double von_mises(const struct result_source *s, size_t p)
{
    if (store_has(s->store, COLUMN_EQUIVALENT_STRESS))
        return REAL(s, COLUMN_EQUIVALENT_STRESS, 0);
    return tensor_von_mises(REAL(s, COLUMN_STRESS, 0), REAL(s, COLUMN_STRESS, 1), REAL(s, COLUMN_STRESS, 2),
                            REAL(s, COLUMN_STRESS, 3), REAL(s, COLUMN_STRESS, 4), REAL(s, COLUMN_STRESS, 5));
}

static double plastic_strain(const struct result_source *s, size_t p)
{
    return store_has(s->store, COLUMN_PLASTIC_STRAIN) ? REAL(s, COLUMN_PLASTIC_STRAIN, 0) : 0;
}

static double material(const struct result_source *s, size_t p)
{
    return s->body_material_number[s->store->integer[COLUMN_BODY][p]];
}

static double pressure(const struct result_source *s, size_t p)
{
    return store_pressure(s->store, p);
}

static double volume(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_VOLUME, 0);
}

static double kinetic_energy(const struct result_source *s, size_t p)
{
    double x = REAL(s, COLUMN_VELOCITY, 0), y = REAL(s, COLUMN_VELOCITY, 1), z = REAL(s, COLUMN_VELOCITY, 2);
    return 0.5 * REAL(s, COLUMN_MASS, 0) * (x * x + y * y + z * z);
}

static double internal_energy(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_ENERGY, 0);
}

static double velocity_x(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_VELOCITY, 0);
}

static double velocity_y(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_VELOCITY, 1);
}

static double speed(const struct result_source *s, size_t p)
{
    double *const *v = s->store->real[COLUMN_VELOCITY];
    return sqrt(v[0][p] * v[0][p] + v[1][p] * v[1][p] + v[2][p] * v[2][p]);
}

static double velocity_z(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_VELOCITY, 2);
}

static double temperature(const struct result_source *s, size_t p)
{
    return store_has(s->store, COLUMN_TEMPERATURE) ? REAL(s, COLUMN_TEMPERATURE, 0)
                                                   : column_row(COLUMN_TEMPERATURE)->initial;
}

static double failed(const struct result_source *s, size_t p)
{
    return store_has(s->store, COLUMN_FAILED) ? REAL(s, COLUMN_FAILED, 0) : 0;
}

static double damage(const struct result_source *s, size_t p)
{
    return store_has(s->store, COLUMN_DAMAGE) ? REAL(s, COLUMN_DAMAGE, 0) : 0;
}

static double sound_speed(const struct result_source *s, size_t p)
{
    return s->body_material[s->store->integer[COLUMN_BODY][p]]->viscous_speed;
}

static double stress_xx(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_STRESS, 0);
}

static double stress_yy(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_STRESS, 1);
}

static double stress_zz(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_STRESS, 2);
}

static double stress_yz(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_STRESS, 3);
}

static double stress_xz(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_STRESS, 4);
}

static double stress_xy(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_STRESS, 5);
}

static double displacement_x(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_POSITION, 0) - REAL(s, COLUMN_INITIAL_POSITION, 0);
}

static double displacement_y(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_POSITION, 1) - REAL(s, COLUMN_INITIAL_POSITION, 1);
}

static double displacement_z(const struct result_source *s, size_t p)
{
    return REAL(s, COLUMN_POSITION, 2) - REAL(s, COLUMN_INITIAL_POSITION, 2);
}

static double heat_of_wall(const struct result_source *s, size_t p)
{
    return s->body_heat[s->store->integer[COLUMN_BODY][p]];
}

/* Of the stress whose divergence is in balance: with residual stress taken off. */
static double von_mises_total(const struct result_source *s, size_t p)
{
    double stress[6];
    if (!store_has(s->store, COLUMN_RESIDUAL))
        return von_mises(s, p);
    for (int a = 0; a < 6; a++)
        stress[a] = REAL(s, COLUMN_STRESS, a) - REAL(s, COLUMN_RESIDUAL, a);
    return tensor_von_mises(stress[0], stress[1], stress[2], stress[3], stress[4], stress[5]);
}

static double layer(const struct result_source *s, size_t p)
{
    return s->store->integer[COLUMN_LAYER][p] + 1;
}

static double is_open(const struct result_source *s, size_t p)
{
    return !result_is_closed(s, p);
}

#define COLUMN_VALUE(name, column) \
    static double name(const struct result_source *s, size_t p) \
    { \
        return REAL(s, column, 0); \
    }

COLUMN_VALUE(density, COLUMN_DENSITY)
COLUMN_VALUE(reference_density, COLUMN_REFERENCE_DENSITY)
COLUMN_VALUE(smoothing_length, COLUMN_SMOOTHING_LENGTH)
COLUMN_VALUE(viscosity, COLUMN_VISCOSITY)
COLUMN_VALUE(enthalpy, COLUMN_ENTHALPY)
COLUMN_VALUE(liquid, COLUMN_LIQUID)
COLUMN_VALUE(curvature, COLUMN_CURVATURE)
COLUMN_VALUE(laser_power, COLUMN_LASER_POWER)
COLUMN_VALUE(coefficient, COLUMN_COEFFICIENT)
COLUMN_VALUE(field, COLUMN_FIELD)
COLUMN_VALUE(exact, COLUMN_EXACT)

static double state(const struct result_source *s, size_t p)
{
    return s->store->integer[COLUMN_STATE][p];
}

static double fused(const struct result_source *s, size_t p)
{
    return s->store->integer[COLUMN_FUSED][p];
}

static double parted(const struct result_source *s, size_t p)
{
    return s->store->integer[COLUMN_PARTED][p];
}

static const struct result rows[] = {
    {.name = "seqv", .methods = METHODS_MPM | METHODS_DYNAMIC, .unit = "stress", .doc = "von Mises stress", .value = von_mises},
    {.name = "seqt", .methods = METHODS_MPM, .unit = "stress", .doc = "von Mises stress of the total: with the residual stress of resi taken off",
     .value = von_mises_total},
    {.name = "laye", .methods = METHODS_MPM, .doc = "layer of the build", .is_integer = true, .columns = {COLUMN_LAYER}, .value = layer},
    {.name = "ghos", .methods = METHODS_MPM, .doc = "1 where the particle is open, 0 where it is closed", .is_integer = true, .value = is_open},
    {.name = "epef", .methods = METHODS_MPM, .doc = "effective plastic strain", .value = plastic_strain},
    {.name = "mat", .methods = METHODS_PARTICLES, .doc = "material number", .is_integer = true, .value = material},
    {.name = "pres", .methods = METHODS_TIMED, .unit = "stress", .doc = "pressure, minus the mean stress", .value = pressure},
    {.name = "volu", .methods = METHODS_TIMED, .unit = "length^3", .doc = "present volume", .value = volume},
    {.name = "vol", .methods = METHODS_TIMED, .unit = "length^3", .doc = "the same as volu", .value = volume},
    {.name = "engk", .methods = METHODS_TIMED, .unit = "energy", .doc = "kinetic energy; in a curve of all particles",
     .total = TOTAL_KINETIC, .value = kinetic_energy},
    {.name = "engi", .unit = "energy", .doc = "internal energy; in a curve of all particles",
     .methods = METHODS_MPM | METHODS_DYNAMIC, .total = TOTAL_INTERNAL, .value = internal_energy},
    {.name = "velx", .methods = METHODS_TIMED, .unit = "length/time", .doc = "velocity along x", .value = velocity_x},
    {.name = "vely", .methods = METHODS_TIMED, .unit = "length/time", .doc = "velocity along y", .value = velocity_y},
    {.name = "velz", .methods = METHODS_TIMED, .unit = "length/time", .doc = "velocity along z", .value = velocity_z},
    {.name = "spee", .methods = METHODS_TIMED, .unit = "length/time", .doc = "speed", .value = speed},
    {.name = "cels", .methods = METHODS_PARTICLES, .unit = "temperature", .doc = "temperature", .value = temperature},
    {.name = "fail", .methods = METHODS_MPM, .doc = "1 where the material failed", .is_integer = true, .value = failed},
    {.name = "sspd", .methods = METHODS_MPM, .unit = "length/time", .doc = "sound speed of the artificial viscosity", .value = sound_speed},
    {.name = "damg", .methods = METHODS_MPM, .doc = "damage", .value = damage},
    {.name = "stsx", .methods = METHODS_MPM | METHODS_DYNAMIC, .unit = "stress", .doc = "stress xx", .value = stress_xx},
    {.name = "stsy", .methods = METHODS_MPM | METHODS_DYNAMIC, .unit = "stress", .doc = "stress yy", .value = stress_yy},
    {.name = "stsz", .methods = METHODS_MPM | METHODS_DYNAMIC, .unit = "stress", .doc = "stress zz", .value = stress_zz},
    {.name = "styz", .methods = METHODS_MPM | METHODS_DYNAMIC, .unit = "stress", .doc = "stress yz", .value = stress_yz},
    {.name = "stxz", .methods = METHODS_MPM | METHODS_DYNAMIC, .unit = "stress", .doc = "stress xz", .value = stress_xz},
    {.name = "stxy", .methods = METHODS_MPM | METHODS_DYNAMIC, .unit = "stress", .doc = "stress xy", .value = stress_xy},
    {.name = "disx", .methods = METHODS_PARTICLES | METHODS_RKPM, .unit = "length", .doc = "displacement along x",
     .columns = {COLUMN_INITIAL_POSITION}, .value = displacement_x},
    {.name = "disy", .methods = METHODS_PARTICLES | METHODS_RKPM, .unit = "length", .doc = "displacement along y",
     .columns = {COLUMN_INITIAL_POSITION}, .value = displacement_y},
    {.name = "disz", .methods = METHODS_PARTICLES | METHODS_RKPM, .unit = "length", .doc = "displacement along z",
     .columns = {COLUMN_INITIAL_POSITION}, .value = displacement_z},
#define SPH .methods = METHODS_SPH
    {.name = "dens", .unit = "mass/length^3", .doc = "density", SPH, .columns = {COLUMN_DENSITY}, .value = density},
    {.name = "rho0", .unit = "mass/length^3", .doc = "density without pressure at the present temperature", SPH,
     .columns = {COLUMN_REFERENCE_DENSITY}, .value = reference_density},
    {.name = "hsml", .unit = "length", .doc = "smoothing length h", SPH, .columns = {COLUMN_SMOOTHING_LENGTH},
     .value = smoothing_length},
    {.name = "visc", .unit = "stress*time", .doc = "dynamic viscosity", SPH, .columns = {COLUMN_VISCOSITY}, .value = viscosity},
    {.name = "stat", .doc = "state: 0 fluid, 1 solid, 2 wall, 3 removed", .is_integer = true, SPH, .columns = {COLUMN_STATE},
     .value = state},
    {.name = "liqu", .doc = "liquid fraction", SPH, .columns = {COLUMN_LIQUID}, .value = liquid},
    {.name = "fuse", .doc = "1 where it has been melt, at least half liquid, since the start; with heat", .is_integer = true, SPH,
     .columns = {COLUMN_FUSED}, .value = fused},
    {.name = "part", .doc = "1 where it came off and hangs together with no metal any more, 2 in a thread of single particles; with ejec", .is_integer = true,
     SPH, .columns = {COLUMN_PARTED}, .value = parted},
    {.name = "enth", .unit = "energy/mass", .doc = "specific enthalpy, 0 at 293; with heat", SPH, .columns = {COLUMN_ENTHALPY},
     .value = enthalpy},
    {.name = "kapp", .unit = "1/length", .doc = "curvature of the surface, positive on a drop; with csf", SPH,
     .columns = {COLUMN_CURVATURE}, .value = curvature},
    {.name = "lasr", .unit = "power", .doc = "power taken from the beam; with beam", SPH, .columns = {COLUMN_LASER_POWER},
     .value = laser_power},
    {.name = "wflu", .unit = "power", .doc = "heat that comes in from the wall of given temperature that the particle belongs to; 0 for "
                                             "particles of others; with heat", SPH, .value = heat_of_wall},
#undef SPH
    {.name = "fiel", .methods = METHODS_PROBLEM, .doc = "solution at a node", .columns = {COLUMN_FIELD}, .value = field},
    {.name = "coef", .methods = METHODS_PROBLEM, .doc = "coefficient of a node's shape function, which is not the value there", .columns = {COLUMN_COEFFICIENT},
     .value = coefficient},
    {.name = "exac", .methods = METHODS_PROBLEM, .doc = "exact solution at a node", .columns = {COLUMN_EXACT}, .value = exact},
    {.name = "momx", .unit = "mass*length/time", .doc = "momentum along x", .total = TOTAL_MOMENTUM_X},
    {.name = "momy", .unit = "mass*length/time", .doc = "momentum along y", .total = TOTAL_MOMENTUM_Y},
    {.name = "momz", .unit = "mass*length/time", .doc = "momentum along z", .total = TOTAL_MOMENTUM_Z},
#define SPH .total_methods = METHODS_SPH, .total
    {.name = "heat", .unit = "energy", .doc = "enthalpy", SPH = TOTAL_HEAT},
    {.name = "lasi", .unit = "energy", .doc = "energy of the beam since the start", SPH = TOTAL_LASER_IN},
    {.name = "absb", .unit = "energy", .doc = "part of it that was absorbed", SPH = TOTAL_ABSORBED},
    {.name = "refl", .unit = "energy", .doc = "part of it that was reflected", SPH = TOTAL_REFLECTED},
    {.name = "tran", .unit = "energy", .doc = "part of it that met nothing", SPH = TOTAL_TRANSMITTED},
    {.name = "radi", .unit = "energy", .doc = "energy radiated since the start", SPH = TOTAL_RADIATED},
    {.name = "evap", .unit = "energy", .doc = "energy that evaporation took since the start", SPH = TOTAL_EVAPORATED},
    {.name = "thru", .unit = "energy", .doc = "heat that came in from walls of given temperature since the start", SPH = TOTAL_THROUGH_WALLS},
    {.name = "vish", .unit = "energy", .doc = "heat of viscosity since the start", SPH = TOTAL_VISCOUS_HEAT},
    {.name = "powh", .unit = "energy", .doc = "heat of powe since the start", SPH = TOTAL_VOLUME_HEAT},
    {.name = "tmax", .unit = "temperature", .doc = "highest temperature", SPH = TOTAL_HOTTEST},
    {.name = "umax", .unit = "length/time", .doc = "highest speed of fluid", SPH = TOTAL_FASTEST},
    {.name = "remo", .doc = "particles that left the grid or were removed by ejec since the start", SPH = TOTAL_REMOVED},
    {.name = "deta", .doc = "particles that hang together neither with solids nor walls; without those, with the largest piece", SPH = TOTAL_DETACHED},
    {.name = "pool", .unit = "length", .doc = "length of the melt pool along x; with ejec without drops in flight", SPH = TOTAL_POOL_LENGTH},
    {.name = "poow", .unit = "length", .doc = "width of the melt pool along y; 0 in two dimensions", SPH = TOTAL_POOL_WIDTH},
    {.name = "pood", .unit = "length", .doc = "height of the melt pool along z, in two dimensions along y", SPH = TOTAL_POOL_DEPTH},
#define FUSED .columns = {COLUMN_FUSED, COLUMN_INITIAL_POSITION}
    {.name = "fusl", .unit = "length", .doc = "length along x of the zone, at its place at the start, that has been melt", FUSED,
     SPH = TOTAL_FUSED_LENGTH},
    {.name = "fusw", .unit = "length", .doc = "its width along y; 0 in two dimensions", FUSED, SPH = TOTAL_FUSED_WIDTH},
    {.name = "pene", .unit = "length", .doc = "penetration: how far below `base` it reaches", FUSED, SPH = TOTAL_PENETRATION},
    {.name = "roug", .unit = "length", .doc = "roughness of the track: the top of what has been melt, along x, its highest less its lowest; with ejec without drops in flight",
     FUSED, SPH = TOTAL_ROUGHNESS},
#undef FUSED
#undef SPH
#define DYNAMIC .total_methods = METHODS_DYNAMIC, .total
    {.name = "widt", .unit = "length", .doc = "width of the body along x: extent of its nodes and a spacing", DYNAMIC = TOTAL_WIDTH},
    {.name = "top", .unit = "length", .doc = "its highest node, above along the wall's axis, and half a spacing", DYNAMIC = TOTAL_TOP},
    {.name = "bott", .unit = "length", .doc = "its lowest node less half a spacing", DYNAMIC = TOTAL_BOTTOM},
    {.name = "cenx", .unit = "length", .doc = "centre of mass along x", DYNAMIC = TOTAL_CENTRE_X},
    {.name = "ceny", .unit = "length", .doc = "centre of mass along y", DYNAMIC = TOTAL_CENTRE_Y},
    {.name = "cenz", .unit = "length", .doc = "centre of mass along z", DYNAMIC = TOTAL_CENTRE_Z},
    {.name = "mvex", .unit = "length/time", .doc = "mean velocity along x: momentum over mass", DYNAMIC = TOTAL_MEAN_VELOCITY_X},
    {.name = "mvey", .unit = "length/time", .doc = "mean velocity along y", DYNAMIC = TOTAL_MEAN_VELOCITY_Y},
    {.name = "mvez", .unit = "length/time", .doc = "mean velocity along z", DYNAMIC = TOTAL_MEAN_VELOCITY_Z},
    {.name = "angm", .unit = "mass*length^2/time", .doc = "angular momentum about z through the centre of mass", DYNAMIC = TOTAL_ANGULAR},
    {.name = "turn", .doc = "angle by which nodes have turned about z through the centre of mass, on the average, -pi to pi", DYNAMIC = TOTAL_TURN},
    {.name = "jmin", .doc = "least volume of a node over its volume at the start", DYNAMIC = TOTAL_LEAST_RATIO},
    {.name = "jmax", .doc = "largest volume of a node over its volume at the start", DYNAMIC = TOTAL_MOST_RATIO},
    {.name = "wall", .unit = "force", .doc = "force of the wall on the body along the wall's axis", DYNAMIC = TOTAL_WALL_FORCE},
    {.name = "engw", .unit = "energy", .doc = "energy in the springs of the wall", DYNAMIC = TOTAL_WALL_ENERGY},
    {.name = "fewn", .doc = "points with too few neighbours for linear functions in the last step", DYNAMIC = TOTAL_FEW_NEIGHBOURS},
#undef DYNAMIC
};

const struct result *result_rows(int *count)
{
    *count = sizeof rows / sizeof rows[0];
    return rows;
}

const struct result *result_find(const char *name)
{
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (strncasecmp(name, rows[i].name, 4) == 0)
            return &rows[i];
    return NULL;
}
