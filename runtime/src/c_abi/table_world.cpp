// SPDX-License-Identifier: MIT
#include "c_abi/table_world.h"

namespace sherd::c_abi {

TableWorld::TableWorld(const sherd_body_table& given, const sherd_world_options& options)
    : damage(toOptions(options.damage)),
      islands(*this, options.max_pending_events),
      table_(given) {}

TableWorld::~TableWorld() {
    for (const auto& [asset, handle] : handles_) assets().letGo(handle.id);
}

void TableWorld::keep(const Asset* asset, sherd_asset handle) {
    if (handles_.try_emplace(asset, handle).second) assets().hold(handle.id);
    originals_.try_emplace(&asset->original(), handle);
}

sherd_asset TableWorld::handleOf(ObjectId object, const Asset* original) const {
    if (islands.isAlive(object)) return handleOf(islands.object(object.index).asset.get());
    return originals_.at(original);
}

void TableWorld::create(const IslandBody& body) {
    remember(body);
    const sherd_body out = describe(body);
    table_.create(table_.user, &out);
}

void TableWorld::update(const IslandBody& body) {
    remember(body);
    const sherd_body out = describe(body);
    table_.update(table_.user, &out);
}

void TableWorld::remember(const IslandBody& body) {
    if (known_.size() <= body.island) known_.resize(body.island + 1);
    known_[body.island] = body.motion;
}

BodyMotion TableWorld::motion(uint32_t island) const {
    sherd_motion given{};
    given.pose.rotation[3] = 1;
    table_.get_motion(table_.user, island, &given);
    const BodyMotion motion{pose(given.pose), vec(given.linear_velocity),
                            vec(given.angular_velocity)};
    if (!whyRefused(motion)) known_[island] = motion;
    return known_[island];
}

sherd_body TableWorld::describe(const IslandBody& body) const {
    sherd_body out{};
    out.island = body.island;
    out.object = fromObject(body.object);
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

bool TableWorld::hasFragment(uint32_t island, uint32_t fragment) const {
    if (!isAlive(island)) return false;
    const auto& fragments = islands.island(island).fragments;
    return std::binary_search(fragments.begin(), fragments.end(), fragment);
}

const Structure* TableWorld::structureOf(sherd_object object) const {
    const ObjectId id = toObject(object);
    return islands.isAlive(id) ? islands.object(id.index).structure.get() : nullptr;
}

void TableWorld::removeAll() {
    for (uint32_t o = 0; o < islands.objectCount(); ++o)
        if (islands.isAlive(islands.idOf(o))) islands.remove(o);
}

DamageOptions toOptions(const sherd_damage_options& options) {
    DamageOptions result;
    result.toughnessScale = options.toughness_scale;
    result.strengthScale = options.strength_scale;
    result.levelScale = options.level_scale;
    result.minimumImpulse = options.minimum_impulse;
    result.minimumEnergy = options.minimum_energy;
    result.immunity = options.immunity;
    result.maxLevel = options.max_level;
    return result;
}

sherd_damage_options fromOptions(const DamageOptions& d) {
    return {d.toughnessScale, d.strengthScale, d.levelScale, d.minimumImpulse,
            d.minimumEnergy,  d.immunity,      d.maxLevel};
}

AreaDamage toArea(const sherd_area_damage& damage) {
    AreaDamage result;
    result.shape = AreaDamage::Shape(damage.shape);
    result.a = vec(damage.a);
    result.b = vec(damage.b);
    const float* q = damage.rotation;
    result.rotation = glm::quat(q[3], q[0], q[1], q[2]);
    result.radius = damage.radius;
    result.fluence = damage.fluence;
    result.falloff = damage.falloff;
    result.shear = vec(damage.shear);
    return result;
}

sherd_break_event fromEvent(const BreakEvent& event, sherd_asset asset) {
    sherd_break_event out{};
    out.object = fromObject(event.object);
    out.asset = asset;
    out.fragment = event.fragment;
    out.level = event.level;
    out.bonds = event.bonds;
    out.bodies = event.bodies;
    out.area = event.area;
    put(out.point, event.point);
    put(out.normal, event.normal);
    out.impulse = event.impulse;
    out.energy = event.energy;
    out.consumed = event.consumed;
    out.approach_speed = event.approachSpeed;
    out.time = event.time;
    return out;
}

}  // namespace sherd::c_abi
