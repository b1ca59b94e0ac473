// SPDX-License-Identifier: MIT
#include "levels/piece_joining.h"

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/compact_labels.h"
#include "geometry/triangle.h"
#include "levels/level_vertices.h"
#include "levels/side_split.h"
#include "levels/wall_matching.h"

namespace sherd {
namespace {

using Triangle = std::array<uint32_t, 3>;

class Joiner {
  public:
    Joiner(const std::vector<LeafCut>& cuts, const PieceModel& model)
        : cuts_(cuts),
          model_(model),
          vertices_(model),
          alone_(cuts.size() == 1),
          level_(model.components.levels + 1) {}

    JoinedPieces run() {
        names_ = vertices_.nameKnown(cuts_);
        for (size_t leaf = 0; leaf < cuts_.size(); ++leaf)
            if (cuts_[leaf].divided()) vertices_.nameSkin(cuts_[leaf], names_[leaf]);
        for (size_t leaf = 0; leaf < cuts_.size(); ++leaf)
            if (cuts_[leaf].divided()) vertices_.nameHidden(cuts_[leaf], names_[leaf]);
        if (!alone_) vertices_.joinEdges();
        const std::vector<std::vector<uint32_t>> faces = facesOfLeaves(model_);
        for (uint32_t leaf = 0; leaf < cuts_.size(); ++leaf) {
            if (cuts_[leaf].divided())
                addPieces(leaf);
            else
                addWhole(leaf, faces[leaf]);
        }
        findWalls();
        store();
        const MatchedWalls matched = matchWalls(walls_, model_);
        return {std::move(parents_), matched.folded, matched.apart};
    }

  private:
    /// Triangles that two leaves have, of which one is divided now.
    void findWalls() {
        std::map<Triangle, std::vector<uint32_t>> alike;  // by places, ascending
        for (uint32_t f = 0; f < model_.hidden.faces.size(); ++f) {
            Triangle key = placesOf(model_.hidden.faces[f].v);
            std::sort(key.begin(), key.end());
            if (key[0] == key[1] || key[1] == key[2]) continue;
            std::vector<uint32_t>& open = alike[key];
            const auto other =
                std::find_if(open.begin(), open.end(), [&](uint32_t g) { return areSides(f, g); });
            if (other == open.end()) {
                open.push_back(f);
                continue;
            }
            addWall(*other, f);
            open.erase(other);
        }
    }

    Triangle placesOf(const Triangle& v) const {
        return {vertices_.placeOf(v[0]), vertices_.placeOf(v[1]), vertices_.placeOf(v[2])};
    }

    /// Of faces with the same three places.
    bool areSides(uint32_t f, uint32_t g) const {
        const HiddenMesh::Face &a = model_.hidden.faces[f], &b = model_.hidden.faces[g];
        const Triangle u = placesOf(a.v), v = placesOf(b.v);
        const auto same = static_cast<size_t>(std::find(v.begin(), v.end(), u[0]) - v.begin());
        return a.leaf != b.leaf && a.exposedFrom == b.exposedFrom && v[(same + 1) % 3] == u[2];
    }

    void addWall(uint32_t f, uint32_t g) {
        const HiddenMesh::Face &a = model_.hidden.faces[f], &b = model_.hidden.faces[g];
        if (!cuts_[a.leaf].divided() && !cuts_[b.leaf].divided()) return;
        WallPair wall;
        wall.v = a.v;
        for (size_t k = 0; k < 3; ++k) {
            const EdgePoints::Part part = vertices_.between(a.v[k], a.v[(k + 1) % 3]);
            for (const EdgePoints::Point& p : part.points)
                wall.onSides[k].push_back(
                    {(p.share - part.from) / (part.to - part.from), p.vertex});
        }
        wallOf_[f] = {static_cast<uint32_t>(walls_.size()), 0};
        wallOf_[g] = {static_cast<uint32_t>(walls_.size()), 1};
        walls_.push_back(std::move(wall));
    }

    uint32_t beginLeaf(uint32_t parent, uint32_t label) {
        parents_.push_back(parent);
        labels_.emplace_back(model_.components.at(level_ - 1, parent), label);
        return static_cast<uint32_t>(parents_.size()) - 1;
    }

    void addWhole(uint32_t leaf, const std::vector<uint32_t>& faces) {
        const uint32_t now = beginLeaf(leaf, cuts_[leaf].labels[0]);
        for (const uint32_t f : faces) {
            if (f < model_.surface.triangles.size())
                addOuter(model_.surface.triangles[f], now);
            else
                addHidden(f - static_cast<uint32_t>(model_.surface.triangles.size()),
                          model_.hidden.faces[f - model_.surface.triangles.size()], now);
        }
    }

    void addPieces(uint32_t leaf) {
        const uint32_t material = commonMaterial(leaf);
        for (size_t p = 0; p < cuts_[leaf].pieces.pieces.size(); ++p) {
            const PieceMesh& piece = cuts_[leaf].pieces.pieces[p];
            const uint32_t now = beginLeaf(leaf, cuts_[leaf].labels[p]);
            for (size_t t = 0; t < piece.triangles.size(); ++t) {
                if (piece.origins[t].cap)
                    addCap(leaf, piece, t, material, now);
                else
                    addSkin(leaf, cuts_[leaf].cut.skin[piece.origins[t].index], now);
            }
        }
    }

    /// Inside it looks as it does below most of the piece's skin.
    uint32_t commonMaterial(uint32_t leaf) const {
        std::vector<double> areas(model_.mesh.materials.size(), 0);
        for (const uint32_t f : cuts_[leaf].mesh.sources) {
            const auto outer = static_cast<uint32_t>(model_.surface.triangles.size());
            if (f < outer) {
                const SplitTriangle& t = model_.surface.triangles[f];
                areas[model_.mesh.triangleMaterials[t.source]] +=
                    triangleArea(model_.surface.positions, t.v);
            } else {
                const HiddenMesh::Face& face = model_.hidden.faces[f - outer];
                areas[face.material] += triangleArea(model_.hidden.positions, face.v);
            }
        }
        return static_cast<uint32_t>(std::max_element(areas.begin(), areas.end()) - areas.begin());
    }

    void addCap(uint32_t leaf, const PieceMesh& piece, size_t t, uint32_t material, uint32_t now) {
        HiddenMesh::Face face{{}, now, level_, now, material, true};
        for (size_t k = 0; k < 3; ++k)
            face.v[k] = vertices_.nameInside(cuts_[leaf], names_[leaf],
                                             piece.vertices[piece.triangles[t][k]]);
        addHidden(kNone, face, now);
    }

    void addSkin(uint32_t leaf, const MeshCut::SkinTriangle& part, uint32_t now) {
        const LeafCut& cut = cuts_[leaf];
        Triangle v;
        for (size_t k = 0; k < 3; ++k) v[k] = vertices_.nameAt(cut, names_[leaf], part, k);
        const uint32_t source = cut.mesh.sources[part.source];
        const auto outer = static_cast<uint32_t>(model_.surface.triangles.size());
        if (source >= outer) {
            HiddenMesh::Face face = model_.hidden.faces[source - outer];
            face.v = v;
            return addHidden(source - outer, face, now);
        }
        SplitTriangle triangle = model_.surface.triangles[source];
        triangle.v = v;
        if (part.weights != MeshCut::kWhole)
            triangle.line = marksOf(triangle.line, cut.cut.weights[part.weights]);
        addOuter(triangle, now);
    }

    /// Sides along a side of the source are parts of the line that it is part of.
    static std::array<uint32_t, 3> marksOf(const std::array<uint32_t, 3>& of,
                                           const MeshCut::CornerWeights& weights) {
        std::array<uint32_t, 3> marks{};
        for (size_t j = 0; j < 3; ++j) {
            for (size_t k = 0; k < 3; ++k) {
                const auto across = static_cast<int>((k + 2) % 3);
                if (weights[j][across] == 0 && weights[(j + 1) % 3][across] == 0) marks[j] = of[k];
            }
        }
        return marks;
    }

    void addOuter(const SplitTriangle& triangle, uint32_t leaf) {
        if (isDegenerate(triangle.v)) return;
        SideSplit split{triangle.v, {}, triangle.line};
        splitSides(split, [&](const EdgePoints::Part& part, size_t n, size_t k) {
            return vertices_.skinPoint(part, n, split.v[k], split.v[(k + 1) % 3], triangle.source);
        });
        subdivide(split, [&](const SideSplit& part) {
            outer_.push_back({part.v, triangle.source, part.mark});
            outerLeaf_.push_back(leaf);
        });
    }

    /// from: the face it is part of; kNone: it is new.
    void addHidden(uint32_t from, HiddenMesh::Face face, uint32_t leaf) {
        if (isDegenerate(face.v)) return;
        face.leaf = leaf;
        SideSplit split{face.v, {}, {}};
        splitSides(split, [&](const EdgePoints::Part& part, size_t n, size_t) {
            return part.points[n].vertex;
        });
        subdivide(split, [&](const SideSplit& part) {
            face.v = part.v;
            hidden_.push_back(face);
            hiddenFrom_.push_back(from);
        });
    }

    bool isDegenerate(const Triangle& v) const {
        const uint32_t a = vertices_.placeOf(v[0]), b = vertices_.placeOf(v[1]),
                       c = vertices_.placeOf(v[2]);
        return a == b || b == c || c == a;
    }

    /// A leaf alone has split what it has itself.
    template <class NameOf>
    void splitSides(SideSplit& split, const NameOf& nameOf) {
        if (alone_) return;
        for (size_t k = 0; k < 3; ++k) {
            const EdgePoints::Part part = vertices_.between(split.v[k], split.v[(k + 1) % 3]);
            for (size_t n = 0; n < part.points.size(); ++n)
                split.inner[k].push_back(nameOf(part, n, k));
        }
    }

    void store() {
        vertices_.append(model_);
        // Outer triangles are sorted by what they are part of.
        std::vector<uint32_t> order(outer_.size());
        for (uint32_t t = 0; t < order.size(); ++t) order[t] = t;
        std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
            return outer_[a].source < outer_[b].source;
        });
        Components& components = model_.components;
        model_.surface.triangles.clear();
        components.leaf.clear();
        for (const uint32_t t : order) {
            model_.surface.triangles.push_back(outer_[t]);
            for (uint32_t& v : model_.surface.triangles.back().v) v = vertices_.renamed(v);
            components.leaf.push_back(outerLeaf_[t]);
        }
        for (HiddenMesh::Face& face : hidden_)
            for (uint32_t& v : face.v) v = vertices_.renamed(v);
        model_.hidden.faces = std::move(hidden_);
        storeWalls();
        storeComponents(components);
    }

    void storeWalls() {
        for (WallPair& wall : walls_) {
            for (uint32_t& v : wall.v) v = vertices_.renamed(v);
            for (std::vector<EdgePoints::Point>& side : wall.onSides)
                for (EdgePoints::Point& p : side) p.vertex = vertices_.renamed(p.vertex);
        }
        for (uint32_t f = 0; f < hiddenFrom_.size(); ++f) {
            const auto wall = wallOf_.find(hiddenFrom_[f]);
            if (wall != wallOf_.end())
                walls_[wall->second.first].faces[wall->second.second].push_back(f);
        }
    }

    void storeComponents(Components& components) const {
        for (std::vector<uint32_t>& ofLeaf : components.ofLeaf) {
            std::vector<uint32_t> now;
            now.reserve(parents_.size());
            for (const uint32_t parent : parents_) now.push_back(ofLeaf[parent]);
            ofLeaf = std::move(now);
        }
        components.ofLeaf.push_back(compactLabels(labels_, components.count.emplace_back()));
        components.leafCount = static_cast<uint32_t>(parents_.size());
        components.levels = level_;
    }

    const std::vector<LeafCut>& cuts_;
    const PieceModel& model_;
    LevelVertices vertices_;
    std::vector<LevelVertices::Names> names_;
    bool alone_;
    uint32_t level_;
    std::vector<uint32_t> parents_;                      ///< per new leaf
    std::vector<std::pair<uint32_t, uint32_t>> labels_;  ///< likewise: component before, cell
    std::vector<SplitTriangle> outer_;
    std::vector<uint32_t> outerLeaf_;
    std::vector<HiddenMesh::Face> hidden_;
    std::vector<uint32_t> hiddenFrom_;
    std::vector<WallPair> walls_;
    std::map<uint32_t, std::pair<uint32_t, size_t>> wallOf_;  ///< per face: which, and which side
};

}  // namespace

JoinedPieces joinPieces(const std::vector<LeafCut>& cuts, const PieceModel& model) {
    return Joiner(cuts, model).run();
}

}  // namespace sherd
