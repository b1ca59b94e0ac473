/* SPDX-License-Identifier: MIT */
#include "c_abi_table.h"

static void take(struct table* table, const sherd_body* body) {
    table->motion[body->island] = body->motion;
    table->mass[body->island] = body->mass;
}
static void create(void* user, const sherd_body* body) {
    struct table* table = user;
    CHECK(body->island < kMaxBodies && !table->alive[body->island]);
    CHECK(body->fragment_count > 0);
    table->alive[body->island] = 1;
    ++table->count;
    take(table, body);
}
static void update(void* user, const sherd_body* body) {
    struct table* table = user;
    CHECK(table->alive[body->island]);
    take(table, body);
}
static void remove_body(void* user, uint32_t island) {
    struct table* table = user;
    CHECK(table->alive[island]);
    table->alive[island] = 0;
    --table->count;
}
static void get_motion(void* user, uint32_t island, sherd_motion* out) {
    const struct table* table = user;
    *out = table->motion[island];
}

sherd_body_table functions_of(struct table* table) {
    const sherd_body_table functions = {table, create, update, remove_body, get_motion};
    return functions;
}

sherd_world make_world(struct table* table) {
    const sherd_body_table functions = functions_of(table);
    sherd_world world = {0};
    CHECK(sherd_world_create(&functions, NULL, &world, NULL) == SHERD_OK);
    return world;
}

sherd_object spawn_at(sherd_world world, sherd_asset asset, float height) {
    const sherd_pose place = {{0, height, 0}, {0, 0, 0, 1}};
    sherd_object object = {0};
    CHECK(sherd_spawn(world, asset, &place, NULL, &object, NULL) == SHERD_OK);
    return object;
}
