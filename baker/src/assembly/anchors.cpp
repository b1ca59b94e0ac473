// SPDX-License-Identifier: MIT
#include "assembly/anchors.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <utility>

#include "assembly/anchor_places.h"
#include "geometry/bounds.h"
#include "message_text.h"

namespace sherd {
namespace {

/// How near a border counts as on it: share of the diagonal.
constexpr double kSlack = 1e-5;
/// Smaller shares of a leaf's outer surface are rounding, and no hold.
constexpr double kLeastShare = 1e-6;

AnchorPlace::Polygon corners(const std::vector<glm::vec3>& positions,
                             const std::array<uint32_t, 3>& v) {
    return {positions[v[0]], positions[v[1]], positions[v[2]]};
}

class AnchorMaker {
  public:
    AnchorMaker(const AnchorInput& input, FractureSet& set) : in_(input), set_(set) {
        for (size_t i = 0; i < in_.anchors.size(); ++i)
            if (in_.anchors[i].kind != RecipeAnchor::Kind::label)
                places_.emplace_back(
                    i, AnchorPlace(in_.anchors[i], set.restPose, kSlack * in_.diagonal));
    }

    std::vector<bool> run() {
        findNamed();
        if (!places_.empty() || !named_.empty()) measure();
        std::vector<bool> holds(in_.anchors.size(), false);
        for (const auto& [key, part] : held_) {
            const auto& [leaf, cause] = key;
            if (!(part.area > kLeastShare * outside_[leaf].area)) continue;
            if (cause < holds.size()) holds[cause] = true;
            addBond(leaf, cause, part);
        }
        return holds;
    }

  private:
    /// Leaves that are held as a whole, and by what first.
    void findNamed() {
        const auto holdAll = [&](uint32_t fragment, size_t cause) {
            const Range leaves = in_.hierarchy.leaves[fragment];
            for (uint32_t r = leaves.first; r < leaves.first + leaves.count; ++r)
                named_.try_emplace(in_.hierarchy.leafOrder[r], cause);
        };
        for (size_t i = 0; i < in_.anchors.size(); ++i) {
            if (in_.anchors[i].kind != RecipeAnchor::Kind::label) continue;
            for (uint32_t f = 0; f < set_.fragments.size(); ++f)
                if (set_.fragments[f].name == in_.anchors[i].label) holdAll(f, i);
        }
        for (const PlacedLabel& placed : in_.labels)
            if (placed.label->anchor)
                holdAll(fragmentOf(placed, in_.components, in_.hierarchy), in_.anchors.size());
    }

    void measure() {
        outside_.resize(in_.components.leafCount);
        for (uint32_t t = 0; t < in_.surface.triangles.size(); ++t) {
            const uint32_t leaf = in_.components.leaf[t];
            const auto name = named_.find(leaf);
            if (places_.empty() && name == named_.end()) continue;
            std::vector<AnchorPlace::Polygon> rest{
                corners(in_.surface.positions, in_.surface.triangles[t].v)};
            outside_[leaf].add(partOf(rest[0]));
            for (const auto& [cause, place] : places_) {
                std::vector<AnchorPlace::Polygon> left;
                SurfacePart inside;
                for (const AnchorPlace::Polygon& polygon : rest) place.take(polygon, inside, left);
                if (inside.area > 0) held_[{leaf, cause}].add(inside);
                rest = std::move(left);
            }
            if (name == named_.end()) continue;
            for (const AnchorPlace::Polygon& polygon : rest)
                held_[{leaf, name->second}].add(partOf(polygon));
        }
    }

    void addBond(uint32_t leaf, size_t cause, const SurfacePart& part) {
        const RecipeAnchor* said = cause < in_.anchors.size() ? &in_.anchors[cause] : nullptr;
        const bool place = said != nullptr && said->kind != RecipeAnchor::Kind::label;
        const uint32_t f = in_.hierarchy.fragmentOfRank[in_.hierarchy.rankOfLeaf[leaf]];
        const double length = glm::length(part.normal);
        Bond bond;
        bond.a = static_cast<int32_t>(f);
        bond.b = -1;
        bond.area = static_cast<float>(place ? part.area : 0.5 * part.area);
        bond.centroid = glm::vec3(part.moment / part.area);
        // A leaf that is all around has no side of its own: it stands.
        bond.normal =
            length > 1e-6 * part.area ? glm::vec3(part.normal / length) : glm::vec3(0, -1, 0);
        bond.strength = set_.fragments[f].strength;
        bond.toughness = set_.fragments[f].toughness;
        if (said != nullptr && said->strength) bond.strength = static_cast<float>(*said->strength);
        if (said != nullptr && said->toughness)
            bond.toughness = static_cast<float>(*said->toughness);
        set_.bonds.push_back(bond);
    }

    const AnchorInput& in_;
    FractureSet& set_;
    std::vector<std::pair<size_t, AnchorPlace>> places_;  ///< with their number among the anchors
    std::map<uint32_t, size_t> named_;                    ///< leaf -> what holds it as a whole
    std::map<std::pair<uint32_t, size_t>, SurfacePart> held_;  ///< by leaf and what holds it
    std::vector<SurfacePart> outside_;                         ///< per leaf
};

}  // namespace

std::vector<bool> assembleAnchors(const AnchorInput& input, FractureSet& set) {
    return AnchorMaker(input, set).run();
}

bool holdsAnything(const RecipeAnchor& anchor, const SurfaceMesh& mesh) {
    const double diagonal = boundsOf(mesh.positions, mesh.triangles).diagonal();
    const AnchorPlace place(anchor, mesh.restPose, kSlack * diagonal);
    SurfacePart inside;
    std::vector<AnchorPlace::Polygon> rest;
    for (const auto& triangle : mesh.triangles) {
        place.take(corners(mesh.positions, triangle), inside, rest);
        if (inside.area > 0) return true;
        rest.clear();
    }
    return false;
}

std::string extentsInScene(const SurfaceMesh& mesh) {
    Bounds box;
    const glm::dquat rotation(mesh.restPose.rotation);
    for (const auto& triangle : mesh.triangles)
        for (const uint32_t v : triangle)
            box.add(rotation * glm::dvec3(mesh.positions[v]) +
                    glm::dvec3(mesh.restPose.translation));
    return "reaches from " + at(box.low) + " to " + at(box.high) + " in the scene";
}

}  // namespace sherd
