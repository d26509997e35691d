/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tecview_panel: the parts of a picture of points: the body seen from a direction, and a section.
 */
#ifndef TOOLS_TECVIEW_PANEL_H
#define TOOLS_TECVIEW_PANEL_H

#include "tecview_figure.h"

/* The body with a triad of axes and a ruler. */
void tecview_panel_body(struct tecview_figure *figure, const struct draw_box *panel);

/* The section, face on, with scales. */
void tecview_panel_section(struct tecview_figure *figure, const struct draw_box *panel);

/* Both side by side or one above the other, whichever shows them larger. */
void tecview_panel_both(struct tecview_figure *figure, const struct draw_box *area);

/* Whether the section, if any, has a point; false after a message that says where the body is. */
bool tecview_panel_check(const struct tecview_figure *figure);

#endif
