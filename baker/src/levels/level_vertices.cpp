// SPDX-License-Identifier: MIT
#include "levels/level_vertices.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "geometry/bounds.h"
#include "geometry/union_find.h"

namespace sherd {
namespace {

/// Of the object's size.
constexpr double kOffSkin = 1e-6;

const MeshCut::CornerWeights kWholeWeights{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0),
                                           glm::dvec3(0, 0, 1)};

const glm::dvec3& weightsAt(const LeafCut& leaf, const MeshCut::SkinTriangle& t, size_t k) {
    return t.weights == MeshCut::kWhole ? kWholeWeights[k] : leaf.cut.weights[t.weights][k];
}

/// The corner that the weights are all of; 3: none.
size_t cornerOf(const glm::dvec3& weights) {
    for (int k = 0; k < 3; ++k)
        if (weights[k] == 1) return static_cast<size_t>(k);
    return 3;
}

/// The corner that an edge with the point on it lies across from; 3: it is on none.
size_t acrossFrom(const glm::dvec3& weights) {
    for (int k = 0; k < 3; ++k)
        if (weights[k] == 0) return static_cast<size_t>(k);
    return 3;
}

/// A point of a mesh triangle. On an edge of the mesh its ends alone are named.
VertexOrigin originAt(const std::array<uint32_t, 3>& meshTriangle, const glm::dvec3& weights) {
    const size_t across = acrossFrom(weights);
    if (across == 3) return {meshTriangle, weights};
    uint32_t a = meshTriangle[(across + 1) % 3], b = meshTriangle[(across + 2) % 3];
    double atB = weights[static_cast<int>((across + 2) % 3)];
    if (a > b) {
        std::swap(a, b);
        atB = weights[static_cast<int>((across + 1) % 3)];
    }
    return {{a, b, a}, {1 - atB, atB, 0}};
}

void addOnce(std::vector<uint32_t>& list, uint32_t item) {
    if (std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
}

}  // namespace

LevelVertices::LevelVertices(const PieceModel& model)
    : model_(model),
      firstMade_(static_cast<uint32_t>(model.hidden.positions.size())),
      skinVertices_(model.hidden.skinVertices),
      place_(placesOf(model)),
      offSkin_(kOffSkin * boundsOf(model.mesh.positions, model.mesh.triangles).diagonal()) {}

const std::array<uint32_t, 3>& LevelVertices::cornersOf(uint32_t source) const {
    return isOuter(source) ? model_.surface.triangles[source].v
                           : model_.hidden.faces[source - model_.surface.triangles.size()].v;
}

std::vector<LevelVertices::Names> LevelVertices::nameKnown(const std::vector<LeafCut>& leaves) {
    std::vector<Names> names(leaves.size());
    for (size_t leaf = 0; leaf < leaves.size(); ++leaf)
        if (leaves[leaf].divided()) names[leaf] = knownNames(leaves[leaf]);
    uniteSamePlaces(names);
    return names;
}

LevelVertices::Names LevelVertices::knownNames(const LeafCut& leaf) const {
    Names names;
    names.of.resize(leaf.cut.positions.size());
    for (size_t v = 0; v < leaf.mesh.vertices.size(); ++v)
        names.of[v].push_back(leaf.mesh.vertices[v]);
    for (const MeshCut::SkinTriangle& t : leaf.cut.skin) {
        for (size_t k = 0; k < 3; ++k) {
            const size_t corner = cornerOf(weightsAt(leaf, t, k));
            if (corner != 3)
                addOnce(names.of[t.v[k]], cornersOf(leaf.mesh.sources[t.source])[corner]);
        }
    }
    return names;
}

void LevelVertices::uniteSamePlaces(const std::vector<Names>& names) {
    UnionFind places(firstMade_);
    bool any = false;
    for (const Names& leaf : names) {
        for (const std::vector<uint32_t>& known : leaf.of) {
            for (size_t n = 1; n < known.size(); ++n) {
                any = any || place_[known[0]] != place_[known[n]];
                places.unite(place_[known[0]], place_[known[n]]);
            }
        }
    }
    for (uint32_t v = 0; any && v < firstMade_; ++v) {
        place_[v] = places.find(place_[v]);
        model_.hidden.positions[v] = model_.hidden.positions[place_[v]];
        if (v < skinVertices_) model_.surface.positions[v] = model_.hidden.positions[v];
    }
}

void LevelVertices::nameSkin(const LeafCut& leaf, Names& names) {
    for (const MeshCut::SkinTriangle& t : leaf.cut.skin)
        if (t.weights != MeshCut::kWhole && isOuter(leaf.mesh.sources[t.source]))
            for (size_t k = 0; k < 3; ++k) nameAt(leaf, names, t, k);
}

void LevelVertices::nameHidden(const LeafCut& leaf, Names& names) {
    for (const MeshCut::SkinTriangle& t : leaf.cut.skin)
        if (t.weights != MeshCut::kWhole && !isOuter(leaf.mesh.sources[t.source]))
            for (size_t k = 0; k < 3; ++k) nameAt(leaf, names, t, k);
}

uint32_t LevelVertices::nameAt(const LeafCut& leaf, Names& names, const MeshCut::SkinTriangle& t,
                               size_t k) {
    const uint32_t source = leaf.mesh.sources[t.source];
    const glm::dvec3& weights = weightsAt(leaf, t, k);
    const std::array<uint32_t, 3>& corners = cornersOf(source);
    if (const size_t corner = cornerOf(weights); corner != 3) return corners[corner];
    const size_t across = acrossFrom(weights);
    uint32_t edge = kNone;
    double share = 0;
    if (across != 3) {
        const size_t a = (across + 1) % 3, b = (across + 2) % 3;
        edge = edges_.findOrAdd(placeOf(corners[a]), placeOf(corners[b]));
        share = weights[static_cast<int>(placeOf(corners[a]) < placeOf(corners[b]) ? b : a)];
        findOnEdge(edge, leaf.cut.positions[t.v[k]], names.of[t.v[k]]);
    }
    uint32_t name = kNone;
    if (isOuter(source))
        name = skinName(leaf, names, t.v[k], source, weights);
    else if (leaf.shared && across == 3)
        name = nameInWall(leaf, names, t.v[k], source);
    else
        name = nameInside(leaf, names, t.v[k]);
    if (edge != kNone) edges_.add(edge, share, placeOf(name));
    return name;
}

uint32_t LevelVertices::skinName(const LeafCut& leaf, Names& names, uint32_t vertex,
                                 uint32_t source, const glm::dvec3& weights) {
    const SplitTriangle& outer = model_.surface.triangles[source];
    std::vector<uint32_t>& known = names.of[vertex];
    for (const uint32_t name : known)
        if (fits(name, outer.source)) return name;
    const auto& triangle = model_.mesh.triangles[outer.source];
    glm::dvec3 inMesh(0.0);
    for (int k = 0; k < 3; ++k) {
        if (weights[k] == 0) continue;
        inMesh += weights[k] *
                  weightsOf(model_.surface.origins[outer.v[static_cast<size_t>(k)]], triangle);
    }
    const uint32_t name = make(leaf.cut.positions[vertex], known.empty() ? kNone : known[0]);
    madeOf(name).skin = true;
    madeOf(name).origin = originAt(triangle, inMesh);
    known.push_back(name);
    return name;
}

uint32_t LevelVertices::nameInside(const LeafCut& leaf, Names& names, uint32_t vertex) {
    std::vector<uint32_t>& known = names.of[vertex];
    if (known.empty()) known.push_back(make(leaf.cut.positions[vertex], kNone));
    return known[0];
}

/// The leaf on the other side has the same point, to the bit.
uint32_t LevelVertices::nameInWall(const LeafCut& leaf, Names& names, uint32_t vertex,
                                   uint32_t source) {
    std::vector<uint32_t>& known = names.of[vertex];
    if (!known.empty()) return known[0];
    std::array<uint32_t, 3> wall = cornersOf(source);
    for (uint32_t& v : wall) v = placeOf(v);
    std::sort(wall.begin(), wall.end());
    std::vector<uint32_t>& there = inWalls_[wall];
    for (const uint32_t name : there) {
        if (positionOf(name) != leaf.cut.positions[vertex]) continue;
        known.push_back(name);
        return name;
    }
    there.push_back(nameInside(leaf, names, vertex));
    return there.back();
}

/// Two leaves may have found the same point.
void LevelVertices::findOnEdge(uint32_t edge, const glm::vec3& position,
                               std::vector<uint32_t>& known) const {
    if (!known.empty()) return;
    for (const EdgePoints::Point& p : edges_.points(edge))
        if (positionOf(p.vertex) == position) return known.push_back(p.vertex);
}

glm::vec3 LevelVertices::positionOf(uint32_t name) const {
    return name < firstMade_ ? model_.hidden.positions[name] : made_[name - firstMade_].position;
}

/// Whether the attributes of a skin vertex are those of the mesh triangle.
bool LevelVertices::fits(uint32_t name, uint32_t meshTriangle) const {
    if (name < firstMade_) return false;  // corners have their names already
    const Made& made = made_[name - firstMade_];
    const auto& corners = model_.mesh.triangles[meshTriangle];
    return made.skin &&
           std::all_of(made.origin.vertices.begin(), made.origin.vertices.end(), [&](uint32_t v) {
               return std::find(corners.begin(), corners.end(), v) != corners.end();
           });
}

/// `at`: something in its place, or kNone.
uint32_t LevelVertices::make(const glm::vec3& position, uint32_t at) {
    const uint32_t name = firstMade_ + static_cast<uint32_t>(made_.size());
    if (at == kNone)
        made_.push_back({position, false, {}, name});
    else
        made_.push_back({positionOf(at), false, {}, placeOf(at)});
    return name;
}

uint32_t LevelVertices::skinPoint(const EdgePoints::Part& part, size_t n, uint32_t from,
                                  uint32_t to, uint32_t meshTriangle) {
    const EdgePoints::Point& point = part.points[n];
    if (fits(point.vertex, meshTriangle)) return point.vertex;
    const uint64_t key = uint64_t{point.vertex} << 32 | meshTriangle;
    const auto [it, isNew] = skinAt_.try_emplace(key, 0);
    if (!isNew) return it->second;
    const auto& triangle = model_.mesh.triangles[meshTriangle];
    const double share = (point.share - part.from) / (part.to - part.from);
    const glm::dvec3 weights = (1 - share) * weightsOf(originOf(from), triangle) +
                               share * weightsOf(originOf(to), triangle);
    it->second = make({}, point.vertex);
    madeOf(it->second).skin = true;
    madeOf(it->second).origin = originAt(triangle, weights);
    const glm::dvec3 a = positionOf(from), b = positionOf(to);
    const glm::dvec3 onEdge = a + std::clamp(share, 0.0, 1.0) * (b - a);
    if (glm::distance(onEdge, glm::dvec3(positionOf(point.vertex))) > offSkin_)
        ontoSkin_.try_emplace(point.vertex, onEdge);
    return it->second;
}

/// Edges that share two vertices, as near to each other as cuts are rounded, need not lie on each
/// other. All vertices in a place move, so that what is closed stays so; what a cut found on the
/// skin is where it ought to be.
void LevelVertices::bringOntoSkin() {
    if (ontoSkin_.empty()) return;
    std::set<uint32_t> taken;  // from the place by way of skinPoint
    for (const auto& [key, name] : skinAt_) taken.insert(name);
    for (uint32_t v = 0; v < skinVertices_; ++v) ontoSkin_.erase(place_[v]);
    for (uint32_t n = 0; n < made_.size(); ++n)
        if (made_[n].skin && !taken.contains(firstMade_ + n)) ontoSkin_.erase(made_[n].place);
    for (uint32_t v = skinVertices_; v < firstMade_; ++v) {
        const auto to = ontoSkin_.find(place_[v]);
        if (to != ontoSkin_.end()) model_.hidden.positions[v] = to->second;
    }
    for (Made& made : made_) {
        const auto to = ontoSkin_.find(made.place);
        if (to != ontoSkin_.end()) made.position = to->second;
    }
}

const VertexOrigin& LevelVertices::originOf(uint32_t name) const {
    return name < firstMade_ ? model_.surface.origins[name] : made_[name - firstMade_].origin;
}

void LevelVertices::append(const PieceModel& model) {
    bringOntoSkin();
    const std::vector<glm::vec3> hidden(model.hidden.positions.begin() + skinVertices_,
                                        model.hidden.positions.end());
    for (const Made& made : made_) {
        finalOf_.push_back(static_cast<uint32_t>(model.surface.positions.size()));
        if (!made.skin) continue;
        model.surface.positions.push_back(made.position);
        model.surface.origins.push_back(made.origin);
    }
    model.hidden.positions = model.surface.positions;
    model.hidden.skinVertices = static_cast<uint32_t>(model.surface.positions.size());
    addedSkin_ = model.hidden.skinVertices - skinVertices_;
    model.hidden.positions.insert(model.hidden.positions.end(), hidden.begin(), hidden.end());
    for (size_t n = 0; n < made_.size(); ++n) {
        if (made_[n].skin) continue;
        finalOf_[n] = static_cast<uint32_t>(model.hidden.positions.size());
        model.hidden.positions.push_back(made_[n].position);
    }
}

uint32_t LevelVertices::renamed(uint32_t name) const {
    if (name < skinVertices_) return name;
    return name < firstMade_ ? name + addedSkin_ : finalOf_[name - firstMade_];
}

}  // namespace sherd
