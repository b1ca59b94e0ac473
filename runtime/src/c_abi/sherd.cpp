// SPDX-License-Identifier: MIT
// Thin: C structs to C++ values and back. No exception passes: out of memory is a status.
#include "sherd/runtime/sherd.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>
#include <new>
#include <string>
#include <vector>

#include "sherd/runtime/island_world.h"

struct sherd_asset {
    std::shared_ptr<const sherd::Asset> asset;
};

namespace {

using namespace sherd;

glm::vec3 vec(const float* v) {
    return {v[0], v[1], v[2]};
}
void put(float* out, const glm::vec3& v) {
    for (int i = 0; i < 3; ++i) out[i] = v[i];
}
RigidPose pose(const sherd_pose& p) {
    const float* q = p.rotation;
    return {vec(p.translation), glm::quat(q[3], q[0], q[1], q[2])};
}
sherd_pose pose(const RigidPose& p) {
    const glm::quat& q = p.rotation;
    return {{p.translation.x, p.translation.y, p.translation.z}, {q.x, q.y, q.z, q.w}};
}

bool isFinite(const float* v) {
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}
bool isSound(const sherd_pose& p) {
    const glm::quat q = pose(p).rotation;
    return isFinite(p.translation) && std::abs(glm::dot(q, q) - 1) < 1e-3F;
}
bool isSound(const sherd_damage_options& d) {
    return d.toughness_scale > 0 && d.strength_scale > 0 && d.level_scale > 0 &&
           d.minimum_impulse >= 0 && d.minimum_energy >= 0 && d.immunity >= 0;
}
DamageOptions options(const sherd_damage_options& d) {
    DamageOptions result;
    result.toughnessScale = d.toughness_scale;
    result.strengthScale = d.strength_scale;
    result.levelScale = d.level_scale;
    result.minimumImpulse = d.minimum_impulse;
    result.minimumEnergy = d.minimum_energy;
    result.immunity = d.immunity;
    result.maxLevel = d.max_level;
    return result;
}

void say(sherd_error* error, const std::string& message, const std::string& where) {
    if (!error) return;
    const auto copy = [](auto& to, const std::string& from) {
        const size_t length = std::min(from.size(), sizeof(to) - 1);
        std::memcpy(to, from.data(), length);
        to[length] = 0;
    };
    copy(error->message, message);
    copy(error->where, where);
}

ObjectId id(sherd_object object) {
    return {object.index, object.generation};
}
sherd_object id(ObjectId object) {
    return {object.index, object.generation};
}

}  // namespace

/// The engine's functions as a BodyTable, and what was listed last.
struct sherd_world final : sherd::BodyTable {
    explicit sherd_world(const sherd_body_table& given) : table(given), islands(*this) {}

    void create(const IslandBody& body) override {
        const sherd_body out = describe(body);
        table.create(table.user, &out);
    }
    void update(const IslandBody& body) override {
        const sherd_body out = describe(body);
        table.update(table.user, &out);
    }
    void remove(uint32_t island) override { table.remove(table.user, island); }
    [[nodiscard]] BodyMotion motion(uint32_t island) const override {
        sherd_motion m{};
        m.pose.rotation[3] = 1;
        table.get_motion(table.user, island, &m);
        return {pose(m.pose), vec(m.linear_velocity), vec(m.angular_velocity)};
    }

    sherd_body describe(const IslandBody& body) const {
        sherd_body out{};
        out.island = body.island;
        out.object = id(body.object);
        out.asset = handleOf(body.asset);
        out.fragments = body.fragments.data();
        out.fragment_count = uint32_t(body.fragments.size());
        out.mass = body.mass;
        put(out.inertia, body.inertia);
        out.friction = body.friction;
        out.restitution = body.restitution;
        out.frame = pose(body.frame);
        out.motion.pose = pose(body.motion.pose);
        put(out.motion.linear_velocity, body.motion.linearVelocity);
        put(out.motion.angular_velocity, body.motion.angularVelocity);
        return out;
    }
    const sherd_asset* handleOf(const Asset* asset) const { return &handles.at(asset); }
    [[nodiscard]] bool hasFragment(uint32_t island, uint32_t fragment) const {
        if (island >= islands.islands().size() || !islands.island(island).isAlive) return false;
        const auto& fragments = islands.island(island).fragments;
        return std::binary_search(fragments.begin(), fragments.end(), fragment);
    }

    sherd_body_table table;
    std::map<const Asset*, sherd_asset> handles;  ///< the world's own, so that they live as long
    IslandWorld islands;
    std::vector<sherd_fragment_pose> poses;
    std::vector<sherd_break_event> events;
};

namespace {

/// Out of memory in the middle of a change has nothing sound to go back to; before one it has.
template <class Work>
sherd_status guarded(const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return SHERD_NO_MEMORY;
    }
}

}  // namespace

uint32_t sherd_abi_version(void) {
    return SHERD_ABI_VERSION;
}

sherd_status sherd_load(const void* bytes, size_t size, sherd_asset** assets, uint32_t capacity,
                        uint32_t* count, sherd_error* error) {
    if (!count || (!bytes && size > 0) || (!assets && capacity > 0)) {
        say(error, "a pointer is null", "arguments");
        return SHERD_BAD_ARGUMENT;
    }
    *count = 0;
    return guarded([&] {
        const auto loaded = loadAssets(std::span(static_cast<const uint8_t*>(bytes), size));
        if (!loaded) {
            say(error, loaded.error().message, loaded.error().where);
            return loaded.error().code == ErrorCode::limitExceeded ? SHERD_NO_MEMORY
                                                                   : SHERD_MALFORMED;
        }
        *count = uint32_t(loaded->size());
        if (!assets || loaded->size() > capacity) {
            say(error, "the file holds more objects than the array", "capacity");
            return SHERD_TOO_SMALL;
        }
        std::vector<std::unique_ptr<sherd_asset>> made;
        for (const auto& asset : *loaded)
            made.push_back(std::make_unique<sherd_asset>(sherd_asset{asset}));
        for (size_t i = 0; i < made.size(); ++i) assets[i] = made[i].release();
        return SHERD_OK;
    });
}

void sherd_asset_release(sherd_asset* asset) {
    delete asset;
}

const char* sherd_asset_name(const sherd_asset* asset) {
    return asset->asset->name().c_str();
}

uint64_t sherd_asset_bake_hash(const sherd_asset* asset) {
    return asset->asset->bakeHash();
}

uint32_t sherd_asset_fragment_count(const sherd_asset* asset) {
    return asset->asset->fragmentCount();
}

sherd_status sherd_asset_fragment(const sherd_asset* asset, uint32_t fragment,
                                  sherd_fragment* out) {
    if (fragment >= asset->asset->fragmentCount()) return SHERD_BAD_ARGUMENT;
    const Fragment& f = asset->asset->fragment(fragment);
    *out = {f.parent,
            f.children.first,
            f.children.count,
            f.level,
            f.hulls.count,
            f.name.c_str(),
            f.material.c_str(),
            f.mass,
            f.volume,
            f.density,
            f.friction,
            f.restitution,
            {f.centerOfMass.x, f.centerOfMass.y, f.centerOfMass.z}};
    return SHERD_OK;
}

sherd_status sherd_asset_hull(const sherd_asset* asset, uint32_t fragment, uint32_t hull,
                              const float** points, uint32_t* count, float* margin) {
    const FractureSet& set = asset->asset->set();
    if (fragment >= set.fragments.size() || hull >= set.fragments[fragment].hulls.count)
        return SHERD_BAD_ARGUMENT;
    const ConvexHull& found = set.hulls[set.fragments[fragment].hulls.first + hull];
    *points = &set.hullPoints[found.points.first].x;
    *count = found.points.count;
    *margin = found.margin;
    return SHERD_OK;
}

uint32_t sherd_asset_vertex_count(const sherd_asset* asset) {
    return uint32_t(asset->asset->geometry().positions.size());
}

uint32_t sherd_asset_attribute_count(const sherd_asset* asset) {
    return uint32_t(asset->asset->geometry().attributes.size()) + 1;
}

sherd_status sherd_asset_attribute(const sherd_asset* asset, uint32_t attribute,
                                   sherd_attribute* out) {
    const FractureGeometry& geometry = asset->asset->geometry();
    if (attribute > geometry.attributes.size()) return SHERD_BAD_ARGUMENT;
    if (attribute == 0) {
        *out = {"POSITION", 3, geometry.positions.empty() ? nullptr : &geometry.positions[0].x};
    } else {
        const Attribute& found = geometry.attributes[attribute - 1];
        *out = {found.semantic.c_str(), found.components, found.values.data()};
    }
    return SHERD_OK;
}

const uint32_t* sherd_asset_indices(const sherd_asset* asset, uint32_t* count) {
    *count = uint32_t(asset->asset->geometry().indices.size());
    return asset->asset->geometry().indices.data();
}

uint32_t sherd_asset_draw_ranges(const sherd_asset* asset, uint32_t fragment, sherd_draw_range* out,
                                 uint32_t capacity) {
    if (fragment >= asset->asset->fragmentCount()) return 0;
    const auto ranges = asset->asset->drawRanges(fragment);
    for (size_t i = 0; i < std::min<size_t>(ranges.size(), capacity); ++i)
        out[i] = {ranges[i].material, ranges[i].exposedFrom, ranges[i].indices.first,
                  ranges[i].indices.count};
    return uint32_t(ranges.size());
}

uint32_t sherd_asset_bond_count(const sherd_asset* asset) {
    return uint32_t(asset->asset->graph().bonds().size());
}

sherd_damage_options sherd_default_damage_options(void) {
    const DamageOptions d;
    return {d.toughnessScale, d.strengthScale, d.levelScale, d.minimumImpulse,
            d.minimumEnergy,  d.immunity,      d.maxLevel};
}

sherd_spawn_options sherd_default_spawn_options(void) {
    return {sherd_default_damage_options(), 1, {0, 0, 0}, {0, 0, 0}};
}

sherd_world* sherd_world_create(const sherd_body_table* bodies) {
    if (!bodies || !bodies->create || !bodies->update || !bodies->remove || !bodies->get_motion)
        return nullptr;
    return new (std::nothrow) sherd_world(*bodies);
}

void sherd_world_destroy(sherd_world* world) {
    if (!world) return;
    for (uint32_t o = 0; o < world->islands.objectCount(); ++o)
        if (world->islands.isAlive(world->islands.idOf(o))) world->islands.remove(o);
    delete world;
}

sherd_status sherd_spawn(sherd_world* world, const sherd_asset* asset, const sherd_pose* at,
                         const sherd_spawn_options* given, sherd_object* out) {
    if (!world || !asset || !at || !out) return SHERD_BAD_ARGUMENT;
    const sherd_spawn_options spawn = given ? *given : sherd_default_spawn_options();
    if (!isSound(*at) || !isSound(spawn.damage) || !isFinite(spawn.linear_velocity) ||
        !isFinite(spawn.angular_velocity))
        return SHERD_BAD_ARGUMENT;
    return guarded([&] {
        world->handles.try_emplace(asset->asset.get(), sherd_asset{asset->asset});
        BodyMotion motion;
        motion.linearVelocity = vec(spawn.linear_velocity);
        motion.angularVelocity = vec(spawn.angular_velocity);
        *out = id(world->islands.spawn(asset->asset, pose(*at), options(spawn.damage),
                                       spawn.dynamic != 0, motion));
        return SHERD_OK;
    });
}

int32_t sherd_is_alive(const sherd_world* world, sherd_object object) {
    return world->islands.isAlive(id(object)) ? 1 : 0;
}

sherd_status sherd_remove(sherd_world* world, sherd_object object) {
    if (!world->islands.isAlive(id(object))) return SHERD_GONE;
    world->islands.remove(object.index);
    return SHERD_OK;
}

sherd_status sherd_after_step(sherd_world* world, float seconds) {
    if (!(seconds > 0) || !std::isfinite(seconds)) return SHERD_BAD_ARGUMENT;
    world->islands.setTime(world->islands.time() + double(seconds));
    for (uint32_t i = 0; i < world->islands.islands().size(); ++i)
        if (world->islands.island(i).isAlive) world->islands.follow(i);
    return SHERD_OK;
}

sherd_status sherd_report_contact(sherd_world* world, const sherd_contact* contact,
                                  float* consumed) {
    const Contact measured{contact->impulse, contact->approach_speed, contact->effective_mass};
    sherd_hit hit{};
    hit.island = contact->island;
    hit.fragment = contact->fragment;
    std::copy_n(contact->point, 3, hit.point);
    std::copy_n(contact->normal, 3, hit.normal);
    hit.energy = contactEnergy(measured);
    hit.speed = std::max(contact->approach_speed, 0.0F);
    hit.impulse = contact->impulse;
    return sherd_report_hit(world, &hit, consumed);
}

sherd_status sherd_report_hit(sherd_world* world, const sherd_hit* hit, float* consumed) {
    if (consumed) *consumed = 0;
    if (!isFinite(hit->point) || !isFinite(hit->normal) || !(hit->energy >= 0) ||
        !(hit->speed >= 0) || !(hit->impulse >= 0))
        return SHERD_BAD_ARGUMENT;
    if (!world->hasFragment(hit->island, hit->fragment)) return SHERD_GONE;
    return guarded([&] {
        const ReportedHit reported{vec(hit->point), vec(hit->normal), hit->energy, hit->speed,
                                   hit->impulse};
        const float taken = world->islands.takeHit(hit->island, hit->fragment, reported);
        if (consumed) *consumed = taken;
        return SHERD_OK;
    });
}

sherd_status sherd_damage_sphere(sherd_world* world, sherd_object object, const float center[3],
                                 float radius, float fluence, float falloff, uint32_t* broken) {
    if (broken) *broken = 0;
    AreaDamage damage;
    damage.a = vec(center);
    damage.radius = radius;
    damage.fluence = fluence;
    damage.falloff = falloff;
    if (whyRefused(damage)) return SHERD_BAD_ARGUMENT;
    if (!world->islands.isAlive(id(object))) return SHERD_GONE;
    return guarded([&] {
        const uint32_t count = world->islands.dealArea(object.index, damage);
        if (broken) *broken = count;
        return SHERD_OK;
    });
}

sherd_status sherd_break_fragment(sherd_world* world, sherd_object object, uint32_t fragment) {
    return guarded([&] {
        const bool broke = world->islands.isAlive(id(object)) &&
                           world->islands.breakFragment(object.index, fragment, false);
        return broke ? SHERD_OK : SHERD_GONE;
    });
}

sherd_status sherd_break_all(sherd_world* world, sherd_object object) {
    return guarded([&] {
        if (!world->islands.isAlive(id(object))) return SHERD_GONE;
        world->islands.breakAll(object.index);
        return SHERD_OK;
    });
}

sherd_status sherd_anchor(sherd_world* world, sherd_object object, uint32_t fragment,
                          int32_t anchored) {
    return guarded([&] {
        const bool stood = world->islands.isAlive(id(object)) &&
                           world->islands.pinFragment(object.index, fragment, anchored != 0);
        return stood ? SHERD_OK : SHERD_GONE;
    });
}

const sherd_fragment_pose* sherd_poses(sherd_world* world, uint32_t* count) {
    world->poses.clear();
    for (const FragmentPose& p : world->islands.poses())
        world->poses.push_back(
            {id(p.object), world->handleOf(p.asset), p.fragment, pose(p.pose), pose(p.previous)});
    *count = uint32_t(world->poses.size());
    return world->poses.data();
}

const sherd_break_event* sherd_events(sherd_world* world, uint32_t* count) {
    world->events.clear();
    for (const BreakEvent& e : world->islands.takeEvents()) {
        sherd_break_event out{};
        out.object = id(e.object);
        out.asset = world->handleOf(e.asset);
        out.fragment = e.fragment;
        out.level = e.level;
        out.bonds = e.bonds;
        out.bodies = e.bodies;
        out.area = e.area;
        put(out.point, e.point);
        put(out.normal, e.normal);
        out.impulse = e.impulse;
        out.energy = e.energy;
        out.consumed = e.consumed;
        out.approach_speed = e.approachSpeed;
        out.time = e.time;
        world->events.push_back(out);
    }
    *count = uint32_t(world->events.size());
    return world->events.data();
}

float sherd_bond_health(const sherd_world* world, sherd_object object, uint32_t bond) {
    if (!world->islands.isAlive(id(object))) return -1;
    const Structure& structure = *world->islands.object(object.index).structure;
    return bond < structure.graph().bonds().size() ? structure.health(bond) : -1;
}
