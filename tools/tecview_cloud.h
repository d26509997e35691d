/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecview_cloud: the points of a picture: where they are, how large, of what value. */
#ifndef TOOLS_TECVIEW_CLOUD_H
#define TOOLS_TECVIEW_CLOUD_H

#include "tecplot_read.h"
#include "tecview.h"

struct tecview_cloud {
    size_t count;
    double (*positions)[3];
    double (*halves)[3]; /* half the size of a point's box along x, y and z */
    double *values;      /* NaN where there is none */
    double spacing;      /* of the points in the file's first zone */
    double deform_scale; /* 1 when the picture shows the points where they are */

    size_t nan_count;
    double low, high;                   /* smallest and largest finite value */
    double low_place[3], high_place[3]; /* where these are, without --deform */
};

/* Takes the points of the request from the file; false after a message. */
bool tecview_cloud_open(const struct tecview_request *request, const struct tecplot_file *file,
                        const struct tecplot_zone *zone, struct tecview_cloud *cloud);
void tecview_cloud_close(struct tecview_cloud *cloud);

#endif
