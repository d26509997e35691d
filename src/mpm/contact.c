/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of components on the nodes that they share (spec 9.1): each pair of components keeps its
 * own velocity field where it parts, and exchanges a force where it closes.
 *
 * The velocities that strain the points of musl and usf come from points and know nothing of that force:
 * with `cont ... join` they are made one along the normal on the nodes where there is a force, closing or
 * parting, as the corrected velocities with which usl strains are (with only the closing ones joined the
 * energy that the points get back in parting is more than what pressed them). */
#include "base/memory.h"
#include "mpm/mpm.h"

#include <math.h>

static const double TINY = 2.2e-16;

/* Two blocks of nodes at one place, of different components. */
struct contact_pair {
    int32_t first, second;
    double force[3]; /* on the pair in this step */
    uint64_t is_touching, is_sticking; /* bits of the nodes with a force in this step, and of those where nothing slides */
};

struct contact {
    struct contact_pair *pairs;
    size_t n_pairs, capacity;
    long version; /* of the cell list */
};

void contact_open(struct mpm *mpm)
{
    if (mpm->scene->contact != CONTACT_NONE)
        mpm->contact = memory_array(1, sizeof *mpm->contact, "contact");
    if (mpm->contact)
        mpm->contact->version = -1;
}

void contact_close(struct mpm *mpm)
{
    if (mpm->contact)
        memory_free(mpm->contact->pairs);
    memory_free(mpm->contact);
}

static void find_pairs(const struct cell_list *cells, struct contact *contact)
{
    int32_t components = 0;
    contact->n_pairs = 0;
    contact->version = cells->version;
    for (int32_t b = 0; b < cells->n_blocks; b++)
        components = cells->blocks[b].component >= components ? cells->blocks[b].component + 1 : components;
    for (int32_t b = 0; b < cells->n_blocks; b++)
        for (int32_t c = cells->blocks[b].component + 1; c < components; c++) {
            int32_t other = cell_list_find_block(cells, cells->blocks[b].at, c);
            if (other < 0)
                continue;
            contact->pairs = memory_grow(contact->pairs, &contact->capacity, contact->n_pairs + 1,
                                         sizeof *contact->pairs, "contact");
            contact->pairs[contact->n_pairs++] = (struct contact_pair){.first = b, .second = other};
        }
}

/* Unit normal of the pair at a node, from the first to the second; as it is when it has no length. */
static void find_normal(const struct mpm *mpm, const struct contact_pair *pair, int node, double normal[3])
{
    double length = 0;
    for (int a = 0; a < 3; a++) {
        double first = grid_field(mpm->grid, pair->first, NODE_NORMAL + a)[node];
        double second = grid_field(mpm->grid, pair->second, NODE_NORMAL + a)[node];
        normal[a] = mpm->scene->contact_normal == 0 ? first - second : mpm->scene->contact_normal == 1 ? first : -second;
        length += normal[a] * normal[a];
    }
    length = sqrt(length);
    for (int a = 0; a < 3 && length > TINY; a++)
        normal[a] /= length;
}

/* Force that the first component gives to the second, and whether it keeps them from sliding; false when
 * they part. */
static bool contact_force(const struct mpm *mpm, const struct contact_pair *pair, int node, const double normal[3],
                          double force[3], bool *sticks)
{
    const double m1 = grid_field(mpm->grid, pair->first, NODE_MASS)[node];
    const double m2 = grid_field(mpm->grid, pair->second, NODE_MASS)[node];
    const double friction = mpm->scene->contact_friction;
    double closing = 0, tangential = 0;
    for (int a = 0; a < 3; a++) {
        force[a] = grid_field(mpm->grid, pair->first, NODE_MOMENTUM + a)[node] * m2
                 - grid_field(mpm->grid, pair->second, NODE_MOMENTUM + a)[node] * m1;
        closing += force[a] * normal[a];
    }
    if (!(closing > TINY))
        return false;
    const double scale = 1 / ((m1 + m2) * mpm->time_step), along = closing * scale;
    for (int a = 0; a < 3; a++) {
        force[a] = force[a] * scale - along * normal[a];
        tangential += force[a] * force[a];
    }
    tangential = sqrt(tangential);
    double kept = friction <= TINY ? 0 : friction * fabs(along) < tangential ? friction * fabs(along) / tangential : 1;
    for (int a = 0; a < 3; a++)
        force[a] = along * normal[a] + kept * force[a];
    *sticks = kept == 1;
    return true;
}

/* Gives the force to both sides in the directions that are not fixed. */
static void apply_force(const struct mpm *mpm, const struct contact_pair *pair, int node, const double force[3])
{
    const uint8_t fixed = mpm->grid->fixed[(size_t)pair->first * BLOCK_CELLS + (size_t)node];
    for (int a = 0; a < 3; a++) {
        if (fixed >> a & 1)
            continue;
        grid_field(mpm->grid, pair->first, NODE_FORCE + a)[node] -= force[a];
        grid_field(mpm->grid, pair->second, NODE_FORCE + a)[node] += force[a];
        grid_field(mpm->grid, pair->first, NODE_MOMENTUM + a)[node] -= force[a] * mpm->time_step;
        grid_field(mpm->grid, pair->second, NODE_MOMENTUM + a)[node] += force[a] * mpm->time_step;
    }
}

static void resolve_pair(const struct mpm *mpm, struct contact_pair *pair)
{
    const double *m1 = grid_field(mpm->grid, pair->first, NODE_MASS), *m2 = grid_field(mpm->grid, pair->second, NODE_MASS);
    const double cutoff = mpm->grid->mass_cutoff;
    double normal[3], force[3];
    for (int a = 0; a < 3; a++)
        pair->force[a] = 0;
    pair->is_touching = pair->is_sticking = 0;
    for (int node = 0; node < BLOCK_CELLS; node++) {
        if (!(m1[node] > cutoff && m2[node] > cutoff))
            continue;
        find_normal(mpm, pair, node, normal);
        bool sticks;
        if (!contact_force(mpm, pair, node, normal, force, &sticks))
            continue;
        apply_force(mpm, pair, node, force);
        pair->is_touching |= UINT64_C(1) << node;
        pair->is_sticking |= (uint64_t)sticks << node;
        for (int a = 0; a < 3; a++)
            pair->force[a] += force[a];
    }
}

void contact_resolve(struct mpm *mpm)
{
    struct contact *contact = mpm->contact;
    if (contact->version != mpm->cells->version)
        find_pairs(mpm->cells, contact);
    for (int a = 0; a < 3; a++)
        mpm->contact_force[a] = 0;
    if (mpm->scene->contact != CONTACT_LAGRANGE)
        return;
    for (size_t i = 0; i < contact->n_pairs; i++) { /* a third component may be in two pairs: in order */
        resolve_pair(mpm, &contact->pairs[i]);
        for (int a = 0; a < 3; a++)
            mpm->contact_force[a] += contact->pairs[i].force[a];
    }
}

/* Straining velocities of a node: those of both sides become one along the normal, and along the surface too
 * where nothing slides. The momentum that they stand for stays. */
static void join_node(const struct mpm *mpm, const struct contact_pair *pair, int node)
{
    const double m1 = grid_field(mpm->grid, pair->first, NODE_MASS)[node];
    const double m2 = grid_field(mpm->grid, pair->second, NODE_MASS)[node];
    const uint8_t fixed = mpm->grid->fixed[(size_t)pair->first * BLOCK_CELLS + (size_t)node];
    const bool sticks = pair->is_sticking >> node & 1;
    double normal[3], closing[3], along = 0;
    find_normal(mpm, pair, node, normal);
    for (int a = 0; a < 3; a++) {
        closing[a] = grid_field(mpm->grid, pair->first, NODE_STRAINING + a)[node]
                   - grid_field(mpm->grid, pair->second, NODE_STRAINING + a)[node];
        along += closing[a] * normal[a];
    }
    for (int a = 0; a < 3; a++) {
        double change = fixed >> a & 1 ? 0 : sticks ? closing[a] : along * normal[a];
        grid_field(mpm->grid, pair->first, NODE_STRAINING + a)[node] -= m2 / (m1 + m2) * change;
        grid_field(mpm->grid, pair->second, NODE_STRAINING + a)[node] += m1 / (m1 + m2) * change;
    }
}

void contact_join(struct mpm *mpm)
{
    const struct contact *contact = mpm->contact;
    for (size_t i = 0; i < contact->n_pairs; i++)
        for (int node = 0; node < BLOCK_CELLS; node++)
            if (contact->pairs[i].is_touching >> node & 1)
                join_node(mpm, &contact->pairs[i], node);
}
