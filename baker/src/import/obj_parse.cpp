// SPDX-License-Identifier: MIT
// tinyobjloader was tried and left: it reads a malformed number as 0, wraps indices beyond 31 bits
// to plausible ones, knows no continued lines and names no line in what it reports.
#include "import/obj_parse.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "import/limits.h"
#include "import/text_cursor.h"

namespace sherd {
namespace {

class ObjParser {
  public:
    ObjParser(std::string_view text, const std::string& name) : cursor_(text), name_(name) {}

    Result<ObjFile> parse() {
        while (!cursor_.atEnd()) {
            auto ok = statement();
            if (!ok) return tl::unexpected(ok.error());
            cursor_.nextLine();
        }
        if (auto ok = checkIndices(); !ok) return tl::unexpected(ok.error());
        if (leftOut_ > 0) {
            file_.warnings.push_back(std::to_string(leftOut_) +
                                     " points, curves or free-form surfaces were left out");
        }
        return std::move(file_);
    }

  private:
    tl::unexpected<Error> bad(ErrorCode code, const std::string& message, size_t line) const {
        return fail(code, message, name_ + ":" + std::to_string(line));
    }
    tl::unexpected<Error> malformed(const std::string& message) const {
        return bad(ErrorCode::malformed, message, cursor_.line());
    }

    Result<void> statement() {
        const std::string_view word = cursor_.word();
        if (word == "v") return position();
        if (word == "vt") return uv();
        if (word == "vn") return normal();
        if (word == "f" || word == "fo") return face();
        if (word == "l") return line();
        if (word == "usemtl") {
            material_ = materialIndex(cursor_.rest());
        } else if (word == "mtllib") {
            const std::string file = cursor_.rest();
            if (!file.empty()) file_.materialFiles.push_back(file);
        } else if (word == "o") {
            group_ = {cursor_.rest(), {}};
            if (file_.objectName.empty()) file_.objectName = group_.object;
        } else if (word == "g") {
            group_.group = cursor_.rest();
        } else if (word == "p" || word == "curv" || word == "curv2" || word == "surf") {
            ++leftOut_;
        }
        return {};
    }

    Result<void> position() {
        glm::vec3 p;
        if (!cursor_.number(p.x) || !cursor_.number(p.y) || !cursor_.number(p.z)) {
            return malformed("a vertex needs three finite numbers");
        }
        if (file_.positions.size() >= kMaxImportElements) {
            return bad(ErrorCode::limitExceeded, "too many vertices; split the model",
                       cursor_.line());
        }
        file_.positions.push_back(p);
        // Three more numbers are a colour; a single one is a weight, which meshes do not use.
        glm::vec3 color;
        if (cursor_.number(color.r) && cursor_.number(color.g) && cursor_.number(color.b)) {
            file_.colors.resize(file_.positions.size() - 1, glm::vec3(1.0F));
            file_.colors.push_back(color);
        } else if (!file_.colors.empty()) {
            file_.colors.emplace_back(1.0F);
        }
        return {};
    }

    Result<void> uv() {
        glm::vec2 uv(0.0F);
        if (!cursor_.number(uv.x) || (!cursor_.atLineEnd() && !cursor_.number(uv.y))) {
            return malformed("a texture coordinate needs finite numbers");
        }
        file_.uvs.push_back(uv);
        return {};
    }

    Result<void> normal() {
        glm::vec3 n;
        if (!cursor_.number(n.x) || !cursor_.number(n.y) || !cursor_.number(n.z)) {
            return malformed("a normal needs three finite numbers");
        }
        file_.normals.push_back(n);
        return {};
    }

    uint32_t materialIndex(const std::string& material) {
        const auto next = static_cast<uint32_t>(file_.materialNames.size());
        const auto [it, isNew] = materials_.emplace(material, next);
        if (isNew) file_.materialNames.push_back(material);
        return it->second;
    }

    Result<void> face() {
        ObjFile::Face face;
        face.material = material_;
        face.line = cursor_.line();
        face.corners.first = static_cast<uint32_t>(file_.corners.size());
        while (!cursor_.atLineEnd()) {
            ObjFile::Corner corner;
            if (!readCorner(cursor_.word(), corner)) {
                return malformed("a face corner must be v, v/vt, v//vn or v/vt/vn, none of them 0");
            }
            file_.corners.push_back(corner);
        }
        face.corners.count = static_cast<uint32_t>(file_.corners.size()) - face.corners.first;
        if (face.corners.count < 3) return malformed("a face needs at least three corners");
        if (file_.corners.size() > 3 * kMaxImportElements) {
            return bad(ErrorCode::limitExceeded, "too many faces; split the model", face.line);
        }
        file_.faces.push_back(face);
        return {};
    }

    Result<void> line() {
        ObjFile::Line line;
        line.line = cursor_.line();
        line.corners.first = static_cast<uint32_t>(file_.corners.size());
        while (!cursor_.atLineEnd()) {
            ObjFile::Corner corner;
            if (!readCorner(cursor_.word(), corner) || corner.normal != ObjFile::kNone) {
                return malformed("a point of a line must be v or v/vt, none of them 0");
            }
            file_.corners.push_back(corner);
        }
        line.corners.count = static_cast<uint32_t>(file_.corners.size()) - line.corners.first;
        if (line.corners.count < 2) return malformed("a line needs at least two points");
        if (file_.corners.size() > 3 * kMaxImportElements) {
            return bad(ErrorCode::limitExceeded, "too many lines; split the model", line.line);
        }
        if (file_.lineGroups.empty() || file_.lineGroups.back() != group_) {
            file_.lineGroups.push_back(group_);
        }
        line.group = static_cast<uint32_t>(file_.lineGroups.size()) - 1;
        file_.lines.push_back(line);
        return {};
    }

    bool readCorner(std::string_view word, ObjFile::Corner& corner) const {
        const char* at = word.data();
        const char* end = at + word.size();
        if (!index(at, end, file_.positions.size(), corner.position)) return false;
        if (at == end) return true;
        ++at;  // the slash
        if (at != end && *at != '/' && !index(at, end, file_.uvs.size(), corner.uv)) return false;
        if (at == end) return true;
        ++at;
        if (at == end) return true;
        return index(at, end, file_.normals.size(), corner.normal) && at == end;
    }

    /// 1 is the first, -1 the last so far. Stops at a slash or the end.
    static bool index(const char*& at, const char* end, size_t count, uint32_t& out) {
        int64_t value = 0;
        const auto [stop, error] = std::from_chars(at, end, value);
        if (error != std::errc() || value == 0 || (stop != end && *stop != '/')) return false;
        const int64_t resolved = value > 0 ? value - 1 : static_cast<int64_t>(count) + value;
        // Out of range is told from malformed at the end, when all counts are known.
        out =
            resolved < 0 || resolved >= kOutOfRange ? kOutOfRange : static_cast<uint32_t>(resolved);
        at = stop;
        return true;
    }

    Result<void> checkIndices() const {
        const auto ok = [](uint32_t index, size_t count) {
            return index == ObjFile::kNone || index < count;
        };
        for (const ObjFile::Face& face : file_.faces) {
            for (uint32_t c = 0; c < face.corners.count; ++c) {
                const ObjFile::Corner& corner = file_.corners[face.corners.first + c];
                if (corner.position < file_.positions.size() && ok(corner.uv, file_.uvs.size()) &&
                    ok(corner.normal, file_.normals.size())) {
                    continue;
                }
                return bad(ErrorCode::invalidData,
                           "the face refers to a vertex, texture coordinate or normal that does "
                           "not exist; the file may be truncated",
                           face.line);
            }
        }
        for (const ObjFile::Line& line : file_.lines) {
            for (uint32_t c = 0; c < line.corners.count; ++c) {
                const ObjFile::Corner& corner = file_.corners[line.corners.first + c];
                if (corner.position < file_.positions.size() && ok(corner.uv, file_.uvs.size())) {
                    continue;
                }
                return bad(ErrorCode::invalidData,
                           "the line refers to a vertex or texture coordinate that does not "
                           "exist; the file may be truncated",
                           line.line);
            }
        }
        return {};
    }

    static constexpr uint32_t kOutOfRange = ObjFile::kNone - 1;

    TextCursor cursor_;
    std::string name_;
    ObjFile file_;
    ObjFile::LineGroup group_;
    std::unordered_map<std::string, uint32_t> materials_;
    uint32_t material_ = ObjFile::kNone;
    size_t leftOut_ = 0;
};

}  // namespace

Result<ObjFile> parseObj(std::string_view text, const std::string& name) {
    return ObjParser(text, name).parse();
}

}  // namespace sherd
