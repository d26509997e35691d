/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rkpm/box.h"

bool box_is_boundary(const struct node_box *box, size_t node)
{
    bool is_boundary = false;
    for (int a = 0; a < box->dimension; a++) {
        const size_t place = node % (size_t)box->numbers[a];
        is_boundary = is_boundary || place == 0 || place + 1 == (size_t)box->numbers[a];
        node /= (size_t)box->numbers[a];
    }
    return is_boundary;
}

void box_order_axes(const long numbers[3], int order[3])
{
    for (int a = 0; a < 3; a++) {
        int place = a;
        for (; place > 0 && numbers[order[place - 1]] > numbers[a]; place--)
            order[place] = order[place - 1];
        order[place] = a;
    }
}

size_t box_node(const struct node_box *box, const int order[3], size_t n)
{
    const long stride[3] = {1, box->numbers[0], box->numbers[0] * box->numbers[1]};
    size_t node = 0;
    for (int i = 0; i < 3; i++) {
        const size_t number = (size_t)box->numbers[order[i]];
        node += n % number * (size_t)stride[order[i]];
        n /= number;
    }
    return node;
}
