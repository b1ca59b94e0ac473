/* SPDX-License-Identifier: MIT */
#include "c_abi_table.h"

static void check_assets(sherd_asset none) {
    sherd_asset_info info;
    sherd_fragment fragment;
    sherd_attribute attribute;
    sherd_bond bond;
    sherd_draw_range range;
    const float* points = NULL;
    uint32_t count = 7;
    float margin = 0;
    sherd_asset_release(none);
    CHECK(sherd_asset_get_info(none, &info) == SHERD_GONE);
    CHECK(sherd_asset_scale(none, 2, &none, NULL) == SHERD_GONE);
    CHECK(sherd_asset_fragment(none, 0, &fragment) == SHERD_GONE);
    CHECK(sherd_asset_hull(none, 0, 0, &points, &count, &margin) == SHERD_GONE);
    CHECK(sherd_asset_attribute(none, 0, &attribute) == SHERD_GONE);
    CHECK(sherd_asset_bond(none, 0, &bond) == SHERD_GONE);
    CHECK(sherd_asset_indices(none, &count) == NULL && count == 0);
    CHECK(sherd_asset_material(none, 0) == -1);
    CHECK(sherd_asset_draw_ranges(none, 0, &range, 1) == 0);
}

static void check_worlds(sherd_world world, sherd_object object, sherd_asset asset) {
    const sherd_pose place = {{0, 0, 0}, {0, 0, 0, 1}};
    const float zero[3] = {0, 0, 0};
    sherd_area_damage damage = sherd_default_area_damage();
    damage.radius = 1;
    sherd_object spawned;
    sherd_neighbor neighbor;
    size_t size = 0;
    uint32_t count = 7;
    CHECK(sherd_spawn(world, asset, &place, NULL, &spawned, NULL) == SHERD_GONE);
    CHECK(sherd_remove(world, object) == SHERD_GONE);
    CHECK(sherd_is_alive(world, object) == 0);
    CHECK(sherd_damage(world, object, &damage, NULL, NULL) == SHERD_GONE);
    CHECK(sherd_break_fragment(world, object, 0) == SHERD_GONE);
    CHECK(sherd_detach(world, object, 0) == SHERD_GONE);
    CHECK(sherd_break_all(world, object) == SHERD_GONE);
    CHECK(sherd_heal(world, object, 1) == SHERD_GONE);
    CHECK(sherd_set_load(world, object, 0, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_remove_piece(world, object, 0) == SHERD_GONE);
    CHECK(sherd_anchor(world, object, 0, 1) == SHERD_GONE);
    CHECK(sherd_anchor_in_box(world, object, zero, zero, &count) == SHERD_GONE && count == 0);
    CHECK(sherd_save(world, object, NULL, 0, &size) == SHERD_GONE && size == 0);
    CHECK(sherd_restore(world, object, "x", 1, NULL) == SHERD_GONE);
    CHECK(sherd_find_island(world, object, 0) == SHERD_NONE);
    CHECK(sherd_island_count(world, object) == 0);
    CHECK(sherd_bond_health(world, object, 0) == -1);
    CHECK(sherd_fragment_health(world, object, 0) == -1);
    CHECK(sherd_overload(world, object, 0) == 0);
    CHECK(sherd_neighbors(world, object, 0, &neighbor, 1) == 0);
}

static void check_no_world(sherd_world none) {
    const float zero[3] = {0, 0, 0};
    sherd_area_damage damage = sherd_default_area_damage();
    damage.radius = 1;
    const sherd_contact contact = {0};
    const sherd_hit hit = {0};
    sherd_island island;
    uint32_t count = 7;
    CHECK(sherd_report_contact(none, &contact, NULL, NULL) == SHERD_GONE);
    CHECK(sherd_report_hit(none, &hit, NULL, NULL) == SHERD_GONE);
    CHECK(sherd_poses(none, &count) == NULL && count == 0);
    CHECK(sherd_events(none, &count) == NULL && count == 0);
    CHECK(sherd_get_island(none, 0, &island) == SHERD_GONE);
    CHECK(sherd_after_step(none, 1) == SHERD_GONE);
    CHECK(sherd_damage_all(none, &damage, NULL, NULL) == SHERD_GONE);
    CHECK(sherd_work_on_stress(none, zero, 1) == SHERD_GONE);
    CHECK(sherd_world_destroy(none) == SHERD_GONE);
}

static void check_null_pointers(sherd_asset asset, sherd_world world, sherd_object object) {
    const sherd_pose place = {{0, 0, 0}, {0, 0, 0, 1}};
    const float zero[3] = {0, 0, 0};
    sherd_error error = {{0}, {0}};
    sherd_object spawned;
    sherd_world made;
    uint32_t count = 0;
    CHECK(sherd_load(NULL, 3, &asset, 1, &count, &error) == SHERD_BAD_ARGUMENT);
    CHECK(strlen(error.message) > 0);
    CHECK(sherd_load("x", 1, NULL, 1, &count, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_load("x", 1, NULL, 0, NULL, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_asset_get_info(asset, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_asset_fragment(asset, 0, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_asset_hull(asset, 0, 0, NULL, NULL, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_asset_attribute(asset, 0, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_asset_bond(asset, 0, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_asset_indices(asset, NULL) != NULL);
    CHECK(sherd_asset_draw_ranges(asset, 0, NULL, 9) > 0);
    const sherd_body_table empty = {0};
    CHECK(sherd_world_create(NULL, NULL, &made, &error) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_world_create(&empty, NULL, &made, &error) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_world_create(&empty, NULL, NULL, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_spawn(world, asset, NULL, NULL, &spawned, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_spawn(world, asset, &place, NULL, NULL, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_report_contact(world, NULL, NULL, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_report_hit(world, NULL, NULL, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_damage(world, object, NULL, NULL, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_damage_all(world, NULL, NULL, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_anchor_in_box(world, object, NULL, zero, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_work_on_stress(world, NULL, 1) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_save(world, object, NULL, 0, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_save(world, object, NULL, 9, &(size_t){0}) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_restore(world, object, NULL, 9, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_get_island(world, 0, NULL) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_poses(world, NULL) == NULL);
    CHECK(sherd_events(world, NULL) == NULL);
    CHECK(sherd_neighbors(world, object, 0, NULL, 9) == 1); /* the world, of a whole object */
}

static void check_numbers(sherd_asset asset, sherd_world world, sherd_object object) {
    const float nothing = strtof("nan", NULL), endless = strtof("inf", NULL);
    const float off[3] = {nothing, 0, 0};
    sherd_error error = {{0}, {0}};
    sherd_object spawned;
    sherd_pose place = {{0, 0, 0}, {0, 0, 0, 2}};
    CHECK(sherd_spawn(world, asset, &place, NULL, &spawned, &error) == SHERD_BAD_ARGUMENT);
    CHECK(strstr(error.message, "quaternion") != NULL);
    place.rotation[3] = 1;
    sherd_spawn_options options = sherd_default_spawn_options();
    options.damage.toughness_scale = 0;
    CHECK(sherd_spawn(world, asset, &place, &options, &spawned, &error) == SHERD_BAD_ARGUMENT);
    options = sherd_default_spawn_options();
    options.linear_velocity[1] = nothing;
    CHECK(sherd_spawn(world, asset, &place, &options, &spawned, &error) == SHERD_BAD_ARGUMENT);
    sherd_hit hit = {0};
    hit.energy = endless;
    CHECK(sherd_report_hit(world, &hit, NULL, &error) == SHERD_BAD_ARGUMENT);
    sherd_contact contact = {0};
    contact.approach_speed = nothing;
    CHECK(sherd_report_contact(world, &contact, NULL, &error) == SHERD_BAD_ARGUMENT);
    contact.approach_speed = 1;
    contact.effective_mass = -1;
    CHECK(sherd_report_contact(world, &contact, NULL, &error) == SHERD_BAD_ARGUMENT);
    sherd_area_damage damage = sherd_default_area_damage();
    CHECK(sherd_damage(world, object, &damage, NULL, &error) == SHERD_BAD_ARGUMENT); /* no radius */
    damage.radius = 1;
    damage.shape = 3;
    CHECK(sherd_damage(world, object, &damage, NULL, &error) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_damage_all(world, &damage, NULL, &error) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_heal(world, object, nothing) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_work_on_stress(world, off, 1) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_after_step(world, 0) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_after_step(world, nothing) == SHERD_BAD_ARGUMENT);
    CHECK(sherd_break_fragment(world, object, 4000000) == SHERD_GONE);
    CHECK(sherd_detach(world, object, 4000000) == SHERD_GONE);
    CHECK(sherd_anchor(world, object, 4000000, 1) == SHERD_GONE);
    CHECK(sherd_bond_health(world, object, 4000000) == -1);
    CHECK(sherd_fragment_health(world, object, 4000000) == -1);
    CHECK(sherd_overload(world, object, 4000000) == 0);
    CHECK(sherd_find_island(world, object, 4000000) == SHERD_NONE);
    CHECK(sherd_neighbors(world, object, 4000000, NULL, 0) == 0);
}

void check_garbage(sherd_asset asset) {
    struct table* table = calloc(1, sizeof(struct table));
    const sherd_world world = make_world(table);
    const sherd_object object = spawn_at(world, asset, 0);
    const uint64_t made_up[] = {0,  1ULL << 32, 77, 0xDEADBEEFDEADBEEFULL, UINT64_MAX,
                                ((uint64_t)1 << 32) - 1};
    for (size_t i = 0; i < sizeof(made_up) / sizeof(made_up[0]); ++i) {
        const sherd_asset no_asset = {made_up[i]};
        const sherd_world no_world = {made_up[i]};
        const sherd_object no_object = {made_up[i]};
        check_assets(no_asset);
        check_worlds(world, no_object, no_asset);
        check_worlds(no_world, object, asset);
        check_no_world(no_world);
    }
    check_null_pointers(asset, world, object);
    check_numbers(asset, world, object);
    CHECK(sherd_is_alive(world, object));
    CHECK(sherd_remove(world, object) == SHERD_OK);
    const sherd_object other = spawn_at(world, asset, 0); /* in the same place */
    CHECK(other.id != object.id && !sherd_is_alive(world, object));
    CHECK(sherd_world_destroy(world) == SHERD_OK);
    CHECK(table->count == 0);
    check_worlds(world, other, asset);
    check_no_world(world);
    free(table);
}
