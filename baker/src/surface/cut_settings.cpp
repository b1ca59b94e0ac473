// SPDX-License-Identifier: MIT
#include "surface/cut_settings.h"

#include "geometry/bounds.h"

namespace sherd {

double diagonalOf(const SurfaceMesh& mesh) {
    return boundsOf(mesh.positions, mesh.triangles).diagonal();
}

CutOptions cutOptionsOf(const Recipe& recipe, double diagonal) {
    CutOptions options;
    options.seams = {recipe.seamJoinShare * diagonal, recipe.interior.thesis};
    options.closeGaps = recipe.closeGaps;
    options.snapDistance = recipe.snapShare * diagonal;
    options.wrap = recipe.wrap;
    options.splitPatches = recipe.splitParts;
    options.wholeCells = recipe.interior.type == InteriorType::solid;
    return options;
}

}  // namespace sherd
