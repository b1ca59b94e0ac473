// SPDX-License-Identifier: MIT
// The part of sherd.h about worlds. No exception passes: out of memory is a status.
#include <cmath>

#include "c_abi/table_world.h"
#include "core/finite.h"
#include "sherd/runtime/object_state.h"

using namespace sherd;
using namespace sherd::c_abi;

namespace {

HandleTable<TableWorld>& worlds() {
    static auto* table = new HandleTable<TableWorld>;
    return *table;
}

/// A world that exists and is doing nothing: kept, and busy, for as long as this lives.
class Entered {
  public:
    explicit Entered(sherd_world handle) : world_(worlds().find(handle.id)) {
        isFree_ = world_ && !world_->isBusy;
        if (isFree_) world_->isBusy = true;
    }
    ~Entered() {
        if (isFree_) world_->isBusy = false;
    }
    Entered(const Entered&) = delete;
    Entered& operator=(const Entered&) = delete;

    explicit operator bool() const { return isFree_; }
    TableWorld* operator->() const { return world_.get(); }
    TableWorld& operator*() const { return *world_; }
    /// Why not.
    [[nodiscard]] sherd_status status() const { return world_ ? SHERD_BUSY : SHERD_GONE; }

  private:
    std::shared_ptr<TableWorld> world_;
    bool isFree_ = false;
};

/// Does something to a living object, by its index, and answers what that does.
template <class Work>
sherd_status withObject(sherd_world handle, sherd_object object, const Work& work) {
    const Entered world(handle);
    if (!world) return world.status();
    const ObjectId id = toObject(object);
    if (!world->islands.isAlive(id)) return SHERD_GONE;
    return guarded([&] { return work(world->islands, id.index); });
}

sherd_status goneUnless(bool done) {
    return done ? SHERD_OK : SHERD_GONE;
}

const char* whyRefused(const sherd_area_damage& damage) {
    if (damage.shape < SHERD_SPHERE || damage.shape > SHERD_BOX) return "there is no such shape";
    return sherd::whyRefused(toArea(damage));
}

sherd_status takeHit(sherd_world handle, uint32_t island, uint32_t fragment, const ReportedHit& hit,
                     float* consumed, sherd_error* error) {
    if (const char* why = sherd::whyRefused(hit)) return say(error, SHERD_BAD_ARGUMENT, why, "hit");
    const Entered world(handle);
    if (!world) return world.status();
    if (!world->hasFragment(island, fragment)) return SHERD_GONE;
    return guarded([&] {
        const float taken = world->islands.takeHit(island, fragment, hit);
        if (consumed) *consumed = taken;
        return SHERD_OK;
    });
}

}  // namespace

sherd_damage_options sherd_default_damage_options(void) {
    return fromOptions({});
}

sherd_world_options sherd_default_world_options(void) {
    return {sherd_default_damage_options(), 65536};
}

sherd_spawn_options sherd_default_spawn_options(void) {
    return {sherd_default_damage_options(), 1, {0, 0, 0}, {0, 0, 0}};
}

sherd_area_damage sherd_default_area_damage(void) {
    sherd_area_damage damage{};
    damage.rotation[3] = 1;
    damage.falloff = 1;
    return damage;
}

sherd_status sherd_world_create(const sherd_body_table* bodies, const sherd_world_options* given,
                                sherd_world* out, sherd_error* error) {
    if (!bodies || !out) return say(error, SHERD_BAD_ARGUMENT, "a pointer is null", "arguments");
    if (!bodies->create || !bodies->update || !bodies->remove || !bodies->get_motion)
        return say(error, SHERD_BAD_ARGUMENT, "a function is missing", "bodies");
    const sherd_world_options options = given ? *given : sherd_default_world_options();
    if (const char* why = sherd::whyRefused(toOptions(options.damage)))
        return say(error, SHERD_BAD_ARGUMENT, why, "options.damage");
    return guarded([&] {
        *out = {worlds().add(std::make_shared<TableWorld>(*bodies, options))};
        return SHERD_OK;
    });
}

sherd_status sherd_world_destroy(sherd_world handle) {
    const Entered world(handle);
    if (!world) return world.status();
    world->removeAll();
    worlds().release(handle.id);
    return SHERD_OK;
}

sherd_status sherd_spawn(sherd_world handle, sherd_asset asset, const sherd_pose* at,
                         const sherd_spawn_options* given, sherd_object* out, sherd_error* error) {
    if (!at || !out) return say(error, SHERD_BAD_ARGUMENT, "a pointer is null", "arguments");
    const sherd_spawn_options options = given ? *given : sherd_default_spawn_options();
    const BodyMotion motion{pose(*at), vec(options.linear_velocity), vec(options.angular_velocity)};
    if (const char* why = sherd::whyRefused(motion))
        return say(error, SHERD_BAD_ARGUMENT, why, "pose, options");
    const DamageOptions damage = toOptions(options.damage);
    if (const char* why = sherd::whyRefused(damage))
        return say(error, SHERD_BAD_ARGUMENT, why, "options.damage");
    const Entered world(handle);
    if (!world) return say(error, world.status(), "there is no such world, or it is busy", "world");
    const auto found = assets().find(asset.id);
    if (!found) return say(error, SHERD_GONE, "there is no such asset", "asset");
    return guarded([&] {
        world->keep(found.get(), asset);
        *out = fromObject(world->islands.spawn(found, motion.pose, combine(world->damage, damage),
                                               options.dynamic != 0, motion));
        return SHERD_OK;
    });
}

sherd_status sherd_remove(sherd_world world, sherd_object object) {
    return withObject(world, object, [](IslandWorld& islands, uint32_t index) {
        islands.remove(index);
        return SHERD_OK;
    });
}

int32_t sherd_is_alive(sherd_world world, sherd_object object) {
    const auto isThere = [](IslandWorld&, uint32_t) { return SHERD_OK; };
    return withObject(world, object, isThere) == SHERD_OK ? 1 : 0;
}

sherd_status sherd_after_step(sherd_world handle, float seconds) {
    if (!(seconds > 0) || !std::isfinite(seconds)) return SHERD_BAD_ARGUMENT;
    const Entered world(handle);
    if (!world) return world.status();
    world->islands.setTime(world->islands.time() + double(seconds));
    for (uint32_t i = 0; i < world->islands.islands().size(); ++i)
        if (world->isAlive(i)) world->islands.follow(i);
    return SHERD_OK;
}

sherd_status sherd_report_contact(sherd_world world, const sherd_contact* contact, float* consumed,
                                  sherd_error* error) {
    if (consumed) *consumed = 0;
    if (!contact) return say(error, SHERD_BAD_ARGUMENT, "a pointer is null", "contact");
    const Contact measured{contact->impulse, contact->approach_speed, contact->effective_mass};
    if (const char* why = sherd::whyRefused(measured))
        return say(error, SHERD_BAD_ARGUMENT, why, "contact");
    ReportedHit hit{vec(contact->point), vec(contact->normal)};
    hit.energy = contactEnergy(measured);
    hit.speed = std::max(contact->approach_speed, 0.0F);
    hit.impulse = contact->impulse;
    return takeHit(world, contact->island, contact->fragment, hit, consumed, error);
}

sherd_status sherd_report_hit(sherd_world world, const sherd_hit* hit, float* consumed,
                              sherd_error* error) {
    if (consumed) *consumed = 0;
    if (!hit) return say(error, SHERD_BAD_ARGUMENT, "a pointer is null", "hit");
    const ReportedHit reported{vec(hit->point), vec(hit->normal), hit->energy, hit->speed,
                               hit->impulse};
    return takeHit(world, hit->island, hit->fragment, reported, consumed, error);
}

sherd_status sherd_damage(sherd_world world, sherd_object object, const sherd_area_damage* damage,
                          uint32_t* broken, sherd_error* error) {
    if (broken) *broken = 0;
    if (!damage) return say(error, SHERD_BAD_ARGUMENT, "a pointer is null", "damage");
    if (const char* why = whyRefused(*damage)) return say(error, SHERD_BAD_ARGUMENT, why, "damage");
    return withObject(world, object, [&](IslandWorld& islands, uint32_t index) {
        const uint32_t bonds = islands.dealArea(index, toArea(*damage));
        if (broken) *broken = bonds;
        return SHERD_OK;
    });
}

sherd_status sherd_damage_all(sherd_world handle, const sherd_area_damage* damage, uint32_t* broken,
                              sherd_error* error) {
    if (broken) *broken = 0;
    if (!damage) return say(error, SHERD_BAD_ARGUMENT, "a pointer is null", "damage");
    if (const char* why = whyRefused(*damage)) return say(error, SHERD_BAD_ARGUMENT, why, "damage");
    const Entered world(handle);
    if (!world) return world.status();
    return guarded([&] {
        uint32_t bonds = 0;
        for (uint32_t o = 0; o < world->islands.objectCount(); ++o)
            if (world->islands.isAlive(world->islands.idOf(o)))
                bonds += world->islands.dealArea(o, toArea(*damage));
        if (broken) *broken = bonds;
        return SHERD_OK;
    });
}

sherd_status sherd_break_fragment(sherd_world world, sherd_object object, uint32_t fragment) {
    return withObject(world, object, [&](IslandWorld& islands, uint32_t index) {
        return goneUnless(islands.breakFragment(index, fragment, false));
    });
}

sherd_status sherd_detach(sherd_world world, sherd_object object, uint32_t fragment) {
    return withObject(world, object, [&](IslandWorld& islands, uint32_t index) {
        return goneUnless(islands.breakFragment(index, fragment, true));
    });
}

sherd_status sherd_break_all(sherd_world world, sherd_object object) {
    return withObject(world, object, [](IslandWorld& islands, uint32_t index) {
        islands.breakAll(index);
        return SHERD_OK;
    });
}

sherd_status sherd_heal(sherd_world world, sherd_object object, float share) {
    if (!(share >= 0 && share <= 1)) return SHERD_BAD_ARGUMENT;
    return withObject(world, object, [&](IslandWorld& islands, uint32_t index) {
        heal(*islands.object(index).structure, share);
        return SHERD_OK;
    });
}

sherd_status sherd_anchor(sherd_world world, sherd_object object, uint32_t fragment,
                          int32_t anchored) {
    return withObject(world, object, [&](IslandWorld& islands, uint32_t index) {
        return goneUnless(islands.pinFragment(index, fragment, anchored != 0));
    });
}

sherd_status sherd_set_load(sherd_world world, sherd_object object, uint32_t fragment,
                            const float force[3]) {
    if (!force) return SHERD_BAD_ARGUMENT;
    return withObject(world, object, [&](IslandWorld& islands, uint32_t index) {
        return islands.setLoad(index, {fragment, vec(force)}) ? SHERD_OK : SHERD_BAD_ARGUMENT;
    });
}

sherd_status sherd_remove_piece(sherd_world world, sherd_object object, uint32_t fragment) {
    return withObject(world, object, [&](IslandWorld& islands, uint32_t index) {
        const uint32_t island = islands.findIsland(index, fragment);
        if (island == UINT32_MAX) return SHERD_GONE;
        islands.removeIsland(island, RemovalReason::game);
        (void)islands.takeRemovals();
        return SHERD_OK;
    });
}

sherd_status sherd_anchor_in_box(sherd_world world, sherd_object object, const float low[3],
                                 const float high[3], uint32_t* leaves) {
    if (leaves) *leaves = 0;
    if (!low || !high) return SHERD_BAD_ARGUMENT;
    return withObject(world, object, [&](IslandWorld& islands, uint32_t index) {
        const uint32_t pinned = islands.pinInBox(index, vec(low), vec(high));
        if (leaves) *leaves = pinned;
        return SHERD_OK;
    });
}

sherd_status sherd_work_on_stress(sherd_world handle, const float gravity[3], uint32_t iterations) {
    if (!gravity || !isFinite(vec(gravity))) return SHERD_BAD_ARGUMENT;
    const Entered world(handle);
    if (!world) return world.status();
    return guarded([&] {
        world->islands.workOnStress(vec(gravity), iterations);
        return SHERD_OK;
    });
}

sherd_status sherd_allow_bodies(sherd_world handle, uint32_t bodies, uint32_t moving) {
    const Entered world(handle);
    if (!world) return world.status();
    world->islands.allowBodies(bodies);
    world->islands.allowAwake(moving);
    return SHERD_OK;
}

sherd_status sherd_save(sherd_world world, sherd_object object, void* bytes, size_t capacity,
                        size_t* size) {
    if (size) *size = 0;
    if (!size || (!bytes && capacity > 0)) return SHERD_BAD_ARGUMENT;
    return withObject(world, object, [&](IslandWorld& islands, uint32_t index) {
        const std::vector<uint8_t> saved = saveObject(islands, index);
        *size = saved.size();
        if (saved.size() > capacity) return SHERD_TOO_SMALL;
        std::memcpy(bytes, saved.data(), saved.size());
        return SHERD_OK;
    });
}

sherd_status sherd_restore(sherd_world world, sherd_object object, const void* bytes, size_t size,
                           sherd_error* error) {
    if (!bytes) return say(error, SHERD_BAD_ARGUMENT, "a pointer is null", "bytes");
    return withObject(world, object, [&](IslandWorld& islands, uint32_t index) {
        auto saved = readSavedObject(islands.object(index).asset,
                                     std::span(static_cast<const uint8_t*>(bytes), size));
        if (!saved) return say(error, SHERD_MALFORMED, saved.error().message, saved.error().where);
        restoreObject(islands, index, std::move(*saved));
        return SHERD_OK;
    });
}

const sherd_fragment_pose* sherd_poses(sherd_world handle, uint32_t* count) {
    if (count) *count = 0;
    const Entered world(handle);
    if (!world || !count) return nullptr;
    const sherd_status listed = guarded([&] {
        world->poses.clear();
        for (const FragmentPose& p : world->islands.poses())
            world->poses.push_back({fromObject(p.object), world->handleOf(p.object, p.asset),
                                    p.fragment, pose(p.pose), pose(p.previous), p.scale});
        return SHERD_OK;
    });
    if (listed != SHERD_OK) return nullptr;
    *count = uint32_t(world->poses.size());
    return world->poses.empty() ? nullptr : world->poses.data();
}

const sherd_break_event* sherd_events(sherd_world handle, uint32_t* count) {
    if (count) *count = 0;
    const Entered world(handle);
    if (!world || !count) return nullptr;
    const sherd_status listed = guarded([&] {
        world->events.clear();
        for (const BreakEvent& e : world->islands.takeEvents())
            world->events.push_back(fromEvent(e, world->handleOf(e.object, e.asset)));
        return SHERD_OK;
    });
    if (listed != SHERD_OK) return nullptr;
    *count = uint32_t(world->events.size());
    return world->events.empty() ? nullptr : world->events.data();
}

sherd_status sherd_get_island(sherd_world handle, uint32_t island, sherd_island* out) {
    if (!out) return SHERD_BAD_ARGUMENT;
    const Entered world(handle);
    if (!world) return world.status();
    if (!world->isAlive(island)) return SHERD_GONE;
    const IslandWorld::Island& found = world->islands.island(island);
    const IslandWorld::Object& object = world->islands.objectOf(island);
    *out = {};
    out->object = fromObject(world->islands.idOf(found.object));
    out->asset = world->handleOf(object.asset.get());
    out->fragments = found.fragments.data();
    out->fragment_count = uint32_t(found.fragments.size());
    out->is_fixed = found.isFixed ? 1 : 0;
    out->is_anchored = found.isAnchored ? 1 : 0;
    out->age = world->islands.time() - found.bornAt;
    out->pose = pose(world->islands.placesOf(island).now);
    return SHERD_OK;
}

uint32_t sherd_find_island(sherd_world handle, sherd_object object, uint32_t fragment) {
    const Entered world(handle);
    const ObjectId id = toObject(object);
    return world && world->islands.isAlive(id) ? world->islands.findIsland(id.index, fragment)
                                               : SHERD_NONE;
}

uint32_t sherd_island_count(sherd_world handle, sherd_object object) {
    const Entered world(handle);
    const ObjectId id = toObject(object);
    return world && world->islands.isAlive(id)
               ? uint32_t(world->islands.object(id.index).islands.size())
               : 0;
}

float sherd_bond_health(sherd_world handle, sherd_object object, uint32_t bond) {
    const Entered world(handle);
    const Structure* structure = world ? world->structureOf(object) : nullptr;
    return structure && bond < structure->graph().bonds().size() ? structure->health(bond) : -1;
}

float sherd_fragment_health(sherd_world handle, sherd_object object, uint32_t fragment) {
    const Entered world(handle);
    const Structure* structure = world ? world->structureOf(object) : nullptr;
    return structure && fragment < structure->asset().fragmentCount()
               ? healthOf(*structure, fragment)
               : -1;
}

float sherd_overload(sherd_world handle, sherd_object object, uint32_t bond) {
    const Entered world(handle);
    const Structure* structure = world ? world->structureOf(object) : nullptr;
    return structure && bond < structure->graph().bonds().size()
               ? world->islands.overload(toObject(object).index, bond)
               : 0;
}

uint32_t sherd_neighbors(sherd_world handle, sherd_object object, uint32_t fragment,
                         sherd_neighbor* out, uint32_t capacity) {
    const Entered world(handle);
    const Structure* structure = world ? world->structureOf(object) : nullptr;
    if (!structure) return 0;
    std::vector<Neighbor>& found = world->neighbors;
    const sherd_status listed = guarded([&] {
        findNeighbors(*structure, fragment, found);
        return SHERD_OK;
    });
    if (listed != SHERD_OK) return 0;
    for (size_t i = 0; out && i < std::min<size_t>(found.size(), capacity); ++i)
        out[i] = {found[i].fragment, found[i].area, found[i].health};
    return uint32_t(found.size());
}
