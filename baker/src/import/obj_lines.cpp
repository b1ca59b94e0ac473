// SPDX-License-Identifier: MIT
#include "import/obj_lines.h"

#include <map>

#include "import/level_name.h"
#include "import/surface_lines.h"

namespace sherd {
namespace {

std::string labelOf(const ObjFile::LineGroup& group, const std::string& name) {
    if (!group.group.empty()) return "group \"" + group.group + "\"";
    return group.object.empty() ? name : "object \"" + group.object + "\"";
}

/// A group's segments with the points they use.
class GroupSegments {
  public:
    explicit GroupSegments(const ObjFile& file) : file_(file) {}

    void add(const ObjFile::Line& line) {
        uint32_t previous = 0;
        for (uint32_t c = 0; c < line.corners.count; ++c) {
            const uint32_t position = file_.corners[line.corners.first + c].position;
            const auto next = static_cast<uint32_t>(segments_.points.size());
            const auto [known, isNew] = pointOf_.emplace(position, next);
            if (isNew) segments_.points.push_back(file_.positions[position]);
            if (c > 0) segments_.ends.push_back({previous, known->second});
            previous = known->second;
        }
    }

    const LineSegments& segments() const { return segments_; }

  private:
    const ObjFile& file_;
    std::map<uint32_t, uint32_t> pointOf_;
    LineSegments segments_;
};

}  // namespace

std::vector<FractureMap::SurfaceLine> makeObjLines(const ObjFile& file, const std::string& name,
                                                   std::vector<std::string>& warnings) {
    std::vector<FractureMap::SurfaceLine> lines;
    for (size_t i = 0; i < file.lines.size();) {
        const uint32_t group = file.lines[i].group;
        GroupSegments segments(file);
        for (; i < file.lines.size() && file.lines[i].group == group; ++i) {
            segments.add(file.lines[i]);
        }
        const LineChains chains = chainSegments(segments.segments());
        const ObjFile::LineGroup& names = file.lineGroups[group];
        const std::string label = labelOf(names, name);
        reportDropped(chains, label, warnings);
        auto level = levelInName(names.group);
        if (!level) level = levelInName(names.object);
        addSurfaceLines(
            chains, label, level.value_or(1), [](const glm::dvec3& p) { return p; }, lines);
    }
    return lines;
}

}  // namespace sherd
