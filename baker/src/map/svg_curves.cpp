// SPDX-License-Identifier: MIT
// Curves to lines: uniform steps in the parameter, as many as the second derivative (cubics) or the
// larger radius (arcs) asks for after the transform.
#include "map/svg_curves.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sherd {

namespace {

constexpr double kPi = 3.14159265358979323846;

double angleBetween(glm::dvec2 from, glm::dvec2 to) {
    return std::atan2(from.x * to.y - from.y * to.x, glm::dot(from, to));
}

struct Cubic {
    glm::dvec2 p0, p1, p2, p3;
    glm::dvec2 at(double t) const {
        const double s = 1 - t;
        return s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
    }
};

/// A chord over a step h of the parameter strays by at most h^2 / 8 max|B''|.
double cubicSteps(const Cubic& c, double tolerance) {
    const double bend =
        6 * std::max(glm::length(c.p0 - 2.0 * c.p1 + c.p2), glm::length(c.p1 - 2.0 * c.p2 + c.p3));
    return std::ceil(std::sqrt(bend / (8 * tolerance)));
}

/// A chord over an angle h strays by at most R (1 - cos(h / 2)).
double arcSteps(double radius, double sweep, double tolerance) {
    const double ratio = std::clamp(1 - tolerance / radius, 0.0, 1.0);
    const double step = std::min(2 * std::acos(ratio), kPi / 2);
    return step > 0 ? std::ceil(std::abs(sweep) / step) : std::sqrt(radius / tolerance) * 4;
}

/// Calls at(k / steps) for the points after the first and before the last.
template <class Curve>
bool addInner(double steps, size_t limit, const Curve& at, std::vector<glm::dvec2>& out) {
    if (!(steps + static_cast<double>(out.size()) < static_cast<double>(limit))) return false;
    const auto count = static_cast<size_t>(std::max(steps, 1.0));
    for (size_t k = 1; k < count; ++k)
        out.push_back(at(static_cast<double>(k) / static_cast<double>(count)));
    return true;
}

bool addPiece(const CurvePiece& piece, const Affine& transform, double tolerance, size_t limit,
              std::vector<glm::dvec2>& out) {
    bool fits = true;
    if (piece.kind == CurvePiece::Kind::cubic) {
        const Cubic cubic{out.back(), transform.point(piece.control1),
                          transform.point(piece.control2), transform.point(piece.to)};
        fits = addInner(
            cubicSteps(cubic, tolerance), limit, [&](double t) { return cubic.at(t); }, out);
    } else if (piece.kind == CurvePiece::Kind::arc) {
        const glm::dvec2 centre = transform.point(piece.centre);
        const glm::dvec2 u = transform.direction(piece.axisU);
        const glm::dvec2 v = transform.direction(piece.axisV);
        const double radius = std::sqrt(glm::dot(u, u) + glm::dot(v, v));  // >= the larger one
        fits = addInner(
            arcSteps(radius, piece.sweep, tolerance), limit,
            [&](double t) {
                const double angle = piece.start + t * piece.sweep;
                return centre + std::cos(angle) * u + std::sin(angle) * v;
            },
            out);
    }
    if (!fits || out.size() >= limit) return false;
    out.push_back(transform.point(piece.to));
    return true;
}

}  // namespace

CurvePiece linePiece(glm::dvec2 to) {
    CurvePiece piece;
    piece.to = to;
    return piece;
}

CurvePiece cubicPiece(glm::dvec2 control1, glm::dvec2 control2, glm::dvec2 to) {
    CurvePiece piece;
    piece.kind = CurvePiece::Kind::cubic;
    piece.control1 = control1;
    piece.control2 = control2;
    piece.to = to;
    return piece;
}

CurvePiece quadraticPiece(glm::dvec2 from, glm::dvec2 control, glm::dvec2 to) {
    return cubicPiece(from + (control - from) * (2.0 / 3.0), to + (control - to) * (2.0 / 3.0), to);
}

// From end points to centre: SVG 1.1, implementation notes F.6.5 and F.6.6.
CurvePiece arcPiece(glm::dvec2 from, const ArcArguments& arc, glm::dvec2 to) {
    double rx = std::abs(arc.rx);
    double ry = std::abs(arc.ry);
    if (rx == 0 || ry == 0 || from == to) return linePiece(to);
    const double phi = arc.rotation * kPi / 180;
    const glm::dvec2 x(std::cos(phi), std::sin(phi));
    const glm::dvec2 y(-x.y, x.x);
    const glm::dvec2 half = (from - to) * 0.5;
    // In the frame of the ellipse, scaled so that it is the unit circle.
    glm::dvec2 p(glm::dot(half, x) / rx, glm::dot(half, y) / ry);
    const double reach = glm::dot(p, p);
    if (reach > 1) {
        const double grow = std::sqrt(reach);
        rx *= grow;
        ry *= grow;
        p /= grow;
    }
    const double size = glm::dot(p, p);
    double away = size > 0 ? std::sqrt(std::max(0.0, 1 / size - 1)) : 0;
    if (arc.large == arc.sweep) away = -away;
    const glm::dvec2 centre = away * glm::dvec2(p.y, -p.x);

    CurvePiece piece;
    piece.kind = CurvePiece::Kind::arc;
    piece.to = to;
    piece.axisU = rx * x;
    piece.axisV = ry * y;
    piece.centre = (from + to) * 0.5 + centre.x * piece.axisU + centre.y * piece.axisV;
    piece.start = angleBetween({1, 0}, p - centre);
    piece.sweep = angleBetween(p - centre, -p - centre);
    if (arc.sweep && piece.sweep < 0) piece.sweep += 2 * kPi;
    if (!arc.sweep && piece.sweep > 0) piece.sweep -= 2 * kPi;
    return piece;
}

std::optional<std::vector<glm::dvec2>> flatten(const Outline& outline, const Affine& transform,
                                               double tolerance, size_t limit) {
    std::vector<glm::dvec2> points{transform.point(outline.start)};
    for (const CurvePiece& piece : outline.pieces)
        if (!addPiece(piece, transform, tolerance, limit, points)) return std::nullopt;
    return points;
}

}  // namespace sherd
