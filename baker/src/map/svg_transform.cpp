// SPDX-License-Identifier: MIT
#include "map/svg_transform.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "map/svg_scanner.h"

namespace sherd {

namespace {

double radians(double degrees) {
    return degrees * (3.14159265358979323846 / 180.0);
}

Affine rotation(double degrees) {
    const double s = std::sin(radians(degrees));
    const double c = std::cos(radians(degrees));
    return {c, s, -s, c, 0, 0};
}

/// One function of the list, or nothing if it takes another number of arguments.
std::optional<Affine> transformOf(std::string_view name, const std::vector<double>& v) {
    const size_t n = v.size();
    if (name == "matrix" && n == 6) return Affine{v[0], v[1], v[2], v[3], v[4], v[5]};
    if (name == "translate" && (n == 1 || n == 2))
        return Affine{1, 0, 0, 1, v[0], n == 2 ? v[1] : 0};
    if (name == "scale" && (n == 1 || n == 2)) return Affine{v[0], 0, 0, v[n - 1], 0, 0};
    if (name == "rotate" && n == 1) return rotation(v[0]);
    if (name == "rotate" && n == 3)
        return Affine{1, 0, 0, 1, v[1], v[2]} * rotation(v[0]) * Affine{1, 0, 0, 1, -v[1], -v[2]};
    if (name == "skewX" && n == 1) return Affine{1, 0, std::tan(radians(v[0])), 1, 0, 0};
    if (name == "skewY" && n == 1) return Affine{1, std::tan(radians(v[0])), 0, 1, 0, 0};
    return std::nullopt;
}

std::optional<double> unitFactor(std::string_view unit, double whole) {
    if (unit.empty() || unit == "px") return 1.0;
    if (unit == "%") return whole / 100.0;
    if (unit == "in") return 96.0;
    if (unit == "cm") return 96.0 / 2.54;
    if (unit == "mm") return 96.0 / 25.4;
    if (unit == "pt") return 96.0 / 72.0;
    if (unit == "pc") return 16.0;
    if (unit == "em" || unit == "rem") return 16.0;
    if (unit == "ex") return 8.0;
    return std::nullopt;
}

}  // namespace

Affine operator*(const Affine& outer, const Affine& inner) {
    const glm::dvec2 x = outer.direction({inner.a, inner.b});
    const glm::dvec2 y = outer.direction({inner.c, inner.d});
    const glm::dvec2 t = outer.point({inner.e, inner.f});
    return {x.x, x.y, y.x, y.y, t.x, t.y};
}

std::optional<Affine> parseSvgTransform(std::string_view text) {
    SvgScanner scanner(text);
    Affine result;
    scanner.skipSpace();
    if (scanner.rest() == "none") return result;
    while (!scanner.atEnd()) {
        const std::string_view name = scanner.word();
        scanner.skipSpace();
        if (name.empty() || !scanner.take('(')) return std::nullopt;
        std::vector<double> values;
        scanner.skipSpace();
        while (!scanner.take(')')) {
            const std::optional<double> value = scanner.number();
            if (!value || values.size() == 6) return std::nullopt;
            values.push_back(*value);
            scanner.skipCommaSpace();
        }
        const std::optional<Affine> next = transformOf(name, values);
        if (!next) return std::nullopt;
        result = result * *next;
        scanner.skipCommaSpace();
    }
    return result;
}

std::optional<double> parseSvgLength(std::string_view text, double whole) {
    SvgScanner scanner(text);
    scanner.skipSpace();
    const std::optional<double> value = scanner.number();
    if (!value) return std::nullopt;
    std::string_view unit = scanner.rest();
    while (!unit.empty() && (unit.back() == ' ' || unit.back() == '\n' || unit.back() == '\t'))
        unit.remove_suffix(1);
    const std::optional<double> factor = unitFactor(unit, whole);
    if (!factor) return std::nullopt;
    return *value * *factor;
}

std::optional<SvgViewBox> parseSvgViewBox(std::string_view text) {
    SvgScanner scanner(text);
    double values[4];
    for (double& value : values) {
        scanner.skipCommaSpace();
        const std::optional<double> number = scanner.number();
        if (!number) return std::nullopt;
        value = *number;
    }
    if (!(values[2] > 0) || !(values[3] > 0)) return std::nullopt;
    return SvgViewBox{values[0], values[1], values[2], values[3]};
}

Affine fitSvgViewBox(const SvgViewBox& box, double width, double height, std::string_view aspect) {
    double sx = width / box.width;
    double sy = height / box.height;
    if (aspect.find("none") == std::string_view::npos) {
        const bool slice = aspect.find("slice") != std::string_view::npos;
        sx = sy = slice ? std::max(sx, sy) : std::min(sx, sy);
    }
    const auto align = [&](std::string_view low, std::string_view high) {
        if (aspect.find(low) != std::string_view::npos) return 0.0;
        return aspect.find(high) != std::string_view::npos ? 1.0 : 0.5;
    };
    const double dx = align("xMin", "xMax") * (width - sx * box.width);
    const double dy = align("YMin", "YMax") * (height - sy * box.height);
    return {sx, 0, 0, sy, dx - sx * box.x, dy - sy * box.y};
}

}  // namespace sherd
