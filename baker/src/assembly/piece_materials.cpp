// SPDX-License-Identifier: MIT
#include "assembly/piece_materials.h"

#include <algorithm>

#include "geometry/triangle.h"

namespace sherd {
namespace {

/// Square metres per leaf and material: [leaf * materials + material].
class Areas {
  public:
    Areas(size_t leaves, size_t materials) : materials_(materials), of_(leaves * materials, 0.0) {}

    void add(uint32_t leaf, uint32_t material, const std::vector<glm::vec3>& positions,
             const std::array<uint32_t, 3>& v) {
        of_[leaf * materials_ + material] += triangleArea(positions, v);
    }

    /// The largest of the leaves together; nothing if they have no area.
    std::optional<uint32_t> largest(const Hierarchy& hierarchy, Range ranks) const {
        std::vector<double> sums(materials_, 0.0);
        for (uint32_t r = ranks.first; r < ranks.first + ranks.count; ++r)
            for (size_t m = 0; m < materials_; ++m)
                sums[m] += of_[hierarchy.leafOrder[r] * materials_ + m];
        const auto most = std::max_element(sums.begin(), sums.end());
        if (most == sums.end() || !(*most > 0)) return std::nullopt;
        return static_cast<uint32_t>(most - sums.begin());
    }

  private:
    size_t materials_;
    std::vector<double> of_;
};

}  // namespace

std::vector<uint32_t> coveringMaterials(const PieceMaterialInput& input) {
    const size_t leaves = input.components.leafCount;
    Areas outer(leaves, input.mesh.materials.size());
    Areas hidden(leaves, input.mesh.materials.size());
    for (size_t t = 0; t < input.surface.triangles.size(); ++t) {
        const SplitTriangle& triangle = input.surface.triangles[t];
        outer.add(input.components.leaf[t], input.mesh.triangleMaterials[triangle.source],
                  input.surface.positions, triangle.v);
    }
    for (const HiddenMesh::Face& face : input.hidden.faces)
        hidden.add(face.leaf, face.material, input.hidden.positions, face.v);
    std::vector<uint32_t> covering;
    for (const Range ranks : input.hierarchy.leaves) {
        std::optional<uint32_t> most = outer.largest(input.hierarchy, ranks);
        if (!most) most = hidden.largest(input.hierarchy, ranks);
        covering.push_back(most.value_or(0));
    }
    return covering;
}

void apply(const PhysicalMaterial& material, Fragment& fragment) {
    const auto set = [](float& target, const std::optional<double>& said) {
        if (said) target = static_cast<float>(*said);
    };
    set(fragment.density, material.density);
    set(fragment.friction, material.friction);
    set(fragment.restitution, material.restitution);
    set(fragment.strength, material.strength);
    set(fragment.toughness, material.toughness);
}

void assembleMaterials(const PieceMaterialInput& input,
                       const std::map<std::string, PhysicalMaterial>& materials, FractureSet& set) {
    if (materials.empty() || input.names.empty()) return;
    const std::vector<uint32_t> covering = coveringMaterials(input);
    for (size_t f = 0; f < set.fragments.size(); ++f) {
        const auto name = input.names.find(input.mesh.materials[covering[f]]);
        if (name == input.names.end()) continue;
        const auto said = materials.find(name->second);
        if (said == materials.end()) continue;
        set.fragments[f].material = said->first;
        apply(said->second, set.fragments[f]);
    }
}

}  // namespace sherd
