// SPDX-License-Identifier: MIT
// Sherd's own map format: formats/spec/fracture_map/README.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "map/map_limits.h"
#include "map/svg_curves.h"

namespace sherd {

namespace {

using Json = nlohmann::json;

/// Reads a parsed document; the first mistake ends it, with the JSON pointer of the culprit.
class JsonMapReader {
  public:
    JsonMapReader(const Json& document, const std::string& name, const MapReadOptions& options)
        : document_(document), name_(name), options_(options) {}

    Result<FractureMap> read() {
        if (!readDocument()) return tl::unexpected(std::move(error_));
        if (map_.lines.empty())
            return fail(ErrorCode::emptyMap,
                        "the map holds no line to break along; give it \"lines\", or \"nodes\" and "
                        "\"edges\"",
                        name_);
        return std::move(map_);
    }

  private:
    bool stop(ErrorCode code, std::string message, const std::string& pointer) {
        error_ = {code, std::move(message), name_ + "#" + pointer};
        return false;
    }
    bool wrong(std::string message, const std::string& pointer) {
        return stop(ErrorCode::invalidData, std::move(message), pointer);
    }

    bool readDocument() {
        if (!document_.is_object() || !document_.contains("sherdMap"))
            return stop(ErrorCode::malformed,
                        "not a Sherd fracture map: an object with \"sherdMap\": 1 was expected",
                        "");
        const Json& version = document_["sherdMap"];
        if (!version.is_number_integer() || version != 1)
            return stop(ErrorCode::unsupported, "only version 1 of the map format is known",
                        "/sherdMap");
        warnUnknown(document_, {"sherdMap", "$schema", "comment", "lines", "nodes", "edges"}, "");
        return readLines() && readGraph();
    }

    void warnUnknown(const Json& object, std::initializer_list<std::string_view> known,
                     const std::string& pointer) {
        for (const auto& [key, value] : object.items()) {
            if (std::find(known.begin(), known.end(), key) != known.end()) continue;
            std::string warning = name_ + "#" + pointer;
            warning.append(": unknown member \"").append(key).append("\" passed over");
            map_.warnings.push_back(std::move(warning));
        }
    }

    /// The array member `key`, an empty one if absent; null after an error.
    const Json* arrayMember(const Json& object, const char* key, const std::string& pointer) {
        static const Json kNone = Json::array();
        const auto found = object.find(key);
        if (found == object.end()) return &kNone;
        if (found->is_array()) return &*found;
        wrong("an array was expected", pointer + "/" + key);
        return nullptr;
    }

    bool readLines() {
        const Json* lines = arrayMember(document_, "lines", "");
        if (lines == nullptr) return false;
        for (size_t i = 0; i < lines->size(); ++i)
            if (!readLine((*lines)[i], "/lines/" + std::to_string(i))) return false;
        return true;
    }

    bool readLine(const Json& line, const std::string& pointer) {
        if (!line.is_object()) return wrong("an object with \"points\" was expected", pointer);
        warnUnknown(line, {"points", "curve", "closed", "level", "name", "comment"}, pointer);
        if (!line.contains("points")) return wrong("the line has no \"points\"", pointer);
        std::vector<glm::dvec2> points;
        if (!readPoints(line, "points", pointer, points)) return false;
        bool closed = false;
        uint32_t level = options_.level;
        std::string name;
        if (!readClosed(line, pointer, closed) || !readLevel(line, pointer, level) ||
            !readName(line, pointer, name))
            return false;
        const std::optional<Outline> outline = outlineOf(line, pointer, std::move(points), closed);
        if (!outline) return false;
        std::string source = name_ + ": line " + pointer.substr(pointer.rfind('/') + 1);
        if (!name.empty()) source += " \"" + name + "\"";
        return addOutline(*outline, level, std::move(source), pointer);
    }

    bool readClosed(const Json& line, const std::string& pointer, bool& closed) {
        const auto found = line.find("closed");
        if (found == line.end()) return true;
        if (!found->is_boolean()) return wrong("true or false was expected", pointer + "/closed");
        closed = found->get<bool>();
        return true;
    }

    bool readLevel(const Json& line, const std::string& pointer, uint32_t& level) {
        const auto found = line.find("level");
        if (found == line.end()) return true;
        if (!found->is_number_integer() || *found < 1 || *found > kMaxMapLevel)
            return wrong("a level from 1 to " + std::to_string(kMaxMapLevel) + " was expected",
                         pointer + "/level");
        level = found->get<uint32_t>();
        return true;
    }

    bool readName(const Json& line, const std::string& pointer, std::string& name) {
        const auto found = line.find("name");
        if (found == line.end()) return true;
        if (!found->is_string()) return wrong("a string was expected", pointer + "/name");
        name = found->get<std::string>();
        return true;
    }

    bool readPoints(const Json& object, const char* key, const std::string& pointer,
                    std::vector<glm::dvec2>& out) {
        const Json* points = arrayMember(object, key, pointer);
        if (points == nullptr) return false;
        for (size_t i = 0; i < points->size(); ++i) {
            const Json& point = (*points)[i];
            if (!point.is_array() || point.size() != 2 || !point[0].is_number() ||
                !point[1].is_number())
                return wrong("a point [u, v] was expected",
                             pointer + "/" + key + "/" + std::to_string(i));
            out.emplace_back(point[0].get<double>(), point[1].get<double>());
        }
        return true;
    }

    std::optional<Outline> outlineOf(const Json& line, const std::string& pointer,
                                     std::vector<glm::dvec2> points, bool closed) {
        const Json curve = line.value("curve", Json("line"));
        if (curve != "line" && curve != "bezier") {
            wrong("\"line\" or \"bezier\" was expected", pointer + "/curve");
            return std::nullopt;
        }
        if (points.size() < 2) {
            wrong("a line needs at least two points", pointer + "/points");
            return std::nullopt;
        }
        if (closed) points.push_back(points.front());
        Outline outline{points.front(), {}, closed};
        if (curve == "line") {
            for (size_t i = 1; i < points.size(); ++i)
                outline.pieces.push_back(linePiece(points[i]));
            return outline;
        }
        if (points.size() % 3 != 1) {
            wrong(closed ? "a closed cubic curve needs 3 n control points"
                         : "a cubic curve needs 3 n + 1 control points",
                  pointer + "/points");
            return std::nullopt;
        }
        for (size_t i = 1; i < points.size(); i += 3)
            outline.pieces.push_back(cubicPiece(points[i], points[i + 1], points[i + 2]));
        return outline;
    }

    bool addOutline(const Outline& outline, uint32_t level, std::string source,
                    const std::string& pointer) {
        auto points = flatten(outline, {}, options_.tolerance, kMaxMapPoints - points_);
        if (!points)
            return stop(ErrorCode::limitExceeded,
                        "the map needs more than " + std::to_string(kMaxMapPoints) +
                            " points at this tolerance; look at the size of this curve, or raise "
                            "the tolerance",
                        pointer);
        points_ += points->size();
        for (const glm::dvec2 p : *points)
            if (!std::isfinite(p.x) || !std::isfinite(p.y))
                return wrong("a coordinate is too large for a number", pointer);
        map_.lines.push_back({std::move(*points), level, std::move(source)});
        return true;
    }

    bool readGraph() {
        std::vector<glm::dvec2> nodes;
        if (!readPoints(document_, "nodes", "", nodes)) return false;
        const Json* edges = arrayMember(document_, "edges", "");
        if (edges == nullptr) return false;
        for (size_t i = 0; i < edges->size(); ++i) {
            const std::string pointer = "/edges/" + std::to_string(i);
            const Json& edge = (*edges)[i];
            if (!edge.is_array() || edge.size() != 2)
                return wrong("an edge [a, b] of two node indices was expected", pointer);
            std::array<size_t, 2> ends{};
            for (size_t k = 0; k < 2; ++k) {
                if (!edge[k].is_number_unsigned() || edge[k] >= nodes.size())
                    return wrong("an index into \"nodes\" (0 to " +
                                     std::to_string(nodes.empty() ? 0 : nodes.size() - 1) +
                                     ") was expected",
                                 pointer + "/" + std::to_string(k));
                ends[k] = edge[k].get<size_t>();
            }
            if (!addOutline({nodes[ends[0]], {linePiece(nodes[ends[1]])}, false}, options_.level,
                            name_ + ": edge " + std::to_string(i), pointer))
                return false;
        }
        return true;
    }

    const Json& document_;
    const std::string& name_;
    const MapReadOptions& options_;
    FractureMap map_;
    size_t points_ = 0;
    Error error_;
};

}  // namespace

Result<FractureMap> readJsonMap(std::string_view text, const std::string& name,
                                const MapReadOptions& options) {
    if (const Result<void> fine = checkMapInput(text, name, options); !fine)
        return tl::unexpected(fine.error());
    try {
        const Json document = Json::parse(text, nullptr, true, /*ignore_comments=*/true);
        return JsonMapReader(document, name, options).read();
    } catch (const Json::exception& e) {
        return fail(ErrorCode::malformed, std::string("the map is not JSON: ") + e.what(), name);
    }
}

}  // namespace sherd
