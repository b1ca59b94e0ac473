// SPDX-License-Identifier: MIT
// Patterns and projections as they are written on a command line or in a recipe.
#include <algorithm>
#include <glm/geometric.hpp>

#include "sherd/baker/pattern.h"
#include "text_fields.h"

namespace sherd {
namespace {

constexpr uint32_t kMostLines = 1'000;

/// Reads one pattern's text part by part; the first mistake ends it.
class PatternReader {
  public:
    explicit PatternReader(std::string_view text) : text_(text), parts_(split(text, ':')) {}

    Result<Pattern> read() {
        pattern_.text = text_;
        if (!readKind() || !readCounts()) return tl::unexpected(error_);
        size_t next = 2;
        if (next < parts_.size() && parts_[next].find('=') == std::string_view::npos &&
            parts_[next] != "brick") {
            if (!readNumber(parts_[next], pattern_.seed))
                return tl::unexpected(wrong(quoted(parts_[next]) +
                                            " is not a seed, a whole number from 0 to 4294967295"));
            ++next;
        }
        for (; next < parts_.size(); ++next)
            if (!readOption(parts_[next])) return tl::unexpected(error_);
        return pattern_;
    }

  private:
    Error wrong(const std::string& what) const {
        return {ErrorCode::badArgument, what, "pattern " + quoted(text_)};
    }
    bool stop(const std::string& what) {
        error_ = wrong(what);
        return false;
    }

    bool readKind() {
        using Kind = Pattern::Kind;
        const std::string_view kind = parts_[0];
        if (kind == "voronoi")
            pattern_.kind = Kind::voronoi;
        else if (kind == "grid")
            pattern_.kind = Kind::grid;
        else if (kind == "radial")
            pattern_.kind = Kind::radial;
        else if (kind == "wood")
            pattern_.kind = Kind::wood;
        else
            return stop("there is no pattern " + quoted(kind) +
                        "; known are voronoi:N, grid:NxM, radial:NxM and wood:N");
        return true;
    }

    bool byCount() const {
        return pattern_.kind == Pattern::Kind::voronoi || pattern_.kind == Pattern::Kind::wood;
    }

    bool readCounts() {
        const std::string_view text = parts_.size() > 1 ? parts_[1] : std::string_view();
        if (byCount()) {
            if (readNumber(text, pattern_.count) && pattern_.count >= 1 &&
                pattern_.count <= kMostPieces)
                return true;
            return stop(quoted(text) + " is not a number of pieces from 1 to " +
                        std::to_string(kMostPieces));
        }
        const std::vector<std::string_view> sides = split(text, 'x');
        const auto fine = [](uint32_t n) { return n >= 1 && n <= kMostLines; };
        if (sides.size() == 2 && readNumber(sides[0], pattern_.columns) &&
            readNumber(sides[1], pattern_.rows) && fine(pattern_.columns) && fine(pattern_.rows)) {
            if (pattern_.columns * pattern_.rows <= kMostPieces) return true;
            return stop(quoted(text) + " makes more than " + std::to_string(kMostPieces) +
                        " pieces");
        }
        return stop(quoted(text) + " is not COLUMNSxROWS (radial: SECTORSxRINGS), each from 1 to " +
                    std::to_string(kMostLines));
    }

    bool readOption(std::string_view part) {
        const size_t equals = part.find('=');
        const std::string_view key = part.substr(0, equals);
        const std::string_view value =
            equals == std::string_view::npos ? std::string_view() : part.substr(equals + 1);
        if (key == "jitter") return readShare(key, value, 0, 1, pattern_.jitter);
        using Kind = Pattern::Kind;
        switch (pattern_.kind) {
            case Kind::voronoi:
                if (key == "around") return readPlaces(value);
                if (key == "spread") return readShare(key, value, 1e-6, 10, pattern_.spread);
                if (key == "density") return readDensity(value);
                return unknown(key, "jitter, around, spread, density");
            case Kind::wood:
                if (key == "axis") return readAxis(value);
                if (key == "elongation") return readShare(key, value, 1, 1000, pattern_.elongation);
                if (key == "density") return readDensity(value);
                return unknown(key, "jitter, axis, elongation, density");
            case Kind::grid:
                if (part == "brick") return pattern_.brick = true;
                if (key == "on") return readProjection(value);
                return unknown(key, "jitter, brick, on");
            case Kind::radial:
                if (key == "at") return readCentre(value);
                if (key == "axis") return readAxis(value);
                return unknown(key, "jitter, at, axis");
        }
        return false;
    }

    bool unknown(std::string_view key, const char* known) {
        return stop(quoted(key) + " is not known here; known are " + known);
    }
    bool readShare(std::string_view key, std::string_view value, double low, double high,
                   double& number) {
        if (readNumber(value, number) && number >= low && number <= high) return true;
        const auto text = [](double x) {
            std::string s = std::to_string(x);
            s.erase(s.find_last_not_of('0') + 1);
            if (s.back() == '.') s.pop_back();
            return s;
        };
        return stop(std::string(key) + "=" + std::string(value) + " is not a number from " +
                    text(low) + " to " + text(high));
    }
    bool readPlaces(std::string_view value) {
        for (const std::string_view place : split(value, ';')) {
            glm::dvec3 point;
            if (!readVector(place, point))
                return stop("around=" + std::string(value) + " is not X,Y,Z[;X,Y,Z]...");
            pattern_.around.push_back(point);
        }
        return true;
    }
    bool readCentre(std::string_view value) {
        glm::dvec3 point;
        if (!readVector(value, point)) return stop("at=" + std::string(value) + " is not X,Y,Z");
        pattern_.centre = point;
        return true;
    }
    bool readAxis(std::string_view value) {
        const Result<glm::dvec3> axis = parseAxis(value);
        if (!axis) return stop(axis.error().message);
        pattern_.axis = *axis;
        return true;
    }
    bool readProjection(std::string_view value) {
        std::string text(value);
        std::replace(text.begin(), text.end(), '/', ':');
        const Result<Projection> projection = parseProjection(text);
        if (!projection) return stop(projection.error().message);
        pattern_.projection = *projection;
        return true;
    }
    bool readDensity(std::string_view value) {
        if (value.empty()) return stop("density= names a grey picture, or color");
        pattern_.density = value;
        return true;
    }

    std::string_view text_;
    std::vector<std::string_view> parts_;
    Pattern pattern_;
    Error error_;
};

}  // namespace

Result<glm::dvec3> parseAxis(std::string_view text) {
    glm::dvec3 axis(0.0);
    std::string_view letter = text;
    const bool negative = !letter.empty() && letter.front() == '-';
    if (negative) letter.remove_prefix(1);
    if (letter.size() == 1 && letter[0] >= 'x' && letter[0] <= 'z') {
        axis[letter[0] - 'x'] = negative ? -1 : 1;
        return axis;
    }
    if (readVector(text, axis) && glm::length(axis) > 1e-30 && glm::length(axis) < 1e30)
        return glm::normalize(axis);
    return fail(ErrorCode::badArgument,
                quoted(text) + " is not an axis: x, -x, y, -y, z, -z, or X,Y,Z");
}

Result<Projection> parseProjection(std::string_view text) {
    const size_t colon = text.find(':');
    const std::string_view kind = text.substr(0, colon);
    Projection projection;
    if (kind == "uv")
        projection.kind = Projection::Kind::uv;
    else if (kind == "planar")
        projection.kind = Projection::Kind::planar;
    else if (kind == "cylindrical")
        projection.kind = Projection::Kind::cylindrical;
    else if (kind == "box")
        projection.kind = Projection::Kind::box;
    else
        return fail(ErrorCode::badArgument,
                    "there is no projection " + quoted(text) +
                        "; known are uv, planar[:AXIS], cylindrical[:AXIS] and box");
    if (colon == std::string_view::npos) return projection;
    if (kind == "uv" || kind == "box")
        return fail(ErrorCode::badArgument, "the projection " + std::string(kind) + " has no axis");
    const Result<glm::dvec3> axis = parseAxis(text.substr(colon + 1));
    if (!axis) return tl::unexpected(axis.error());
    projection.axis = *axis;
    return projection;
}

Result<Pattern> parsePattern(std::string_view text) {
    return PatternReader(text).read();
}

}  // namespace sherd
