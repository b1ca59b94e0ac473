// SPDX-License-Identifier: MIT
#include "solid/cap_refinement.h"

#include <functional>
#include <unordered_map>
#include <unordered_set>

#include "solid/edge_key.h"

namespace sherd {
namespace {

class CapRefiner {
  public:
    explicit CapRefiner(MeshCut& cut) : cut_(cut), onSkin_(cut.positions.size(), 0) {
        for (const MeshCut::SkinTriangle& t : cut.skin) {
            for (size_t k = 0; k < 3; ++k) {
                onSkin_[t.v[k]] = 1;
                skinEdges_.insert(edgeKey(t.v[k], t.v[(k + 1) % 3]));
            }
        }
    }

    void run() {
        pass([this](uint32_t a, uint32_t b) { return onSkin(a) && onSkin(b); });
        middles_.clear();
        pass([this](uint32_t a, uint32_t b) { return onSkin(a) != onSkin(b); });
    }

  private:
    using Splits = std::function<bool(uint32_t a, uint32_t b)>;

    void pass(const Splits& splits) {
        std::vector<CapTriangle> refined;
        for (MeshCut::Cap& cap : cut_.caps) {
            const auto first = static_cast<uint32_t>(refined.size());
            for (uint32_t t = cap.first; t < cap.first + cap.count; ++t)
                refine(cut_.capTriangles[t], splits, refined);
            cap.first = first;
            cap.count = static_cast<uint32_t>(refined.size()) - first;
        }
        cut_.capTriangles = std::move(refined);
    }
    bool onSkin(uint32_t vertex) const { return vertex < onSkin_.size() && onSkin_[vertex] != 0; }

    uint32_t addVertex(const glm::dvec3& position) {
        cut_.positions.emplace_back(position);
        return static_cast<uint32_t>(cut_.positions.size() - 1);
    }
    glm::dvec3 at(uint32_t vertex) const { return cut_.positions[vertex]; }

    /// The middle of an edge through the inside that is to be split.
    uint32_t middleOf(uint32_t a, uint32_t b, const Splits& splits) {
        if (a == b || !splits(a, b) || skinEdges_.contains(edgeKey(a, b))) return kNone;
        const auto [it, isNew] = middles_.try_emplace(edgeKey(a, b), 0);
        if (isNew) it->second = addVertex(0.5 * (at(a) + at(b)));
        return it->second;
    }

    void refine(const CapTriangle& t, const Splits& splits, std::vector<CapTriangle>& refined) {
        const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
            refined.push_back({{a, b, c}, t.layer});
        };
        std::array<uint32_t, 3> m{};
        size_t split = 0;
        size_t first = 3;  // split edge before which comes one that is not
        for (size_t k = 0; k < 3; ++k) {
            m[k] = middleOf(t.v[k], t.v[(k + 1) % 3], splits);
            if (m[k] != kNone) ++split;
        }
        for (size_t k = 0; k < 3; ++k)
            if (m[k] != kNone && m[(k + 2) % 3] == kNone) first = k;
        const auto v = [&](size_t k) { return t.v[k % 3]; };
        if (split == 3) {
            for (size_t k = 0; k < 3; ++k) add(v(k), m[k], m[(k + 2) % 3]);
            add(m[0], m[1], m[2]);
        } else if (split == 2) {
            const uint32_t a = m[first], b = m[(first + 1) % 3];
            add(v(first + 1), b, a);
            add(v(first + 2), v(first), a);
            add(v(first + 2), a, b);
        } else if (split == 1) {
            add(v(first), m[first], v(first + 2));
            add(m[first], v(first + 1), v(first + 2));
        } else {
            keepOrFan(t, refined);
        }
    }

    /// One that has skin along all its edges still gets an inside.
    void keepOrFan(const CapTriangle& t, std::vector<CapTriangle>& refined) {
        bool all = t.v[0] != t.v[1] && t.v[1] != t.v[2] && t.v[2] != t.v[0];
        for (size_t k = 0; k < 3; ++k)
            all = all && skinEdges_.contains(edgeKey(t.v[k], t.v[(k + 1) % 3]));
        if (!all) {
            refined.push_back(t);
            return;
        }
        const uint32_t middle = addVertex((at(t.v[0]) + at(t.v[1]) + at(t.v[2])) / 3.0);
        for (size_t k = 0; k < 3; ++k)
            refined.push_back({{t.v[k], t.v[(k + 1) % 3], middle}, t.layer});
    }

    static constexpr uint32_t kNone = 0xFFFFFFFFU;
    MeshCut& cut_;
    std::vector<uint8_t> onSkin_;  ///< per vertex of the cut as it came
    std::unordered_set<uint64_t> skinEdges_;
    std::unordered_map<uint64_t, uint32_t> middles_;
};

}  // namespace

void refineCaps(MeshCut& cut) {
    CapRefiner(cut).run();
}

}  // namespace sherd
