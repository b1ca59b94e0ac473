// SPDX-License-Identifier: MIT
#include "levels/piece_graph.h"

#include <algorithm>
#include <utility>

#include "levels/leaf_cut.h"
#include "parallel/parallel_for.h"
#include "physics/bonds.h"
#include "physics/mass_properties.h"

namespace sherd {

PieceGraph pieceGraph(const PieceModel& model, double sheetTolerance, unsigned threads) {
    const std::vector<std::vector<uint32_t>> faces = facesOfLeaves(model);
    const std::vector<uint32_t> places = placesOf(model);
    PieceGraph graph;
    graph.volumes.resize(faces.size());
    graph.centres.resize(faces.size());
    parallelRuns(faces.size(), 1, threads, [&](size_t first, size_t last) {
        for (size_t leaf = first; leaf < last; ++leaf) {
            const LeafMesh mesh = leafMesh(model, places, faces[leaf]);
            const MassProperties mass = massProperties(mesh.positions, mesh.triangles);
            graph.volumes[leaf] = std::max(mass.volume, 0.0);
            graph.centres[leaf] = mass.center;
        }
    });
    std::vector<HiddenTriangle> hidden;
    hidden.reserve(model.hidden.faces.size());
    for (const HiddenMesh::Face& face : model.hidden.faces) hidden.push_back({face.v, face.leaf});
    for (const LeafBond& bond :
         findBonds(model.hidden.positions, hidden, {sheetTolerance, threads}))
        graph.bonds.push_back({bond.a, bond.b, bond.area});
    return graph;
}

WeightedGraph groupGraph(const PieceGraph& leaves, const std::vector<uint32_t>& group,
                         const std::vector<uint32_t>& within) {
    const uint32_t count = group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1;
    std::vector<double> volumes(count, 0), leafCounts(count, 0);
    std::vector<glm::dvec3> centres(count, glm::dvec3(0)), plain(count, glm::dvec3(0));
    for (size_t leaf = 0; leaf < group.size(); ++leaf) {
        const uint32_t g = group[leaf];
        volumes[g] += leaves.volumes[leaf];
        centres[g] += leaves.volumes[leaf] * leaves.centres[leaf];
        plain[g] += leaves.centres[leaf];
        leafCounts[g] += 1;
    }
    for (uint32_t g = 0; g < count; ++g)
        centres[g] = volumes[g] > 0 ? centres[g] / volumes[g] : plain[g] / leafCounts[g];
    std::vector<WeightedGraph::Edge> edges;
    for (const WeightedGraph::Edge& bond : leaves.bonds)
        if (within[bond.a] == within[bond.b])
            edges.push_back({group[bond.a], group[bond.b], bond.strength});
    return {std::move(volumes), std::move(centres), edges};
}

}  // namespace sherd
