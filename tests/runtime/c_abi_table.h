/* SPDX-License-Identifier: MIT */
/* An engine in which nothing moves, as a table of functions, and what C tests need. */
#ifndef SHERD_C_ABI_TABLE_H
#define SHERD_C_ABI_TABLE_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sherd/runtime/sherd.h"

extern int failures;
#define CHECK(condition)                                                             \
    do {                                                                             \
        if (!(condition)) {                                                          \
            fprintf(stderr, "%s:%d: %s is false\n", __FILE__, __LINE__, #condition); \
            ++failures;                                                              \
        }                                                                            \
    } while (0)

enum { kMaxBodies = 4096 };
struct table {
    int alive[kMaxBodies];
    sherd_motion motion[kMaxBodies];
    float mass[kMaxBodies];
    int count;
};

sherd_body_table functions_of(struct table* table);
sherd_world make_world(struct table* table);
sherd_object spawn_at(sherd_world world, sherd_asset asset, float height);

/* Every call with handles and pointers that are none. */
void check_garbage(sherd_asset asset);

#endif
