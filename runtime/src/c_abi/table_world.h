// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <vector>

#include "c_abi/convert.h"
#include "sherd/runtime/structure_queries.h"

namespace sherd::c_abi {

/// The engine's functions as a BodyTable, and what was listed last.
class TableWorld final : public BodyTable {
  public:
    TableWorld(const sherd_body_table& given, const sherd_world_options& options);
    ~TableWorld() override;
    TableWorld(const TableWorld&) = delete;
    TableWorld& operator=(const TableWorld&) = delete;

    void create(const IslandBody& body) override;
    void update(const IslandBody& body) override;
    void remove(uint32_t island) override { table_.remove(table_.user, island); }
    [[nodiscard]] BodyMotion motion(uint32_t island) const override;

    /// Before an asset is used: it and its number live as long as this.
    void keep(const Asset* asset, sherd_asset handle);
    [[nodiscard]] sherd_asset handleOf(const Asset* asset) const { return handles_.at(asset); }
    /// What an object was spawned of, in its size; of one that is gone by now, in some size.
    [[nodiscard]] sherd_asset handleOf(ObjectId object, const Asset* original) const;

    [[nodiscard]] bool isAlive(uint32_t island) const {
        return island < islands.islands().size() && islands.island(island).isAlive;
    }
    [[nodiscard]] bool hasFragment(uint32_t island, uint32_t fragment) const;
    /// Null when it is gone.
    [[nodiscard]] const Structure* structureOf(sherd_object object) const;
    void removeAll();

    const DamageOptions damage;
    bool isBusy = false;  ///< a call is running
    IslandWorld islands;
    std::vector<sherd_fragment_pose> poses;
    std::vector<sherd_break_event> events;
    std::vector<Neighbor> neighbors;

  private:
    [[nodiscard]] sherd_body describe(const IslandBody& body) const;
    void remember(const IslandBody& body);

    sherd_body_table table_;
    std::map<const Asset*, sherd_asset> handles_;
    std::map<const Asset*, sherd_asset> originals_;  ///< to the first of them in any size
    mutable std::vector<BodyMotion> known_;          ///< per island: its last sound motion
};

DamageOptions toOptions(const sherd_damage_options& options);
sherd_damage_options fromOptions(const DamageOptions& options);
AreaDamage toArea(const sherd_area_damage& damage);
sherd_break_event fromEvent(const BreakEvent& event, sherd_asset asset);

}  // namespace sherd::c_abi
