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
        for (const std::vector<uint32_t>& leaf : faces)
            leaves_.push_back(leafMesh(model, places_, leaf));
        for (const LeafMesh& leaf : leaves_) {
            const glm::dvec3 origin = leaf.positions.empty() ? glm::vec3(0) : leaf.positions[0];
            volumes_.push_back(signedVolume(leaf.positions, leaf.triangles, origin));
        }
        whole_ = std::accumulate(volumes_.begin(), volumes_.end(), 0.0);
    }

    Result<std::vector<uint8_t>> run() {
        std::vector<uint8_t> chosen(leaves_.size(), 0);
        for (uint32_t leaf = 0; leaf < leaves_.size(); ++leaf)
            chosen[leaf] = isLarge(leaf) && isNamed(leaf) && isNear(leaf) ? 1 : 0;
        if (std::find(chosen.begin(), chosen.end(), 1) != chosen.end()) return chosen;
        return fail(ErrorCode::badArgument, "no piece is chosen: " + whatThereIs());
    }

  private:
    bool isLarge(uint32_t leaf) const {
        const double share = volumes_[leaf] / whole_;
        // A choice of up to 1 is one of all, whatever is rounded.
        return share >= choice_.larger && (share <= choice_.smaller || choice_.smaller >= 1);
    }

    bool isNamed(uint32_t leaf) const {
        return choice_.name.empty() ||
               std::any_of(names_.begin(), names_.end(), [&](const PieceName& n) {
                   return n.name == choice_.name &&
                          model_.components.at(n.level, leaf) == n.component;
               });
    }

    bool isNear(uint32_t leaf) {
        if (choice_.near.empty()) return true;
        const double distance = distanceOf(leaf);
        nearest_ = std::min(nearest_, distance);
        return distance <= choice_.within;
    }

    /// To the nearest of the points; 0 if one is inside.
    double distanceOf(uint32_t leaf) const {
        const LeafMesh& mesh = leaves_[leaf];
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
        std::string text = counted(static_cast<uint32_t>(leaves_.size()), "piece") +
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
    std::vector<LeafMesh> leaves_;
    std::vector<double> volumes_;  ///< cubic metres
    double whole_ = 0;
    double nearest_ = std::numeric_limits<double>::max();
};

}  // namespace

Result<std::vector<uint8_t>> chooseLeaves(const PieceChoice& choice, const PieceModel& model,
                                          const std::vector<PieceName>& names,
                                          const std::vector<std::vector<uint32_t>>& faces) {
    if (choice.all()) return std::vector<uint8_t>(faces.size(), 1);
    return Chooser(choice, model, names, faces).run();
}

}  // namespace sherd
