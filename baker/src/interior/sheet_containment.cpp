// SPDX-License-Identifier: MIT
// Centres of balls are inside; what lies between them need not be, at concave creases, and walls
// lead from the surface to them. Geometry decides nothing about topology here, so samples do.
#include "interior/sheet_containment.h"

#include <algorithm>

#include "parallel/parallel_for.h"

namespace sherd {
namespace {

class Container {
  public:
    Container(const SolidTest& object, const SplitSurface& surface,
              std::span<const HiddenFace> faces, unsigned threads, HiddenSheet& sheet)
        : object_(object), surface_(surface), faces_(faces), threads_(threads), sheet_(sheet) {}

    Containment run() {
        constexpr int kHalvings = 10;
        constexpr int kMostRounds = 1000;
        Containment result;
        if (object_.inside == nullptr) return result;
        std::vector<uint32_t> suspects;
        for (uint32_t f = 0; f < faces_.size(); ++f)
            if (hangsFromSheet(faces_[f])) suspects.push_back(f);
        std::vector<uint8_t> everMoved(sheet_.points.size(), 0);
        // Once on their feet, points stay: after the halvings, each round has fewer left to pull.
        for (int round = 0; round < kMostRounds; ++round) {
            const std::vector<uint32_t> bad = protruding(suspects);
            if (bad.empty()) return result;
            std::vector<uint8_t> moved(sheet_.points.size(), 0);
            for (const uint32_t f : bad) pull(f, round >= kHalvings, moved);
            if (std::find(moved.begin(), moved.end(), 1) == moved.end()) {
                result.protruding = static_cast<uint32_t>(bad.size());
                return result;
            }
            for (size_t v = 0; v < moved.size(); ++v) {
                if (moved[v] == 0 || everMoved[v] != 0) continue;
                everMoved[v] = 1;
                ++result.pulled;
            }
            suspects = around(moved);
        }
        result.protruding = static_cast<uint32_t>(protruding(suspects).size());
        return result;
    }

  private:
    /// Walls straight through the solid have been judged before.
    static bool hangsFromSheet(const HiddenFace& face) {
        return std::any_of(face.corners.begin(), face.corners.end(),
                           [](CornerRef ref) { return ref.hidden != 0 && !ref.isHub(); });
    }

    bool isOutside(const glm::dvec3& p) const {
        return !object_.contains(p) &&
               object_.surface.closest(p, object_.skin).triangle == ClosestPoint::kNone;
    }

    bool protrudes(const HiddenFace& face) const {
        std::array<glm::dvec3, 3> p;
        for (size_t k = 0; k < 3; ++k) p[k] = positionOf(surface_, sheet_, face.corners[k]);
        for (size_t k = 0; k < 3; ++k) {
            const bool onSurface = face.corners[k].hidden == 0;
            if (!onSurface && isOutside(p[k])) return true;
            // Each side of a sheet belongs to two faces: one of them looks.
            const bool edgeOnSurface = onSurface && face.corners[(k + 1) % 3].hidden == 0;
            if (edgeOnSurface || (!face.wall && !looksAt(face, k))) continue;
            if (isOutside(0.5 * (p[k] + p[(k + 1) % 3]))) return true;
        }
        return isOutside((p[0] + p[1] + p[2]) / 3.0);
    }
    bool looksAt(const HiddenFace& face, size_t k) const {
        // The face runs the other way round than the sheet's triangle.
        const uint32_t h = face.corners[(k + 1) % 3].corner;
        const uint32_t o = sheet_.opposite[h];
        return o == kNone || h < o;
    }

    std::vector<uint32_t> protruding(const std::vector<uint32_t>& suspects) const {
        std::vector<uint8_t> bad(suspects.size(), 0);
        parallelRuns(suspects.size(), 256, threads_, [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i) bad[i] = protrudes(faces_[suspects[i]]) ? 1 : 0;
        });
        std::vector<uint32_t> result;
        for (size_t i = 0; i < suspects.size(); ++i)
            if (bad[i] != 0) result.push_back(suspects[i]);
        return result;
    }

    void pull(uint32_t f, bool wholly, std::vector<uint8_t>& moved) {
        for (const CornerRef ref : faces_[f].corners) {
            if (ref.hidden == 0 || ref.isHub()) continue;
            const uint32_t v = vertexOf(surface_, sheet_, ref);
            if (moved[v] != 0 || sheet_.points[v] == sheet_.feet[v]) continue;
            moved[v] = 1;
            const glm::dvec3 foot(sheet_.feet[v]);
            sheet_.points[v] =
                wholly ? sheet_.feet[v] : glm::vec3(0.5 * (foot + glm::dvec3(sheet_.points[v])));
        }
    }

    std::vector<uint32_t> around(const std::vector<uint8_t>& moved) const {
        std::vector<uint32_t> result;
        for (uint32_t f = 0; f < faces_.size(); ++f) {
            const auto& corners = faces_[f].corners;
            const bool near = std::any_of(corners.begin(), corners.end(), [&](CornerRef ref) {
                return ref.hidden != 0 && !ref.isHub() &&
                       moved[vertexOf(surface_, sheet_, ref)] != 0;
            });
            if (near) result.push_back(f);
        }
        return result;
    }

    const SolidTest& object_;
    const SplitSurface& surface_;
    std::span<const HiddenFace> faces_;
    unsigned threads_;
    HiddenSheet& sheet_;
};

}  // namespace

Containment keepInside(const SolidTest& object, const SplitSurface& surface,
                       std::span<const HiddenFace> faces, unsigned threads, HiddenSheet& sheet) {
    return Container(object, surface, faces, threads, sheet).run();
}

}  // namespace sherd
