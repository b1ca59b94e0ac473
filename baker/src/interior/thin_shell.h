// SPDX-License-Identifier: MIT
// Hidden points straight below the surface, for pieces to which the medial surface gives no
// thickness: on coarse meshes all corners lie on creases, where medial balls have no radius.
#pragma once

#include <span>
#include <vector>

#include "geometry/triangle_bvh.h"
#include "interior/hidden_sheet.h"
#include "interior/sheet_containment.h"

namespace sherd {

class ThinShell {
  public:
    ThinShell(const HiddenSheet& sheet, const SolidTest& object);

    /// The point below the sheet's vertex v, against its mean normal, at `share` of the way to what
    /// lies across the solid; at most `deepest` metres. The vertex itself where no such place is
    /// inside.
    glm::vec3 below(uint32_t vertex, double share, double deepest) const;

  private:
    const HiddenSheet& sheet_;
    const SolidTest& object_;
    std::vector<glm::dvec3> normals_;  ///< per vertex: of the triangles around it, by area
    TriangleBvh tree_;
};

}  // namespace sherd
