// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "sherd/baker/fracture_plan.h"
#include "sherd/baker/recipe.h"
#include "sherd/baker/report.h"
#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/gltf_document.h"
#include "sherd/formats/result.h"

namespace sherd {

/// A fracture line as it was cut into the surface, on every chart that it runs over.
struct OverlayLine {
    using Chains = std::vector<std::vector<glm::dvec2>>;

    uint32_t level = 1;
    std::string source;  ///< the element of its drawing
    Chains parting;      ///< where two pieces part along it; page coordinates
    Chains idle;         ///< where one piece lies on both sides
};

/// What became of the lines of a plan on one object.
struct LayoutOverlay {
    std::vector<OverlayLine> lines;
    std::vector<BakeFinding> findings;  ///< as a bake's; UV of places are where they are drawn
};

/// Cuts the mesh along a plan's lines and its own, and draws them where its triangles are drawn;
/// nothing for a mesh without texture coordinates. Open and non-manifold meshes are cut as they
/// are, and lines that separate nothing are a finding. Errors: limitExceeded, invalidData.
Result<LayoutOverlay> inspectLines(const SurfaceMesh& mesh, const FracturePlan& plan,
                                   const Recipe& recipe);

struct LayoutOptions {
    uint32_t resolution = 1024;           ///< side of the square drawing in user units, 16 to 65536
    std::string texture;                  ///< shown below the wireframe: a data URI, "" for none
    std::vector<LayoutOverlay> overlays;  ///< shown over it, one of each mesh
    bool seamLabels = true;  ///< equal numbers on the two sides where charts belong together
};

/// A drawing to draw fracture lines over.
struct Layout {
    std::string svg;
    size_t borderEdges = 0;  ///< chart borders drawn
    size_t innerEdges = 0;   ///< other edges drawn
    size_t seamLabels = 0;   ///< pairs of numbers on chart borders
    size_t spots = 0;        ///< rings around places to look at
    std::vector<std::string> warnings;
};

/// The UV layout of the meshes as an SVG template: locked guide layers (texture, wireframe, lines
/// and spots of the overlays) that the map reader passes over, and empty layers "level 1" to "level
/// 3". Triangles are drawn where their texture shows on the page (SurfaceMesh::placements), those
/// of other tiles too, which is reported. Error noTextureCoordinates: none of the meshes has any.
Result<Layout> makeLayoutSvg(std::span<const SurfaceMesh> meshes, const LayoutOptions& options);

/// The base-colour texture of the mesh's most used textured material as a data URI, "" if it has
/// none in the UV set lines are drawn in. Why one was left out goes to `warnings`.
std::string baseColorTexture(const GltfDocument& document, const SurfaceMesh& mesh,
                             std::vector<std::string>& warnings);

}  // namespace sherd
