// SPDX-License-Identifier: MIT
// Sherd's own map format: formats/spec/fracture_map/README.md.
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "map/json_fields.h"
#include "map/map_limits.h"
#include "map/nurbs.h"
#include "map/svg_curves.h"

namespace sherd {

namespace {

using Json = nlohmann::json;

/// What every line has, drawn or over the surface, and "defaults" too.
struct LineSettings {
    uint32_t level = 1;
    LineProperties properties = {};
    bool closed = false;
    std::string source = {};
};

/// Reads a parsed document; the first mistake ends it, with the JSON pointer of the culprit.
class JsonMapReader {
  public:
    JsonMapReader(const Json& document, const std::string& name, const MapReadOptions& options)
        : document_{document, ""}, name_(name), tolerance_(options.tolerance), fields_(name) {
        defaults_.level = options.level;
    }

    Result<FractureMap> read() {
        if (!readDocument()) return tl::unexpected(fields_.takeError());
        if (map_.empty())
            return fail(ErrorCode::emptyMap,
                        "the map holds no line to break along; give it \"lines\", or \"nodes\" and "
                        "\"edges\"",
                        name_);
        map_.warnings = fields_.takeWarnings();
        return std::move(map_);
    }

  private:
    bool readDocument() {
        const Json& document = document_.value;
        if (!document.is_object() || !document.contains("sherdMap"))
            return fields_.stop(
                ErrorCode::malformed,
                "not a Sherd fracture map: an object with \"sherdMap\": 1 was expected", "");
        const Json& version = document["sherdMap"];
        if (!version.is_number_integer() || version != 1)
            return fields_.stop(ErrorCode::unsupported, "only version 1 of the map format is known",
                                "/sherdMap");
        fields_.warnUnknown(document_, {"sherdMap", "$schema", "comment", "defaults", "lines",
                                        "nodes", "edges", "labels"});
        return readDefaults() && readLines() && readGraph() && readLabels();
    }

    bool readDefaults() {
        if (!document_.value.contains("defaults")) return true;
        const JsonPlace defaults = document_.member("defaults");
        if (!defaults.value.is_object())
            return fields_.wrong("an object was expected", defaults.pointer);
        fields_.warnUnknown(defaults, {"level", "strength", "toughness", "comment"});
        return readSettings(defaults, defaults_);
    }

    bool readSettings(const JsonPlace& object, LineSettings& out) {
        return fields_.level(object, 1, out.level) &&
               fields_.quantity(object, "strength", false, out.properties.strength) &&
               fields_.quantity(object, "toughness", false, out.properties.toughness);
    }

    bool readLines() {
        const std::optional<JsonPlace> lines = fields_.array(document_, "lines");
        if (!lines) return false;
        for (size_t i = 0; i < lines->value.size(); ++i)
            if (!readLine(lines->item(i), i)) return false;
        return true;
    }

    bool readLine(const JsonPlace& line, size_t index) {
        if (!line.value.is_object())
            return fields_.wrong("an object with \"points\" was expected", line.pointer);
        fields_.warnUnknown(line, {"points", "surface", "curve", "degree", "weights", "knots",
                                   "closed", "level", "strength", "toughness", "name", "comment"});
        if (!line.value.contains("points"))
            return fields_.wrong("the line has no \"points\"", line.pointer);
        LineSettings settings = defaults_;
        std::string name;
        bool surface = false;
        if (!fields_.flag(line, "closed", settings.closed) || !readSettings(line, settings) ||
            !fields_.text(line, "name", name) || !fields_.flag(line, "surface", surface))
            return false;
        settings.source = name_ + ": line " + std::to_string(index);
        if (!name.empty()) settings.source += " \"" + name + "\"";
        return surface ? readSurfaceLine(line, settings) : readDrawnLine(line, settings);
    }

    bool readSurfaceLine(const JsonPlace& line, const LineSettings& settings) {
        if (line.value.value("curve", Json("line")) != "line")
            return fields_.wrong(
                "\"line\" was expected: a line over the surface is straight from place to place",
                line.pointer + "/curve");
        const std::optional<JsonPlace> points = fields_.array(line, "points");
        if (!points) return false;
        FractureMap::SurfaceLine out{{}, settings.level, settings.source, settings.properties};
        for (size_t i = 0; i < points->value.size(); ++i)
            if (!fields_.place(points->value[i], out.places.emplace_back(),
                               points->item(i).pointer))
                return false;
        if (out.places.size() < 2)
            return fields_.wrong("a line needs at least two points", points->pointer);
        if (settings.closed) out.places.push_back(out.places.front());
        map_.surfaceLines.push_back(std::move(out));
        return true;
    }

    bool readDrawnLine(const JsonPlace& line, const LineSettings& settings) {
        std::vector<glm::dvec2> points;
        if (!readPoints(line, "points", points)) return false;
        const Json curve = line.value.value("curve", Json("line"));
        if (curve != "line" && curve != "bezier" && curve != "nurbs")
            return fields_.wrong("\"line\", \"bezier\" or \"nurbs\" was expected",
                                 line.pointer + "/curve");
        for (const char* member : {"degree", "weights", "knots"})
            if (curve != "nurbs" && line.value.contains(member))
                fields_.warn(line.pointer, std::string("\"") + member +
                                               "\" passed over: only a \"nurbs\" curve has it");
        if (points.size() < 2)
            return fields_.wrong("a line needs at least two points", line.pointer + "/points");
        if (curve == "nurbs") return readNurbs(line, std::move(points), settings);
        if (settings.closed) points.push_back(points.front());
        if (curve == "line") return addPolyline(points, settings, line.pointer);
        if (points.size() % 3 != 1)
            return fields_.wrong(settings.closed ? "a closed cubic curve needs 3 n control points"
                                                 : "a cubic curve needs 3 n + 1 control points",
                                 line.pointer + "/points");
        Outline outline{points.front(), {}, settings.closed};
        for (size_t i = 1; i < points.size(); i += 3)
            outline.pieces.push_back(cubicPiece(points[i], points[i + 1], points[i + 2]));
        return addOutline(outline, settings, line.pointer);
    }

    bool readNurbs(const JsonPlace& line, std::vector<glm::dvec2> points,
                   const LineSettings& settings) {
        NurbsCurve curve;
        curve.closed = settings.closed;
        curve.points = std::move(points);
        if (line.value.contains("degree")) {
            const auto [value, pointer] = line.member("degree");
            if (!value.is_number_integer() || value < 1 || value > kMaxNurbsDegree)
                return fields_.wrong(
                    "a degree from 1 to " + std::to_string(kMaxNurbsDegree) + " was expected",
                    pointer);
            curve.degree = value.get<size_t>();
        }
        for (const auto& [key, target] :
             {std::pair("weights", &curve.weights), std::pair("knots", &curve.knots)}) {
            if (!fields_.numbers(line, key, *target)) return false;
            if (line.value.contains(key) && target->empty())
                return fields_.wrong("numbers were expected; leave it out for the default",
                                     line.pointer + "/" + key);
        }
        if (const std::optional<NurbsProblem> problem = checkNurbs(curve))
            return fields_.wrong(problem->message, line.pointer + "/" + problem->member);
        return addPoints(flattenNurbs(curve, tolerance_, kMaxMapPoints - points_), settings,
                         line.pointer);
    }

    bool readPoints(const JsonPlace& object, const char* key, std::vector<glm::dvec2>& out) {
        const std::optional<JsonPlace> points = fields_.array(object, key);
        if (!points) return false;
        for (size_t i = 0; i < points->value.size(); ++i)
            if (!fields_.point(*points, i, out.emplace_back())) return false;
        return true;
    }

    bool addPolyline(const std::vector<glm::dvec2>& points, const LineSettings& settings,
                     const std::string& pointer) {
        Outline outline{points.front(), {}, settings.closed};
        for (size_t i = 1; i < points.size(); ++i) outline.pieces.push_back(linePiece(points[i]));
        return addOutline(outline, settings, pointer);
    }

    bool addOutline(const Outline& outline, const LineSettings& settings,
                    const std::string& pointer) {
        return addPoints(flatten(outline, {}, tolerance_, kMaxMapPoints - points_), settings,
                         pointer);
    }

    bool addPoints(std::optional<std::vector<glm::dvec2>> points, const LineSettings& settings,
                   const std::string& pointer) {
        if (!points)
            return fields_.stop(ErrorCode::limitExceeded,
                                "the map needs more than " + std::to_string(kMaxMapPoints) +
                                    " points at this tolerance; look at the size of this curve, or "
                                    "raise the tolerance",
                                pointer);
        points_ += points->size();
        for (const glm::dvec2 p : *points)
            if (!std::isfinite(p.x) || !std::isfinite(p.y))
                return fields_.wrong("a coordinate is too large for a number", pointer);
        map_.lines.push_back(
            {std::move(*points), settings.level, settings.source, settings.properties});
        return true;
    }

    bool readGraph() {
        std::vector<glm::dvec2> nodes;
        if (!readPoints(document_, "nodes", nodes)) return false;
        const std::optional<JsonPlace> edges = fields_.array(document_, "edges");
        if (!edges) return false;
        for (size_t i = 0; i < edges->value.size(); ++i) {
            const JsonPlace edge = edges->item(i);
            if (!edge.value.is_array() || edge.value.size() != 2)
                return fields_.wrong("an edge [a, b] of two node indices was expected",
                                     edge.pointer);
            std::vector<glm::dvec2> ends;
            for (size_t k = 0; k < 2; ++k) {
                const auto [index, pointer] = edge.item(k);
                if (!index.is_number_unsigned() || index >= nodes.size())
                    return fields_.wrong("an index into \"nodes\" (0 to " +
                                             std::to_string(nodes.empty() ? 0 : nodes.size() - 1) +
                                             ") was expected",
                                         pointer);
                ends.push_back(nodes[index.get<size_t>()]);
            }
            LineSettings settings = defaults_;
            settings.source = name_ + ": edge " + std::to_string(i);
            if (!addPolyline(ends, settings, edge.pointer)) return false;
        }
        return true;
    }

    bool readLabels() {
        const std::optional<JsonPlace> labels = fields_.array(document_, "labels");
        if (!labels) return false;
        if (labels->value.size() > kMaxMapLabels)
            return fields_.stop(
                ErrorCode::limitExceeded,
                "the map holds more than " + std::to_string(kMaxMapLabels) + " labels",
                labels->pointer);
        for (size_t i = 0; i < labels->value.size(); ++i)
            if (!readLabel(labels->item(i), i)) return false;
        return true;
    }

    bool readLabel(const JsonPlace& label, size_t index) {
        if (!label.value.is_object() || !label.value.contains("at"))
            return fields_.wrong("an object with \"at\", the label's place, was expected",
                                 label.pointer);
        fields_.warnUnknown(label, {"at", "name", "material", "density", "strength", "toughness",
                                    "anchor", "level", "comment"});
        FractureMap::Label out;
        if (!fields_.place(label.value["at"], out.place, label.pointer + "/at") ||
            !fields_.text(label, "name", out.name) ||
            !fields_.text(label, "material", out.material) ||
            !fields_.quantity(label, "density", true, out.density) ||
            !fields_.quantity(label, "strength", false, out.strength) ||
            !fields_.quantity(label, "toughness", false, out.toughness) ||
            !fields_.flag(label, "anchor", out.anchor) || !fields_.level(label, 0, out.level))
            return false;
        out.source = name_ + ": label " + std::to_string(index);
        if (!out.name.empty()) out.source += " \"" + out.name + "\"";
        map_.labels.push_back(std::move(out));
        return true;
    }

    JsonPlace document_;
    const std::string& name_;
    double tolerance_;
    JsonFields fields_;
    LineSettings defaults_;
    FractureMap map_;
    size_t points_ = 0;
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
