// SPDX-License-Identifier: MIT
#include "pattern/page_patterns.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "geometry/dice.h"

namespace sherd {
namespace {

/// Which of n equal parts of [0, 1] holds x, or is nearest; the first for what is no number.
uint32_t cellOf(double x, uint32_t n) {
    if (!(x > 0)) return 0;
    return static_cast<uint32_t>(std::min(std::floor(x * n), n - 1.0));
}

/// Whether the polygon holds the point (even-odd).
bool holds(std::initializer_list<glm::dvec2> polygon, const glm::dvec2& p) {
    bool inside = false;
    const glm::dvec2* previous = polygon.end() - 1;
    for (const glm::dvec2& q : polygon) {
        if ((q.y > p.y) != (previous->y > p.y) &&
            p.x < (previous->x - q.x) * (p.y - q.y) / (previous->y - q.y) + q.x)
            inside = !inside;
        previous = &q;
    }
    return inside;
}

struct Grid {
    uint32_t columns, rows;
    std::vector<glm::dvec2> nodes;  ///< (columns + 1) x (rows + 1)
    const glm::dvec2& node(uint32_t c, uint32_t r) const { return nodes[r * (columns + 1) + c]; }

    uint32_t cellAt(const glm::dvec2& uv) const {
        const auto clamped = [](double x, uint32_t n) {
            return static_cast<int64_t>(cellOf(x, n));
        };
        const int64_t c0 = clamped(uv.x, columns);
        const int64_t r0 = clamped(uv.y, rows);
        // A node lies less than half a cell from where it would be without jitter.
        for (int64_t r = std::max<int64_t>(0, r0 - 1); r <= std::min<int64_t>(rows - 1, r0 + 1);
             ++r) {
            for (int64_t c = std::max<int64_t>(0, c0 - 1);
                 c <= std::min<int64_t>(columns - 1, c0 + 1); ++c) {
                const auto x = static_cast<uint32_t>(c);
                const auto y = static_cast<uint32_t>(r);
                if (holds({node(x, y), node(x + 1, y), node(x + 1, y + 1), node(x, y + 1)}, uv))
                    return y * columns + x;
            }
        }
        return static_cast<uint32_t>(r0 * columns + c0);
    }
};

/// Lines reach over the page's edges a little, so that they cut what lies right on them.
constexpr double kOverhang = 1.0 / 64;

PagePattern plainGrid(const Pattern& pattern) {
    const auto grid = std::make_shared<Grid>(Grid{pattern.columns, pattern.rows, {}});
    Dice dice(pattern.seed);
    const double jitter = 0.3 * std::max(0.0, pattern.jitter);
    for (uint32_t r = 0; r <= grid->rows; ++r) {
        for (uint32_t c = 0; c <= grid->columns; ++c) {
            const double dx = jitter * dice.signedUnit();
            const double dy = jitter * dice.signedUnit();
            const bool sideC = c == 0 || c == grid->columns;
            const bool sideR = r == 0 || r == grid->rows;
            double x = (c + (sideC ? 0 : dx)) / grid->columns;
            double y = (r + (sideR ? 0 : dy)) / grid->rows;
            if (sideC) x += c == 0 ? -kOverhang : kOverhang;
            if (sideR) y += r == 0 ? -kOverhang : kOverhang;
            grid->nodes.emplace_back(x, y);
        }
    }
    PagePattern page;
    for (uint32_t c = 1; c < grid->columns; ++c) {
        FractureMap::Line line{{}, 1, pattern.text, {}};
        for (uint32_t r = 0; r <= grid->rows; ++r) line.points.push_back(grid->node(c, r));
        page.map.lines.push_back(std::move(line));
    }
    for (uint32_t r = 1; r < grid->rows; ++r) {
        FractureMap::Line line{{}, 1, pattern.text, {}};
        for (uint32_t c = 0; c <= grid->columns; ++c) line.points.push_back(grid->node(c, r));
        page.map.lines.push_back(std::move(line));
    }
    page.cells = grid->columns * grid->rows;
    page.cellAt = [grid](const glm::dvec2& uv) { return grid->cellAt(uv); };
    return page;
}

PagePattern bricks(const Pattern& pattern) {
    Dice dice(pattern.seed);
    const double jitter = 0.3 * std::max(0.0, pattern.jitter);
    // Joints of every row, ascending; between rows straight lines.
    const auto joints = std::make_shared<std::vector<std::vector<double>>>(pattern.rows);
    PagePattern page;
    std::vector<uint32_t> first;
    for (uint32_t r = 0; r < pattern.rows; ++r) {
        const bool shifted = r % 2 == 1;
        for (uint32_t c = shifted ? 0 : 1; c < pattern.columns; ++c) {
            const double x =
                (c + (shifted ? 0.5 : 0.0) + jitter * dice.signedUnit()) / pattern.columns;
            const double top = r == 0 ? -kOverhang : double{1} * r / pattern.rows;
            const double bottom = r + 1 == pattern.rows ? 1 + kOverhang : (r + 1.0) / pattern.rows;
            (*joints)[r].push_back(x);
            page.map.lines.push_back({{{x, top}, {x, bottom}}, 1, pattern.text, {}});
        }
        if (r > 0) {
            const double y = double{1} * r / pattern.rows;
            page.map.lines.push_back({{{-kOverhang, y}, {1 + kOverhang, y}}, 1, pattern.text, {}});
        }
        first.push_back(page.cells);
        page.cells += static_cast<uint32_t>((*joints)[r].size()) + 1;
    }
    page.cellAt = [joints, first](const glm::dvec2& uv) {
        const size_t r = cellOf(uv.y, static_cast<uint32_t>(joints->size()));
        const std::vector<double>& row = (*joints)[r];
        const auto before = std::lower_bound(row.begin(), row.end(), uv.x) - row.begin();
        return first[r] + static_cast<uint32_t>(before);
    };
    return page;
}

/// Spokes at fine steps of angle, so that rings are polygons that look round; only every `step`-th
/// is a fracture line.
struct Web {
    uint32_t sectors, rings, step;
    std::vector<double> angle;   ///< per fine spoke, ascending over one turn
    std::vector<double> radius;  ///< [fine spoke * (rings - 1) + ring]

    glm::dvec2 at(size_t spoke, uint32_t ring) const {
        const size_t s = spoke % angle.size();
        const double r = radius[s * (rings - 1) + ring];
        return {r * std::cos(angle[s]), r * std::sin(angle[s])};
    }
    uint32_t cellAt(const glm::dvec2& p) const {
        double a = std::atan2(p.y, p.x);
        while (a < angle.front()) a += 2 * M_PI;
        while (a >= angle.front() + 2 * M_PI) a -= 2 * M_PI;
        const size_t spoke =
            static_cast<size_t>(std::upper_bound(angle.begin(), angle.end(), a) - angle.begin()) -
            1;
        uint32_t ring = 0;
        for (; ring + 1 < rings; ++ring) {
            const glm::dvec2 x = at(spoke, ring);
            const glm::dvec2 y = at(spoke + 1, ring);
            // Spokes turn counter-clockwise: the middle lies left of a ring's side.
            if ((y.x - x.x) * (p.y - x.y) - (y.y - x.y) * (p.x - x.x) > 0) break;
        }
        return ring * sectors + static_cast<uint32_t>(spoke / step);
    }
};

}  // namespace

PagePattern drawGrid(const Pattern& pattern) {
    return pattern.brick ? bricks(pattern) : plainGrid(pattern);
}

PagePattern drawRadial(const Pattern& pattern, double reach) {
    const double jitter = pattern.jitter < 0 ? 0.5 : pattern.jitter;
    Dice dice(pattern.seed);
    const auto web = std::make_shared<Web>(Web{pattern.columns, pattern.rows, 1, {}, {}});
    web->step = std::max(1U, (24 + web->sectors - 1) / web->sectors);
    const uint32_t fine = web->sectors * web->step;
    for (uint32_t s = 0; s < fine; ++s) {
        const double shift = s % web->step == 0 ? 0.35 * jitter * dice.signedUnit() : 0;
        web->angle.push_back(2 * M_PI * (s + shift * web->step) / fine);
    }
    // Between spokes that lie unevenly the fine ones spread evenly.
    for (uint32_t s = 0; s < fine; ++s) {
        const uint32_t left = s - s % web->step;
        const double from = web->angle[left];
        const double to =
            left + web->step < fine ? web->angle[left + web->step] : web->angle[0] + 2 * M_PI;
        web->angle[s] = from + (to - from) * (s - left) / web->step;
        for (uint32_t k = 0; k + 1 < web->rings; ++k) {
            const double even = std::pow((k + 1.0) / web->rings, 1.5) * reach;
            const double gap = even - std::pow(double{1} * k / web->rings, 1.5) * reach;
            web->radius.push_back(even - 0.35 * jitter * gap * (1 + dice.signedUnit()) / 2);
        }
    }
    PagePattern page;
    const double end = 1.25 * reach;
    for (uint32_t s = 0; s < fine && web->sectors > 1; s += web->step) {
        const double a = web->angle[s];
        page.map.lines.push_back(
            {{{0, 0}, {end * std::cos(a), end * std::sin(a)}}, 1, pattern.text, {}});
    }
    for (uint32_t k = 0; k + 1 < web->rings; ++k) {
        FractureMap::Line ring{{}, 1, pattern.text, {}};
        for (uint32_t s = 0; s <= fine; ++s) ring.points.push_back(web->at(s, k));
        page.map.lines.push_back(std::move(ring));
    }
    page.cells = web->sectors * web->rings;
    page.cellAt = [web](const glm::dvec2& p) { return web->cellAt(p); };
    return page;
}

}  // namespace sherd
