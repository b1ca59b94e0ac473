// SPDX-License-Identifier: MIT
// The vertices that a level adds to an object. Those on its skin become the split surface's.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <unordered_map>
#include <vector>

#include "levels/edge_points.h"
#include "levels/leaf_cut.h"
#include "levels/piece_model.h"

namespace sherd {

class LevelVertices {
  public:
    static constexpr uint32_t kNone = 0xFFFFFFFFU;

    explicit LevelVertices(const PieceModel& model);

    /// How the vertices of one leaf's cut are called in the object.
    struct Names {
        std::vector<std::vector<uint32_t>> of;  ///< per vertex of the cut; more than one where
                                                ///< vertices of the object are in one place
    };
    /// What the object has already. Where a cut found several of its vertices in one place, these
    /// get one position to the bit. Of all leaves before anything is made.
    std::vector<Names> nameKnown(const std::vector<LeafCut>& leaves);
    /// Names the vertices on the leaf's outer faces, of all leaves before `nameHidden` of any.
    void nameSkin(const LeafCut& leaf, Names& names);
    void nameHidden(const LeafCut& leaf, Names& names);

    /// The name of a skin triangle's corner, or of a cap's vertex.
    uint32_t nameAt(const LeafCut& leaf, Names& names, const MeshCut::SkinTriangle& t, size_t k);
    uint32_t nameInside(const LeafCut& leaf, Names& names, uint32_t vertex);

    /// The same for all vertices in one place.
    uint32_t placeOf(uint32_t name) const {
        return name < firstMade_ ? place_[name] : made_[name - firstMade_].place;
    }
    /// After everything has its name.
    void joinEdges() {
        edges_.join([this](uint32_t name) { return positionOf(name); });
    }
    /// What lies between two vertices on an edge, ends included: places.
    EdgePoints::Part between(uint32_t from, uint32_t to) const {
        return edges_.between(placeOf(from), placeOf(to));
    }
    /// The n-th of them for an outer face in a triangle of the mesh; for a hidden face the place
    /// itself does.
    uint32_t skinPoint(const EdgePoints::Part& part, size_t n, uint32_t from, uint32_t to,
                       uint32_t meshTriangle);

    /// Adds them to the object's; `renamed` is what a name is called then. What is on a line with
    /// an edge of the skin but beside it goes onto that edge: the skin stays where it is.
    void append(const PieceModel& model);
    uint32_t renamed(uint32_t name) const;

  private:
    struct Made {
        glm::vec3 position;
        bool skin;
        VertexOrigin origin;
        uint32_t place;
    };
    bool isOuter(uint32_t source) const { return source < model_.surface.triangles.size(); }
    const std::array<uint32_t, 3>& cornersOf(uint32_t source) const;
    Names knownNames(const LeafCut& leaf) const;
    void uniteSamePlaces(const std::vector<Names>& names);
    uint32_t skinName(const LeafCut& leaf, Names& names, uint32_t vertex, uint32_t source,
                      const glm::dvec3& weights);
    uint32_t nameInWall(const LeafCut& leaf, Names& names, uint32_t vertex, uint32_t source);
    void findOnEdge(uint32_t edge, const glm::vec3& position, std::vector<uint32_t>& known) const;
    glm::vec3 positionOf(uint32_t name) const;
    bool fits(uint32_t name, uint32_t meshTriangle) const;
    const VertexOrigin& originOf(uint32_t name) const;
    uint32_t make(const glm::vec3& position, uint32_t at);
    void bringOntoSkin();
    Made& madeOf(uint32_t name) { return made_[name - firstMade_]; }

    const PieceModel& model_;
    uint32_t firstMade_, skinVertices_;
    std::vector<uint32_t> place_;  ///< per vertex of the object: the first one in its place
    std::vector<Made> made_;
    std::unordered_map<uint64_t, uint32_t> skinAt_;  ///< place and mesh triangle -> name; looked up
                                                     ///< only
    /// By the places of a wall's corners: what cells that cut both sides made in it.
    std::map<std::array<uint32_t, 3>, std::vector<uint32_t>> inWalls_;
    EdgePoints edges_;
    double offSkin_;                          ///< metres: what is nearer to the skin is on it
    std::map<uint32_t, glm::vec3> ontoSkin_;  ///< per place beside it: where to go
    std::vector<uint32_t> finalOf_;           ///< per made vertex
    uint32_t addedSkin_ = 0;
};

}  // namespace sherd
