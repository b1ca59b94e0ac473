// SPDX-License-Identifier: MIT
#include "assembly/geometry.h"

#include <algorithm>
#include <numeric>

#include "assembly/hidden_vertices.h"
#include "assembly/outer_vertices.h"

namespace sherd {
namespace {

/// A stable order by leaf rank: triangles of one leaf keep their own order.
template <class RankOf>
std::vector<uint32_t> orderByRank(size_t count, RankOf&& rankOf) {
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return rankOf(a) < rankOf(b); });
    return order;
}

class GeometryAssembler {
  public:
    GeometryAssembler(const AssemblyInput& input, FractureSet& set)
        : in_(input),
          set_(set),
          outer_(input.mesh, input.surface, set.geometry),
          hidden_(input.hidden, input.settings.depthColor, set.geometry) {}

    void run() {
        const auto& surface = in_.surface;
        const auto rank = [&](uint32_t t) {
            return in_.hierarchy.rankOfLeaf[in_.components.leaf[t]];
        };
        const std::vector<uint32_t> outerOrder = orderByRank(surface.triangles.size(), rank);
        for (uint32_t material = 0; material < in_.mesh.materials.size(); ++material) {
            begin(material, 0);
            for (const uint32_t t : outerOrder) {
                const uint32_t source = surface.triangles[t].source;
                if (in_.mesh.triangleMaterials[source] != material || in_.mesh.isCap(source))
                    continue;
                const SplitTriangle& triangle = surface.triangles[t];
                add(rank(t), {outer_.vertex(triangle, 0), outer_.vertex(triangle, 1),
                              outer_.vertex(triangle, 2)});
            }
            end();
        }
        addAttributes();
        addHidden();
        fillFragmentRanges();
    }

  private:
    /// Attributes that only hidden faces need; on the surface they change nothing.
    void addAttributes() {
        const std::string& depth = in_.settings.depthColor;
        if (depth.starts_with("COLOR_")) {
            // glTF counts colours without gaps.
            for (char n = '0'; n <= depth.back(); ++n)
                addAttribute(std::string("COLOR_") + n, 4, 1.0F);
        } else if (!depth.empty()) {
            addAttribute(depth, 1, 0.0F);
        }
        // A material chosen for the inside may have textures where that of the surface has none.
        if (!in_.settings.material.empty() || !in_.settings.materials.empty())
            addAttribute("TEXCOORD_0", 2, 0.0F);
    }

    void addAttribute(const std::string& semantic, uint32_t components, float onSurface) {
        FractureGeometry& out = set_.geometry;
        for (const Attribute& known : out.attributes)
            if (known.semantic == semantic) return;
        out.attributes.push_back(
            {semantic, components, std::vector(out.positions.size() * components, onSurface)});
    }

    /// One primitive for every level, sheets and walls apart, and every material.
    void addHidden() {
        const std::vector<HiddenMesh::Face>& faces = in_.hidden.mesh.faces;
        const auto rank = [&](uint32_t f) { return in_.hierarchy.rankOfLeaf[faces[f].leaf]; };
        const std::vector<uint32_t> order = orderByRank(faces.size(), rank);
        for (uint32_t level = 1; level <= in_.components.levels; ++level) {
            for (const bool sheet : {true, false}) {
                for (uint32_t m = static_cast<uint32_t>(in_.mesh.materials.size());
                     m < set_.materials.size(); ++m) {
                    begin(m, level);
                    set_.geometry.primitives.back().sheet = sheet;
                    for (const uint32_t f : order) {
                        const HiddenMesh::Face& face = faces[f];
                        if (face.exposedFrom == level && face.wall != sheet &&
                            in_.interiorMaterials[face.material] == m)
                            add(rank(f), hidden_.vertices(f));
                    }
                    end();
                }
            }
        }
    }

    void begin(uint32_t material, uint32_t exposedFrom) {
        Primitive primitive;
        primitive.material = material;
        primitive.exposedFrom = exposedFrom;
        primitive.indices.first = static_cast<uint32_t>(set_.geometry.indices.size());
        set_.geometry.primitives.push_back(primitive);
        rankCount_.assign(in_.components.leafCount, 0);
    }

    void add(uint32_t rank, const std::array<uint32_t, 3>& triangle) {
        set_.geometry.indices.insert(set_.geometry.indices.end(), triangle.begin(), triangle.end());
        rankCount_[rank] += 3;
    }

    void end() {
        Primitive& primitive = set_.geometry.primitives.back();
        primitive.indices.count =
            static_cast<uint32_t>(set_.geometry.indices.size()) - primitive.indices.first;
        if (primitive.indices.count == 0) {
            set_.geometry.primitives.pop_back();
            return;
        }
        std::vector<uint32_t> first(in_.components.leafCount + 1, primitive.indices.first);
        for (size_t r = 0; r < rankCount_.size(); ++r) first[r + 1] = first[r] + rankCount_[r];
        firstOfRank_.push_back(std::move(first));
    }

    void fillFragmentRanges() {
        for (const Range leaves : in_.hierarchy.leaves) {
            for (const std::vector<uint32_t>& first : firstOfRank_) {
                const uint32_t begin = first[leaves.first];
                set_.fragmentRanges.push_back({begin, first[leaves.first + leaves.count] - begin});
            }
        }
    }

    const AssemblyInput& in_;
    FractureSet& set_;
    OuterVertices outer_;
    HiddenVertices hidden_;
    std::vector<uint32_t> rankCount_;                 ///< indices per leaf of the current primitive
    std::vector<std::vector<uint32_t>> firstOfRank_;  ///< per primitive
};

}  // namespace

void assembleGeometry(const AssemblyInput& input, FractureSet& set) {
    GeometryAssembler(input, set).run();
}

}  // namespace sherd
