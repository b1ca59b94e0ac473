// SPDX-License-Identifier: MIT
#include "levels/piece_choice.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <set>

#include "geometry/closed_mesh.h"
#include "geometry/inside_test.h"
#include "geometry/triangle_bvh.h"
#include "levels/leaf_cut.h"
#include "message_text.h"

namespace sherd {
namespace {

class Chooser {
  public:
    Chooser(const PieceChoice& choice, const PieceModel& model, const std::vector<PieceName>& names,
            const std::vector<std::vector<uint32_t>>& faces)
        : choice_(choice), model_(model), names_(names), places_(placesOf(model)) {
        for (const std::vector<uint32_t>& piece : faces)
            pieces_.push_back(leafMesh(model, places_, piece));
        for (const LeafMesh& piece : pieces_) {
            const glm::dvec3 origin = piece.positions.empty() ? glm::vec3(0) : piece.positions[0];
            volumes_.push_back(signedVolume(piece.positions, piece.triangles, origin));
        }
        someLeaf_.resize(pieces_.size());
        for (uint32_t leaf = 0; leaf < model.components.leafCount; ++leaf)
            someLeaf_[model.components.at(model.components.levels, leaf)] = leaf;
        whole_ = std::accumulate(volumes_.begin(), volumes_.end(), 0.0);
    }

    Result<std::vector<uint8_t>> run() {
        std::vector<uint8_t> chosen(pieces_.size(), 0);
        for (uint32_t p = 0; p < pieces_.size(); ++p)
            chosen[p] = isLarge(p) && isNamed(p) && isNear(p) ? 1 : 0;
        if (std::find(chosen.begin(), chosen.end(), 1) != chosen.end()) return chosen;
        return fail(ErrorCode::badArgument, "no piece is chosen: " + whatThereIs());
    }

  private:
    bool isLarge(uint32_t piece) const {
        const double share = volumes_[piece] / whole_;
        // A choice of up to 1 is one of all, whatever is rounded.
        return share >= choice_.larger && (share <= choice_.smaller || choice_.smaller >= 1);
    }

    bool isNamed(uint32_t piece) const {
        return choice_.name.empty() ||
               std::any_of(names_.begin(), names_.end(), [&](const PieceName& n) {
                   return n.name == choice_.name && n.level <= model_.components.levels &&
                          model_.components.at(n.level, someLeaf_[piece]) == n.component;
               });
    }

    bool isNear(uint32_t piece) {
        if (choice_.near.empty()) return true;
        const double distance = distanceOf(piece);
        nearest_ = std::min(nearest_, distance);
        return distance <= choice_.within;
    }

    /// To the nearest of the points; 0 if one is inside.
    double distanceOf(uint32_t piece) const {
        const LeafMesh& mesh = pieces_[piece];
        const InsideTest inside(mesh.positions, mesh.triangles);
        double least = std::numeric_limits<double>::max();
        for (const glm::dvec3& p : choice_.near) {
            if (inside.inside(p)) return 0;
            for (const auto& t : mesh.triangles) {
                const glm::dvec3 on = closestOnTriangle(p, glm::dvec3(mesh.positions[t[0]]),
                                                        glm::dvec3(mesh.positions[t[1]]),
                                                        glm::dvec3(mesh.positions[t[2]]));
                least = std::min(least, glm::distance(p, on));
            }
        }
        return least;
    }

    std::string whatThereIs() const {
        const auto [small, large] = std::minmax_element(volumes_.begin(), volumes_.end());
        std::string text = counted(static_cast<uint32_t>(pieces_.size()), "piece") +
                           sherd::text(" of %.3g to %.3g", *small / whole_, *large / whole_) +
                           " of the object's volume";
        if (nearest_ < std::numeric_limits<double>::max())
            text += sherd::text(", the nearest %.4g m from there", nearest_);
        if (choice_.name.empty()) return text;
        std::set<std::string> known;
        for (const PieceName& n : names_) known.insert(n.name);
        text += known.empty() ? ", none of them with a name" : ", named";
        for (const std::string& name : known) text += " \"" + name + "\"";
        return text;
    }

    const PieceChoice& choice_;
    const PieceModel& model_;
    const std::vector<PieceName>& names_;
    std::vector<uint32_t> places_;
    std::vector<LeafMesh> pieces_;
    std::vector<uint32_t> someLeaf_;  ///< per piece
    std::vector<double> volumes_;     ///< cubic metres
    double whole_ = 0;
    double nearest_ = std::numeric_limits<double>::max();
};

}  // namespace

Result<std::vector<uint8_t>> choosePieces(const PieceChoice& choice, const PieceModel& model,
                                          const std::vector<PieceName>& names,
                                          const std::vector<std::vector<uint32_t>>& faces) {
    if (choice.all()) return std::vector<uint8_t>(faces.size(), 1);
    return Chooser(choice, model, names, faces).run();
}

PieceChoice inObjectFrame(PieceChoice choice, const SurfaceMesh& mesh) {
    for (glm::dvec3& p : choice.near) p = toObjectFrame(mesh.restPose, p);
    return choice;
}

}  // namespace sherd
