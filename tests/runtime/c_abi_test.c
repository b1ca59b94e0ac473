/* SPDX-License-Identifier: MIT */
/* A C11 program as an engine would use libsherd: the file given is loaded, put into a world whose
 * bodies are a table, and broken. Prints what failed; exits with the number of failures. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sherd/runtime/sherd.h"

static int failures = 0;
#define CHECK(condition)                                                        \
    do {                                                                        \
        if (!(condition)) {                                                     \
            fprintf(stderr, "%s:%d: %s is false\n", __FILE__, __LINE__, #condition); \
            ++failures;                                                         \
        }                                                                       \
    } while (0)

enum { kMaxBodies = 4096 };
struct table {
    int alive[kMaxBodies];
    sherd_motion motion[kMaxBodies];
    float mass[kMaxBodies];
    int count;
};

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

static void* read_file(const char* path, size_t* size) {
    FILE* file = fopen(path, "rb");
    if (!file) return NULL;
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    void* bytes = malloc(*size);
    if (bytes && fread(bytes, 1, *size, file) != *size) {
        free(bytes);
        bytes = NULL;
    }
    fclose(file);
    return bytes;
}

static void check_asset(const sherd_asset* asset) {
    const uint32_t fragments = sherd_asset_fragment_count(asset);
    CHECK(fragments > 1);
    CHECK(strlen(sherd_asset_name(asset)) > 0);
    CHECK(sherd_asset_bake_hash(asset) != 0);
    CHECK(sherd_asset_vertex_count(asset) > 0);
    sherd_attribute position;
    CHECK(sherd_asset_attribute(asset, 0, &position) == SHERD_OK);
    CHECK(strcmp(position.semantic, "POSITION") == 0 && position.components == 3);
    CHECK(sherd_asset_attribute(asset, sherd_asset_attribute_count(asset), &position) ==
          SHERD_BAD_ARGUMENT);
    uint32_t indices = 0;
    const uint32_t* index = sherd_asset_indices(asset, &indices);
    CHECK(indices > 0 && index[0] < sherd_asset_vertex_count(asset));
    for (uint32_t f = 0; f < fragments; ++f) {
        sherd_fragment fragment;
        CHECK(sherd_asset_fragment(asset, f, &fragment) == SHERD_OK);
        CHECK(fragment.mass > 0 && fragment.hull_count > 0);
        const float* points = NULL;
        uint32_t count = 0;
        float margin = -1;
        CHECK(sherd_asset_hull(asset, f, 0, &points, &count, &margin) == SHERD_OK);
        CHECK(count >= 4 && margin >= 0 && isfinite(points[3 * count - 1]));
        CHECK(sherd_asset_hull(asset, f, fragment.hull_count, &points, &count, &margin) ==
              SHERD_BAD_ARGUMENT);
        sherd_draw_range range;
        CHECK(sherd_asset_draw_ranges(asset, f, &range, 1) > 0);
        CHECK(range.first_index + range.index_count <= indices);
    }
}

static void check_breaking(sherd_asset* asset) {
    struct table* table = calloc(1, sizeof(struct table));
    const sherd_body_table bodies = {table, create, update, remove_body, get_motion};
    sherd_world* world = sherd_world_create(&bodies);
    CHECK(world != NULL);
    const sherd_pose place = {{0, 2, 0}, {0, 0, 0, 1}};
    sherd_object object;
    CHECK(sherd_spawn(world, asset, &place, NULL, &object) == SHERD_OK);
    CHECK(table->count == 1 && sherd_is_alive(world, object));
    sherd_fragment whole;
    CHECK(sherd_asset_fragment(asset, 0, &whole) == SHERD_OK);

    sherd_contact contact = {0};
    contact.point[1] = 2;
    contact.normal[1] = -1;
    contact.impulse = 1e6F;
    contact.approach_speed = 1e3F;
    contact.effective_mass = 1e3F;
    float consumed = 0;
    CHECK(sherd_report_contact(world, &contact, &consumed) == SHERD_OK);
    CHECK(consumed > 0);
    CHECK(table->count > 1);
    uint32_t events = 0;
    const sherd_break_event* event = sherd_events(world, &events);
    CHECK(events == 1 && event->bonds > 0 && event->asset != NULL);
    CHECK(fabsf(event->consumed - consumed) <= 1e-6F * consumed);
    uint32_t poses = 0;
    const sherd_fragment_pose* pose = sherd_poses(world, &poses);
    CHECK(poses >= (uint32_t)table->count);
    CHECK(pose[0].pose.translation[1] == 2);
    table->motion[0].pose.translation[1] += 1;
    CHECK(sherd_after_step(world, 0.01F) == SHERD_OK);

    CHECK(sherd_break_all(world, object) == SHERD_OK);
    for (uint32_t b = 0; b < sherd_asset_bond_count(asset); ++b)
        CHECK(sherd_bond_health(world, object, b) == 0);
    double mass = 0; /* nothing is anchored any more */
    for (int i = 0; i < kMaxBodies; ++i)
        if (table->alive[i]) mass += table->mass[i];
    CHECK(fabs(mass - whole.mass) < 1e-5 * whole.mass);
    /* The world keeps what it needs of an asset. */
    sherd_asset_release(asset);
    CHECK(strlen(sherd_asset_name(sherd_poses(world, &poses)->asset)) > 0);

    contact.island = 4000;
    CHECK(sherd_report_contact(world, &contact, &consumed) == SHERD_GONE);
    CHECK(sherd_remove(world, object) == SHERD_OK);
    CHECK(sherd_remove(world, object) == SHERD_GONE);
    CHECK(sherd_break_all(world, object) == SHERD_GONE);
    CHECK(table->count == 0);
    sherd_world_destroy(world);
    free(table);
}

int main(int argc, char** argv) {
    CHECK(sherd_abi_version() == SHERD_ABI_VERSION);
    if (argc < 2) return 1;
    size_t size = 0;
    void* bytes = read_file(argv[1], &size);
    CHECK(bytes != NULL);
    if (!bytes) return failures;
    sherd_asset* asset = NULL;
    uint32_t count = 0;
    sherd_error error = {{0}, {0}};
    CHECK(sherd_load(bytes, size, NULL, 0, &count, &error) == SHERD_TOO_SMALL);
    CHECK(count == 1);
    CHECK(sherd_load(bytes, size / 2, &asset, 1, &count, &error) == SHERD_MALFORMED);
    CHECK(strlen(error.message) > 0 && count == 0);
    CHECK(sherd_load(NULL, 3, &asset, 1, &count, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_load(bytes, size, &asset, 1, &count, &error) == SHERD_OK);
    free(bytes);
    if (!asset) return failures + 1;
    check_asset(asset);
    CHECK(sherd_world_create(NULL) == NULL);
    check_breaking(asset);
    if (failures == 0) puts("all well");
    return failures;
}
