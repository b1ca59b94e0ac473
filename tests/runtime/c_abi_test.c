/* SPDX-License-Identifier: MIT */
/* A C11 program as an engine would use libsherd: the file given is loaded, put into a world whose
 * bodies are a table, and broken. Prints what failed; exits with the number of failures. */
#include "c_abi_table.h"

int failures = 0;

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

static void check_fragments(sherd_asset asset, const sherd_asset_info* info) {
    for (uint32_t f = 0; f < info->fragment_count; ++f) {
        sherd_fragment fragment;
        CHECK(sherd_asset_fragment(asset, f, &fragment) == SHERD_OK);
        CHECK(fragment.mass > 0 && fragment.hull_count > 0 && fragment.name && fragment.material);
        CHECK(fragment.level < info->level_count && fragment.toughness >= 0);
        const float* points = NULL;
        uint32_t count = 0;
        float margin = -1;
        CHECK(sherd_asset_hull(asset, f, 0, &points, &count, &margin) == SHERD_OK);
        CHECK(count >= 4 && margin >= 0 && isfinite(points[3 * count - 1]));
        for (uint32_t p = 0; p < count; ++p)
            CHECK(points[3 * p] >= fragment.low[0] && points[3 * p] <= fragment.high[0]);
        CHECK(sherd_asset_hull(asset, f, fragment.hull_count, &points, &count, &margin) ==
              SHERD_BAD_ARGUMENT);
        sherd_draw_range range;
        CHECK(sherd_asset_draw_ranges(asset, f, &range, 1) > 0);
        CHECK(range.first_index + range.index_count <= info->index_count);
        CHECK(range.material < info->material_count);
    }
    sherd_fragment none;
    CHECK(sherd_asset_fragment(asset, info->fragment_count, &none) == SHERD_BAD_ARGUMENT);
}

static void check_asset(sherd_asset asset) {
    sherd_asset_info info;
    CHECK(sherd_asset_get_info(asset, &info) == SHERD_OK);
    CHECK(strlen(info.name) > 0 && info.bake_hash != 0 && info.diagonal > 0);
    CHECK(info.fragment_count > 1 && info.bond_count > 0 && info.vertex_count > 0);
    CHECK(fabsf(info.rest_pose.rotation[3]) <= 1);
    sherd_attribute values;
    for (uint32_t a = 0; a < info.attribute_count; ++a) {
        CHECK(sherd_asset_attribute(asset, a, &values) == SHERD_OK);
        CHECK(values.components >= 1 && values.components <= 4);
        CHECK(isfinite(values.values[values.components * info.vertex_count - 1]));
    }
    CHECK(sherd_asset_attribute(asset, 0, &values) == SHERD_OK);
    CHECK(strcmp(values.semantic, "POSITION") == 0 && values.components == 3);
    CHECK(sherd_asset_attribute(asset, info.attribute_count, &values) == SHERD_BAD_ARGUMENT);
    uint32_t indices = 0;
    const uint32_t* index = sherd_asset_indices(asset, &indices);
    CHECK(indices == info.index_count && index[indices - 1] < info.vertex_count);
    CHECK(sherd_asset_material(asset, 0) >= -1);
    CHECK(sherd_asset_material(asset, info.material_count) == -1);
    for (uint32_t b = 0; b < info.bond_count; ++b) {
        sherd_bond bond;
        CHECK(sherd_asset_bond(asset, b, &bond) == SHERD_OK);
        CHECK(bond.a < info.fragment_count && bond.area > 0 && bond.energy >= 0);
        CHECK(bond.b == SHERD_NONE || bond.b < info.fragment_count);
    }
    sherd_bond none;
    CHECK(sherd_asset_bond(asset, info.bond_count, &none) == SHERD_BAD_ARGUMENT);
    check_fragments(asset, &info);
}

static void check_breaking(sherd_asset asset) {
    struct table* table = calloc(1, sizeof(struct table));
    const sherd_world world = make_world(table);
    const sherd_object object = spawn_at(world, asset, 2);
    CHECK(table->count == 1 && sherd_is_alive(world, object));
    CHECK(sherd_island_count(world, object) == 1);
    sherd_fragment whole;
    CHECK(sherd_asset_fragment(asset, 0, &whole) == SHERD_OK);

    sherd_contact contact = {0};
    contact.point[1] = 2;
    contact.normal[1] = -1;
    contact.impulse = 1e6F;
    contact.approach_speed = 1e3F;
    contact.effective_mass = 1e3F;
    float consumed = 0;
    CHECK(sherd_report_contact(world, &contact, &consumed, NULL) == SHERD_OK);
    CHECK(consumed > 0);
    CHECK(table->count > 1 && sherd_island_count(world, object) == (uint32_t)table->count);
    uint32_t events = 0;
    const sherd_break_event* event = sherd_events(world, &events);
    CHECK(events == 1 && event->bonds > 0 && event->asset.id == asset.id);
    CHECK(event->object.id == object.id);
    CHECK(fabsf(event->consumed - consumed) <= 1e-6F * consumed);
    CHECK(sherd_events(world, &events) == NULL && events == 0);
    uint32_t poses = 0;
    const sherd_fragment_pose* pose = sherd_poses(world, &poses);
    CHECK(poses >= (uint32_t)table->count);
    CHECK(pose[0].pose.translation[1] == 2);
    sherd_island island;
    CHECK(sherd_get_island(world, 0, &island) == SHERD_OK);
    CHECK(island.object.id == object.id && island.fragment_count > 0 && !island.is_fixed);
    CHECK(sherd_find_island(world, object, island.fragments[0]) == 0);
    CHECK(sherd_find_island(world, object, 0) == SHERD_NONE);
    table->motion[0].pose.translation[1] += 1;
    CHECK(sherd_after_step(world, 0.01F) == SHERD_OK);
    sherd_island moved;
    CHECK(sherd_get_island(world, 0, &moved) == SHERD_OK);
    CHECK(moved.pose.translation[1] > island.pose.translation[1] + 0.9F && moved.age > 0);
    /* An engine that has lost a body: it stays where it was. */
    table->motion[0].pose.translation[1] = strtof("nan", NULL);
    CHECK(sherd_after_step(world, 0.01F) == SHERD_OK);
    CHECK(sherd_get_island(world, 0, &island) == SHERD_OK);
    CHECK(island.pose.translation[1] == moved.pose.translation[1]);

    sherd_asset_info info;
    CHECK(sherd_asset_get_info(asset, &info) == SHERD_OK);
    CHECK(sherd_break_all(world, object) == SHERD_OK);
    for (uint32_t b = 0; b < info.bond_count; ++b)
        CHECK(sherd_bond_health(world, object, b) == 0);
    CHECK(sherd_fragment_health(world, object, 0) == 0);
    double mass = 0; /* nothing is anchored any more */
    for (int i = 0; i < kMaxBodies; ++i)
        if (table->alive[i]) mass += table->mass[i];
    CHECK(fabs(mass - whole.mass) < 1e-5 * whole.mass);

    const float load[3] = {0, -10, 0}, none[3] = {0, NAN, 0};
    CHECK(sherd_set_load(world, object, 0, load) == SHERD_OK);
    CHECK(sherd_set_load(world, object, 0, none) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_set_load(world, object, info.fragment_count, load) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_allow_bodies(world, UINT32_MAX, UINT32_MAX) == SHERD_OK);
    uint32_t before = 0, after = 0;
    const sherd_fragment_pose* standing = sherd_poses(world, &before);
    const uint32_t first = standing[0].fragment;
    CHECK(sherd_remove_piece(world, object, first) == SHERD_OK);
    CHECK(sherd_remove_piece(world, object, first) == SHERD_GONE);
    (void)sherd_poses(world, &after);
    CHECK(after < before);

    contact.island = 4000;
    CHECK(sherd_report_contact(world, &contact, &consumed, NULL) == SHERD_GONE);
    CHECK(sherd_remove(world, object) == SHERD_OK);
    CHECK(sherd_remove(world, object) == SHERD_GONE);
    CHECK(sherd_break_all(world, object) == SHERD_GONE);
    CHECK(table->count == 0);
    CHECK(sherd_world_destroy(world) == SHERD_OK);
    free(table);
}

/* A leaf, and the world's own way to damage it. */
static uint32_t some_leaf(sherd_asset asset) {
    sherd_fragment fragment;
    uint32_t leaf = 0;
    while (sherd_asset_fragment(asset, leaf, &fragment) == SHERD_OK && fragment.child_count > 0)
        ++leaf;
    return leaf;
}

static void check_damage(sherd_asset asset) {
    struct table* table = calloc(1, sizeof(struct table));
    const sherd_world world = make_world(table);
    uint32_t broken = 0;
    sherd_area_damage damage = sherd_default_area_damage();
    damage.fluence = strtof("inf", NULL);
    damage.falloff = 0;

    damage.shape = SHERD_BOX; /* nothing is within */
    damage.a[0] = 1000;
    damage.b[0] = damage.b[1] = damage.b[2] = 100;
    const sherd_object boxed = spawn_at(world, asset, 0);
    CHECK(sherd_damage(world, boxed, &damage, &broken, NULL) == SHERD_OK && broken == 0);
    damage.a[0] = 0; /* all of it is */
    CHECK(sherd_damage(world, boxed, &damage, &broken, NULL) == SHERD_OK && broken > 0);
    const uint32_t all = broken;
    CHECK(sherd_remove(world, boxed) == SHERD_OK);

    damage = sherd_default_area_damage();
    damage.shape = SHERD_CAPSULE;
    damage.a[1] = -100;
    damage.b[1] = 100;
    damage.radius = 1e-3F; /* too thin to meet a bond's centroid, or just one of them */
    damage.fluence = strtof("inf", NULL);
    const sherd_object pierced = spawn_at(world, asset, 0);
    CHECK(sherd_damage(world, pierced, &damage, &broken, NULL) == SHERD_OK && broken <= all);
    damage.radius = 100;
    CHECK(sherd_damage(world, pierced, &damage, &broken, NULL) == SHERD_OK && broken > 0);
    CHECK(sherd_remove(world, pierced) == SHERD_OK);

    /* A motion along a bond's normal shears nothing of it; one across it does. */
    sherd_bond bond;
    CHECK(sherd_asset_bond(asset, 0, &bond) == SHERD_OK);
    damage = sherd_default_area_damage();
    memcpy(damage.a, bond.centroid, sizeof(damage.a));
    damage.radius = 1e-3F;
    damage.falloff = 0;
    damage.fluence = 0.5F * bond.energy / bond.area;
    memcpy(damage.shear, bond.normal, sizeof(damage.shear));
    const sherd_object sheared = spawn_at(world, asset, 0);
    CHECK(sherd_damage(world, sheared, &damage, &broken, NULL) == SHERD_OK && broken == 0);
    CHECK(sherd_bond_health(world, sheared, 0) > 0.99F);
    damage.shear[0] = bond.normal[1];
    damage.shear[1] = bond.normal[2];
    damage.shear[2] = bond.normal[0];
    CHECK(sherd_damage(world, sheared, &damage, &broken, NULL) == SHERD_OK && broken == 0);
    CHECK(fabsf(sherd_bond_health(world, sheared, 0) - 0.5F) < 0.01F);
    CHECK(sherd_fragment_health(world, sheared, 0) < 1);
    CHECK(sherd_heal(world, sheared, 1) == SHERD_OK);
    CHECK(sherd_bond_health(world, sheared, 0) == 1);

    /* And every object at once. */
    const sherd_object second = spawn_at(world, asset, 0);
    damage = sherd_default_area_damage();
    damage.radius = 1000;
    damage.falloff = 0;
    damage.fluence = strtof("inf", NULL);
    CHECK(sherd_damage_all(world, &damage, &broken, NULL) == SHERD_OK && broken == 2 * all);
    CHECK(sherd_bond_health(world, second, 0) == 0);
    CHECK(sherd_world_destroy(world) == SHERD_OK);
    CHECK(table->count == 0);
    free(table);
}

/* So that the parts stand for the whole, and still hang together. */
static void crack_one_bond(sherd_world world, sherd_object object, sherd_asset asset) {
    sherd_bond bond;
    CHECK(sherd_asset_bond(asset, 0, &bond) == SHERD_OK);
    sherd_area_damage damage = sherd_default_area_damage();
    memcpy(damage.a, bond.centroid, sizeof(damage.a));
    damage.radius = 1e-3F;
    damage.falloff = 0;
    damage.fluence = 2 * bond.energy / bond.area;
    uint32_t broken = 0;
    CHECK(sherd_damage(world, object, &damage, &broken, NULL) == SHERD_OK && broken >= 1);
}

static void check_pieces(sherd_asset asset) {
    struct table* table = calloc(1, sizeof(struct table));
    const sherd_world world = make_world(table);
    const sherd_object object = spawn_at(world, asset, 0);
    const uint32_t leaf = some_leaf(asset);
    CHECK(sherd_detach(world, object, leaf) == SHERD_GONE); /* it does not stand yet */
    CHECK(sherd_break_fragment(world, object, 0) == SHERD_OK);
    CHECK(sherd_break_fragment(world, object, 0) == SHERD_GONE);
    CHECK(sherd_fragment_health(world, object, 0) < 1);
    CHECK(sherd_world_destroy(world) == SHERD_OK);
    CHECK(table->count == 0);

    /* Opened, and still in one piece: its parts are neighbours. */
    const sherd_world other = make_world(table);
    const sherd_object cracked = spawn_at(other, asset, 0);
    crack_one_bond(other, cracked, asset);
    uint32_t poses = 0, pairs = 0;
    const sherd_fragment_pose* pose = sherd_poses(other, &poses);
    for (uint32_t p = 0; p < poses; ++p) {
        sherd_neighbor near[64];
        const uint32_t count = sherd_neighbors(other, cracked, pose[p].fragment, near, 64);
        for (uint32_t n = 0; n < count && n < 64; ++n) {
            CHECK(near[n].area > 0 && near[n].health > 0 && near[n].health <= 1);
            CHECK(near[n].fragment != pose[p].fragment);
        }
        pairs += count;
    }
    CHECK(poses > 1 && (pairs > 0 || sherd_island_count(other, cracked) == poses));
    CHECK(sherd_detach(other, cracked, pose[0].fragment) == SHERD_OK);
    pose = sherd_poses(other, &poses);
    CHECK(sherd_neighbors(other, cracked, pose[0].fragment, NULL, 0) == 0);
    CHECK(sherd_world_destroy(other) == SHERD_OK);
    free(table);
}

static void check_anchors(sherd_asset asset) {
    struct table* table = calloc(1, sizeof(struct table));
    const sherd_world world = make_world(table);
    const sherd_object object = spawn_at(world, asset, 5);
    sherd_island island;
    CHECK(sherd_get_island(world, 0, &island) == SHERD_OK && island.is_anchored && island.is_fixed);
    CHECK(sherd_break_all(world, object) == SHERD_OK); /* with the anchors of the file */
    CHECK(sherd_get_island(world, 0, &island) == SHERD_OK && !island.is_anchored);
    CHECK(table->mass[0] > 0);
    uint32_t leaves = 0;
    const float below[3] = {-100, -100, -100}, above[3] = {100, 100, 100};
    CHECK(sherd_anchor_in_box(world, object, below, below, &leaves) == SHERD_OK && leaves == 0);
    CHECK(sherd_anchor_in_box(world, object, below, above, &leaves) == SHERD_OK);
    CHECK(leaves == sherd_island_count(world, object));
    CHECK(sherd_get_island(world, 0, &island) == SHERD_OK && island.is_anchored && island.is_fixed);
    CHECK(table->mass[0] == 0);
    const uint32_t leaf = some_leaf(asset);
    const uint32_t held = sherd_find_island(world, object, leaf);
    CHECK(sherd_anchor(world, object, leaf, 0) == SHERD_OK);
    CHECK(table->mass[held] > 0);
    CHECK(sherd_anchor(world, object, leaf, 1) == SHERD_OK);
    CHECK(table->mass[held] == 0);
    CHECK(sherd_anchor(world, object, 0, 1) == SHERD_GONE); /* the whole stands no more */
    CHECK(sherd_world_destroy(world) == SHERD_OK);
    free(table);
}

/* What stands carries its weight; on a star of a million times the gravity it does not. */
static void check_stress(sherd_asset asset) {
    struct table* table = calloc(1, sizeof(struct table));
    const sherd_world world = make_world(table);
    const sherd_object object = spawn_at(world, asset, 0);
    crack_one_bond(world, object, asset);
    const float down[3] = {0, -9.8F, 0}, crushing[3] = {0, -1e7F, 0};
    uint32_t events = 0;
    (void)sherd_events(world, &events);
    sherd_asset_info info;
    CHECK(sherd_asset_get_info(asset, &info) == SHERD_OK);
    CHECK(sherd_work_on_stress(world, down, 500) == SHERD_OK);
    float worst = 0;
    for (uint32_t b = 0; b < info.bond_count; ++b)
        worst = fmaxf(worst, sherd_overload(world, object, b));
    CHECK(worst > 0 && worst < 1);
    CHECK(sherd_events(world, &events) == NULL);
    uint8_t bytes[65536]; /* what comes back has its stress to be found again */
    size_t size = 0;
    CHECK(sherd_save(world, object, bytes, sizeof(bytes), &size) == SHERD_OK);
    CHECK(sherd_restore(world, object, bytes, size, NULL) == SHERD_OK);
    for (int i = 0; i < 20; ++i) CHECK(sherd_work_on_stress(world, crushing, 500) == SHERD_OK);
    CHECK(sherd_events(world, &events) != NULL && events > 0);
    CHECK(sherd_world_destroy(world) == SHERD_OK);
    free(table);
}

static void check_saving(sherd_asset asset) {
    struct table* table = calloc(1, sizeof(struct table));
    struct table* other = calloc(1, sizeof(struct table));
    const sherd_world world = make_world(table), late = make_world(other);
    const sherd_object object = spawn_at(world, asset, 2), joined = spawn_at(late, asset, 0);
    CHECK(sherd_break_fragment(world, object, 0) == SHERD_OK);
    table->motion[0].pose.translation[0] = 0.1F;
    table->motion[0].linear_velocity[1] = -3;
    CHECK(sherd_after_step(world, 0.02F) == SHERD_OK);
    size_t size = 0, again = 0;
    CHECK(sherd_save(world, object, NULL, 0, &size) == SHERD_TOO_SMALL && size > 0);
    uint8_t* bytes = malloc(size);
    uint8_t* twice = malloc(size);
    CHECK(sherd_save(world, object, bytes, size, &again) == SHERD_OK && again == size);

    sherd_error error = {{0}, {0}};
    CHECK(sherd_restore(late, joined, bytes, size - 1, &error) == SHERD_MALFORMED);
    CHECK(strlen(error.message) > 0 && other->count == 1);
    CHECK(sherd_restore(late, joined, bytes, size, &error) == SHERD_OK);
    uint32_t events = 0, first = 0, second = 0;
    CHECK(sherd_events(late, &events) == NULL && events == 0);
    CHECK(other->count == table->count);
    CHECK(memcmp(&table->motion[0], &other->motion[0], sizeof(sherd_motion)) == 0);
    const sherd_fragment_pose* here = sherd_poses(world, &first);
    const sherd_fragment_pose* there = sherd_poses(late, &second);
    CHECK(first == second);
    for (uint32_t p = 0; p < first && p < second; ++p) {
        CHECK(here[p].fragment == there[p].fragment);
        CHECK(memcmp(&here[p].pose, &there[p].pose, sizeof(sherd_pose)) == 0);
        CHECK(memcmp(&here[p].previous, &there[p].previous, sizeof(sherd_pose)) == 0);
    }
    CHECK(sherd_after_step(late, 0.02F) == SHERD_OK);
    CHECK(sherd_save(late, joined, twice, size, &again) == SHERD_OK && again == size);
    free(bytes);
    free(twice);
    CHECK(sherd_world_destroy(world) == SHERD_OK);
    CHECK(sherd_world_destroy(late) == SHERD_OK);
    free(table);
    free(other);
}

/* Twice as large: what it is made of is, its vertices are not, and their poses say so. */
static void check_sizes(sherd_asset asset) {
    sherd_asset twice = {0}, none = {7};
    sherd_error error;
    CHECK(sherd_asset_scale(asset, 2, &twice, &error) == SHERD_OK && twice.id != asset.id);
    CHECK(sherd_asset_scale(asset, -1, &none, &error) == SHERD_BAD_ARGUMENT);
    CHECK(strcmp(error.where, "factor") == 0 && none.id == 7);
    CHECK(sherd_asset_scale(asset, NAN, &none, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_asset_scale(asset, 2, NULL, NULL) == SHERD_BAD_ARGUMENT);
    sherd_asset_info info, large;
    CHECK(sherd_asset_get_info(asset, &info) == SHERD_OK && info.scale == 1);
    CHECK(sherd_asset_get_info(twice, &large) == SHERD_OK && large.scale == 2);
    CHECK(large.vertex_count == info.vertex_count && large.index_count == info.index_count);
    CHECK(large.attribute_count == info.attribute_count);
    CHECK(fabsf(large.diagonal - 2 * info.diagonal) < 1e-5F * info.diagonal);
    sherd_fragment piece, heavy;
    CHECK(sherd_asset_fragment(asset, 0, &piece) == SHERD_OK);
    CHECK(sherd_asset_fragment(twice, 0, &heavy) == SHERD_OK);
    CHECK(fabsf(heavy.mass - 8 * piece.mass) < 1e-4F * piece.mass);

    struct table* table = calloc(1, sizeof(struct table));
    const sherd_world world = make_world(table);
    const sherd_object small = spawn_at(world, asset, 0), big = spawn_at(world, twice, 9);
    sherd_asset_release(twice); /* the world keeps it */
    CHECK(sherd_break_all(world, big) == SHERD_OK);
    uint32_t count = 0;
    const sherd_fragment_pose* pose = sherd_poses(world, &count);
    CHECK(count > 2);
    for (uint32_t p = 0; p < count; ++p) {
        const int is_big = pose[p].object.id == big.id;
        CHECK(pose[p].scale == (is_big ? 2 : 1));
        CHECK(pose[p].asset.id == (is_big ? twice.id : asset.id));
    }
    const sherd_break_event* event = sherd_events(world, &count);
    CHECK(count == 1 && event->asset.id == twice.id);
    /* Of an object that is gone it tells some size. */
    CHECK(sherd_break_all(world, small) == SHERD_OK);
    CHECK(sherd_remove(world, small) == SHERD_OK);
    event = sherd_events(world, &count);
    CHECK(count == 1 && (event->asset.id == twice.id || event->asset.id == asset.id));
    CHECK(sherd_world_destroy(world) == SHERD_OK);
    CHECK(table->count == 0);
    free(table);
}

static sherd_world calling;
static sherd_object called;
static int refused = 0;
static void call_back(void* user, const sherd_body* body) {
    (void)user;
    (void)body;
    uint32_t count = 0;
    if (sherd_break_all(calling, called) == SHERD_BUSY) ++refused;
    if (sherd_world_destroy(calling) == SHERD_BUSY) ++refused;
    CHECK(sherd_poses(calling, &count) == NULL);
    sherd_asset_info info; /* of assets may be asked: that is how bodies are made */
    CHECK(sherd_asset_get_info(body->asset, &info) == SHERD_OK);
}
static void ignore(void* user, uint32_t island) {
    (void)user;
    (void)island;
}
static void stay(void* user, uint32_t island, sherd_motion* out) {
    (void)user;
    (void)island;
    (void)out;
}

static void check_calls_from_the_table(sherd_asset asset) {
    const sherd_body_table functions = {NULL, call_back, call_back, ignore, stay};
    CHECK(sherd_world_create(&functions, NULL, &calling, NULL) == SHERD_OK);
    called = spawn_at(calling, asset, 0);
    CHECK(refused == 2);
    CHECK(sherd_break_all(calling, called) == SHERD_OK);
    CHECK(refused > 4);
    CHECK(sherd_world_destroy(calling) == SHERD_OK);
}

/* Last: the asset is gone afterwards. */
static void check_lifetime(sherd_asset asset) {
    struct table* table = calloc(1, sizeof(struct table));
    const sherd_world world = make_world(table);
    const sherd_object object = spawn_at(world, asset, 0);
    sherd_asset_info info;
    sherd_asset_release(asset);
    sherd_asset_release(asset);
    CHECK(sherd_asset_get_info(asset, &info) == SHERD_OK); /* the world keeps it */
    CHECK(sherd_break_all(world, object) == SHERD_OK);
    CHECK(sherd_world_destroy(world) == SHERD_OK);
    CHECK(sherd_asset_get_info(asset, &info) == SHERD_GONE);
    free(table);
}

static void check_options(sherd_asset asset) {
    struct table* table = calloc(1, sizeof(struct table));
    const sherd_body_table functions = functions_of(table);
    sherd_world_options options = sherd_default_world_options();
    options.damage.max_level = 0; /* nothing breaks */
    options.max_pending_events = 1;
    sherd_world world;
    CHECK(sherd_world_create(&functions, &options, &world, NULL) == SHERD_OK);
    (void)spawn_at(world, asset, 0);
    sherd_hit hit = {0};
    hit.energy = 1e9F;
    hit.speed = 1e3F;
    hit.impulse = 1e3F;
    float consumed = 1;
    CHECK(sherd_report_hit(world, &hit, &consumed, NULL) == SHERD_OK && consumed == 0);
    CHECK(table->count == 1);
    CHECK(sherd_world_destroy(world) == SHERD_OK);
    options.damage.immunity = -1;
    CHECK(sherd_world_create(&functions, &options, &world, NULL) == SHERD_BAD_ARGUMENT);
    free(table);
}

int main(int argc, char** argv) {
    CHECK(sherd_abi_version() == SHERD_ABI_VERSION);
    CHECK(strchr(sherd_version(), '.') != NULL);
    if (argc < 2) return 1;
    size_t size = 0;
    void* bytes = read_file(argv[1], &size);
    CHECK(bytes != NULL);
    if (!bytes) return failures;
    sherd_asset asset = {0};
    uint32_t count = 0;
    sherd_error error = {{0}, {0}};
    CHECK(sherd_load(bytes, size, NULL, 0, &count, &error) == SHERD_TOO_SMALL);
    CHECK(count == 1);
    CHECK(sherd_load(bytes, size / 2, &asset, 1, &count, &error) == SHERD_MALFORMED);
    CHECK(strlen(error.message) > 0 && count == 0);
    CHECK(sherd_load(bytes, size, &asset, 1, &count, &error) == SHERD_OK);
    free(bytes);
    if (asset.id == 0) return failures + 1;
    check_asset(asset);
    check_breaking(asset);
    check_damage(asset);
    check_pieces(asset);
    check_anchors(asset);
    check_stress(asset);
    check_saving(asset);
    check_sizes(asset);
    check_options(asset);
    check_calls_from_the_table(asset);
    check_garbage(asset);
    check_lifetime(asset);
    if (failures == 0) puts("all well");
    return failures;
}
