// SPDX-License-Identifier: MIT
// The displacement is d(p) = a * r(depth / 6a) * n(p), n a RoughField and r(t) = sin(pi/2 * t) up
// to t = 1, then 1. Depth changes by no more than p moves, so the slope of d is at most r' * |n| /
// 6 + r * a * steepest <= hypot(pi / 12, a * steepest): below 0.5 for a * steepest up to 0.42. And
// |d| <= pi / 12 * depth: a point that is inside stays in the ball around it that is.
//
// Normals follow from the slope. Those of the moved triangles would do where these are well shaped;
// but below a fine mesh walls are strips so thin that a hair's breadth turns them.
#include "appearance/roughness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <sstream>

#include "appearance/face_refinement.h"
#include "appearance/rough_field.h"
#include "geometry/inside_test.h"
#include "geometry/triangle_bvh.h"
#include "geometry/weld.h"

namespace sherd {
namespace {

constexpr double kSteepest = 0.42;      ///< of amplitude times the field's slope
constexpr double kFadesWithin = 6;      ///< amplitudes below the skin
constexpr double kEdgesPerBump = 4;     ///< a layer's second folds are 0.6 of the size apart
constexpr size_t kMostFaces = 300'000;  ///< or four times those there were

class Roughener {
  public:
    Roughener(const SurfaceMesh& object, const SplitSurface& surface, const Components& components,
              HiddenMesh& mesh)
        : surface_(surface),
          components_(components),
          mesh_(mesh),
          skin_(object.positions, object.triangles),
          inside_(object.positions, object.triangles) {}

    RoughShape run(const Roughness& settings) {
        refine(settings.size);
        findSkin();
        const RoughField field(settings.size, settings.seed);
        move(field, gentleAmplitude(settings, field));
        return std::move(shape_);
    }

  private:
    template <class... Parts>
    void report(const std::string& code, const Parts&... parts) {
        std::ostringstream text;
        (text << ... << parts);
        shape_.findings.push_back({code, text.str(), "", 1});
    }

    /// Middles of edges that leave a solid which is not convex go to the nearest place on its skin.
    void refine(double bumpSize) {
        const size_t before = mesh_.positions.size();
        const size_t most = std::max(kMostFaces, 4 * mesh_.faces.size());
        const double wanted = bumpSize / kEdgesPerBump;
        const double longest = refineFaces(surface_, wanted, most, mesh_);
        if (longest > wanted) {
            report("roughness-coarse", "bumps of ", bumpSize,
                   " m need more triangles than are sensible; edges inside are up to ", longest,
                   " m long");
        }
        for (size_t v = before; v < mesh_.positions.size(); ++v) {
            const glm::dvec3 p = mesh_.positions[v];
            if (!inside_.inside(p)) mesh_.positions[v] = glm::vec3(skin_.closest(p).point);
        }
    }

    double gentleAmplitude(const Roughness& settings, const RoughField& field) {
        const double most = kSteepest / field.steepest();
        if (settings.amplitude <= most) return settings.amplitude;
        report("roughness-lowered", "bumps of ", settings.size, " m would fold if deeper than ",
               most, " m; that was taken as amplitude");
        return most;
    }

    /// By the whole amplitude, or by less where a piece would lose half of its volume.
    void move(const RoughField& field, double amplitude) {
        const std::vector<double> before = volumes(mesh_.positions);
        for (const double share : {1.0, 0.5, 0.25, 0.0}) {
            displace(field, share * amplitude);
            const std::vector<double> after = volumes(shape_.positions);
            bool lost = false;
            for (size_t leaf = 0; leaf < after.size(); ++leaf)
                lost = lost || (before[leaf] > 0 && after[leaf] < 0.5 * before[leaf]);
            if (lost) continue;
            if (share < 1) {
                report("roughness-lowered", "pieces are too thin for bumps of ", amplitude, " m; ",
                       share * amplitude, " m was taken");
            }
            return;
        }
    }

    void displace(const RoughField& field, double amplitude) {
        shape_.positions = mesh_.positions;
        shape_.normalMaps.assign(mesh_.positions.size(), glm::dmat3(1.0));
        if (amplitude == 0) return;
        const double fadesWithin = kFadesWithin * amplitude;
        std::vector<uint8_t> moved = onSkin_;
        for (const HiddenMesh::Face& face : mesh_.faces) {
            for (const uint32_t v : face.v) {
                if (moved[v] != 0) continue;
                moved[v] = 1;
                displace(v, field, amplitude, fadesWithin);
            }
        }
    }

    /// Vertices of the skin, and hidden ones in the same places: where solids cross each other a
    /// piece may have both, and rounded to floats they lie a hair's breadth beside the skin.
    void findSkin() {
        std::vector<glm::vec3> places;
        const std::vector<uint32_t> placeOf = PositionWelder(places).add(mesh_.positions);
        std::vector<uint8_t> isSkin(places.size(), 0);
        for (uint32_t v = 0; v < mesh_.skinVertices; ++v) isSkin[placeOf[v]] = 1;
        for (const uint32_t place : placeOf) onSkin_.push_back(isSkin[place]);
    }

    void displace(uint32_t v, const RoughField& field, double amplitude, double fadesWithin) {
        const glm::dvec3 p = mesh_.positions[v];
        const ClosestPoint skin = skin_.closest(p, fadesWithin);
        const double depth = std::sqrt(skin.distance2);
        if (depth == 0) return;
        const RoughField::Value value = field.at(p);
        double fade = 1;
        glm::dmat3 slope(1.0);
        if (depth < fadesWithin) {
            const double t = M_PI / 2 / fadesWithin;
            fade = std::sin(t * depth);
            const glm::dvec3 gradient = (p - skin.point) * (t * std::cos(t * depth) / depth);
            slope += amplitude * glm::outerProduct(value.vector, gradient);
        }
        slope += amplitude * fade * value.slope;
        shape_.positions[v] = glm::vec3(p + value.vector * (fade * amplitude));
        shape_.normalMaps[v] = glm::transpose(glm::inverse(slope));
    }

    /// Six times the volume of every leaf.
    std::vector<double> volumes(const std::vector<glm::vec3>& positions) const {
        std::vector<double> result(components_.leafCount, 0);
        if (positions.empty()) return result;
        const glm::dvec3 origin = positions[0];
        const auto add = [&](uint32_t leaf, const std::array<uint32_t, 3>& v) {
            std::array<glm::dvec3, 3> p;
            for (size_t k = 0; k < 3; ++k) p[k] = glm::dvec3(positions[v[k]]) - origin;
            result[leaf] += glm::dot(p[0], glm::cross(p[1], p[2]));
        };
        for (uint32_t t = 0; t < surface_.triangles.size(); ++t)
            add(components_.leaf[t], surface_.triangles[t].v);
        for (const HiddenMesh::Face& face : mesh_.faces) add(face.leaf, face.v);
        return result;
    }

    const SplitSurface& surface_;
    const Components& components_;
    HiddenMesh& mesh_;
    TriangleBvh skin_;
    InsideTest inside_;
    std::vector<uint8_t> onSkin_;  ///< per vertex
    RoughShape shape_;
};

}  // namespace

RoughShape roughen(const SurfaceMesh& object, const SplitSurface& surface,
                   const Components& components, const Roughness& settings, HiddenMesh& mesh) {
    return Roughener(object, surface, components, mesh).run(settings);
}

}  // namespace sherd
