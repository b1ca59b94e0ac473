// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/result.h"

namespace sherd {

/// A Wavefront OBJ as written: three index spaces, polygons of any size.
struct ObjFile {
    static constexpr uint32_t kNone = UINT32_MAX;

    struct Corner {
        uint32_t position = 0;
        uint32_t uv = kNone;
        uint32_t normal = kNone;
    };
    struct Face {
        Range corners;
        uint32_t material = kNone;  ///< into materialNames
        size_t line = 0;
    };

    /// An `l` element: a polyline.
    struct Line {
        Range corners;       ///< into corners; normals are never given
        uint32_t group = 0;  ///< into lineGroups
        size_t line = 0;
    };
    /// Where lines stand in the file: under which `o` and `g`. A new `o` ends the group.
    struct LineGroup {
        std::string object;
        std::string group;
        bool operator==(const LineGroup& o) const = default;
    };

    std::string objectName;  ///< of the first `o`; may be empty
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> colors;  ///< one per position, or empty
    std::vector<glm::vec2> uvs;     ///< as written: v up
    std::vector<glm::vec3> normals;
    std::vector<Corner> corners;
    std::vector<Face> faces;
    std::vector<Line> lines;
    std::vector<LineGroup> lineGroups;
    std::vector<std::string> materialNames;
    std::vector<std::string> materialFiles;
    std::vector<std::string> warnings;
};

/// Every index is resolved and checked. `name`: the file, for errors ("chair.obj:12").
Result<ObjFile> parseObj(std::string_view text, const std::string& name);

}  // namespace sherd
