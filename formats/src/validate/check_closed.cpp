// SPDX-License-Identifier: MIT
#include <cmath>

#include "check_context.h"

namespace sherd {

namespace {

std::string place(const CheckContext& context, uint32_t vertex) {
    const glm::vec3 p = context.set.geometry.positions[vertex];
    std::string text(1, '(');
    return text.append(shortNumber(p.x))
        .append(", ")
        .append(shortNumber(p.y))
        .append(", ")
        .append(shortNumber(p.z))
        .append(")");
}

std::string describe(const CheckContext& context, const EdgeDefects& edges) {
    return std::to_string(edges.count) + " edges are not used equally often both ways, one from " +
           place(context, edges.first[0]) + " to " + place(context, edges.first[1]);
}

void checkFragment(CheckContext& context, uint32_t f) {
    const MeshMeasures& mesh = context.measures[f];
    const Fragment& fragment = context.set.fragments[f];
    const auto id = static_cast<int32_t>(f);
    if (f == 0 && mesh.edges.count > 0) {
        context.out.boundaryEdges = mesh.edges.count;
        // What was open before the bake is not the bake's failure.
        return context.find(Severity::note, "object_open", id,
                            "object is open: " + describe(context, mesh.edges), "/geometry");
    }
    if (mesh.edges.count > 0)
        context.find(Severity::failure, "not_closed", id, describe(context, mesh.edges),
                     "/geometry");
    else if (!(mesh.volume > 0))
        context.find(
            Severity::failure, "volume_not_positive", id,
            "the mesh encloses " + shortNumber(mesh.volume) + " m^3: it is empty or inside out",
            "/geometry");
    const bool summed = f == 0;  // an object's volume is that of its pieces, checked with the mass
    if (mesh.edges.count == 0 && !summed &&
        std::abs(fragment.volume - mesh.volume) > 1e-3 * std::abs(mesh.volume))
        context.find(Severity::failure, "volume_wrong", id,
                     "VOLUME says " + shortNumber(fragment.volume) + " m^3, the mesh encloses " +
                         shortNumber(mesh.volume),
                     "/fragments/attributes/VOLUME");
}

}  // namespace

void checkClosed(CheckContext& context) {
    for (uint32_t f = 0; f < context.set.fragments.size(); ++f) checkFragment(context, f);
    const double whole = context.measures[0].volume;
    for (uint32_t k = 0; k < context.set.levels.size(); ++k) {
        LevelReport level;
        double sum = 0;
        for (const uint32_t f : fragmentsAtLevel(context.set, k)) {
            const MeshMeasures& mesh = context.measures[f];
            ++level.fragments;
            if (mesh.edges.count == 0 && mesh.volume > 0) ++level.closed;
            sum += mesh.volume;
        }
        level.volumeShare = whole > 0 ? sum / whole : 0;
        context.out.levels.push_back(level);
    }
}

bool isClosed(const FractureSet& set, uint32_t fragment) {
    return MeshMeasurer(set).measure(fragment).edges.count == 0;
}

double meshVolume(const FractureSet& set, uint32_t fragment) {
    return MeshMeasurer(set).measure(fragment).volume;
}

}  // namespace sherd
