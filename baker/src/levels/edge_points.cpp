// SPDX-License-Identifier: MIT
#include "levels/edge_points.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

#include "geometry/union_find.h"

namespace sherd {
namespace {

auto placeIn(const std::vector<EdgePoints::Point>& points, uint32_t vertex) {
    return std::find_if(points.begin(), points.end(),
                        [&](const EdgePoints::Point& p) { return p.vertex == vertex; });
}

}  // namespace

uint32_t EdgePoints::findOrAdd(uint32_t a, uint32_t b) {
    const uint64_t key = uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [it, isNew] = ofEnds_.try_emplace(key, static_cast<uint32_t>(edges_.size()));
    if (isNew) edges_.push_back({std::min(a, b), std::max(a, b), {}});
    return it->second;
}

void EdgePoints::add(uint32_t edge, double share, uint32_t vertex) {
    Edge& e = edges_[edge];
    if (vertex == e.low || vertex == e.high || placeIn(e.points, vertex) != e.points.end()) return;
    const auto at = std::upper_bound(e.points.begin(), e.points.end(), share,
                                     [](double s, const Point& p) { return s < p.share; });
    e.points.insert(at, {share, vertex});
}

/// Per edge the first one of its line.
std::vector<uint32_t> EdgePoints::findLines() const {
    std::map<uint32_t, std::vector<uint32_t>> edgesOf;  // by vertex
    for (uint32_t e = 0; e < edges_.size(); ++e) {
        edgesOf[edges_[e].low].push_back(e);
        edgesOf[edges_[e].high].push_back(e);
        for (const Point& p : edges_[e].points) edgesOf[p.vertex].push_back(e);
    }
    UnionFind lines(edges_.size());
    // Lines that grew may share two vertices with others.
    for (bool grown = true; grown;) {
        grown = false;
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> sharing;  // vertices of two lines
        for (const auto& [vertex, edges] : edgesOf) {
            std::vector<uint32_t> here;
            for (const uint32_t e : edges) here.push_back(lines.find(e));
            std::sort(here.begin(), here.end());
            here.erase(std::unique(here.begin(), here.end()), here.end());
            for (size_t i = 0; i < here.size(); ++i)
                for (size_t j = 0; j < i; ++j) ++sharing[{here[j], here[i]}];
        }
        for (const auto& [pair, vertices] : sharing) {
            if (vertices < 2) continue;
            lines.unite(pair.first, pair.second);
            grown = true;
        }
    }
    std::vector<uint32_t> lineOf(edges_.size());
    for (uint32_t e = 0; e < edges_.size(); ++e) lineOf[e] = lines.find(e);
    return lineOf;
}

void EdgePoints::join(const std::function<glm::dvec3(uint32_t)>& positionOf) {
    const std::vector<uint32_t> lineOf = findLines();
    std::vector<uint8_t> joined(edges_.size(), 0);  // lines of several edges
    for (uint32_t e = 0; e < edges_.size(); ++e)
        if (lineOf[e] != e) joined[lineOf[e]] = 1;
    lines_.resize(edges_.size());
    for (uint32_t e = 0; e < edges_.size(); ++e) {
        const Edge& edge = edges_[e];
        const Edge& first = edges_[lineOf[e]];
        const glm::dvec3 origin = positionOf(first.low);
        const glm::dvec3 along = positionOf(first.high) - origin;
        Line& line = lines_[lineOf[e]];
        const auto place = [&](double share, uint32_t vertex) {
            if (placeIn(line, vertex) != line.end()) return;
            if (joined[lineOf[e]] != 0) {
                const double length2 = glm::dot(along, along);
                share = length2 > 0 ? glm::dot(positionOf(vertex) - origin, along) / length2 : 0;
            }
            line.push_back({share, vertex});
        };
        place(0, edge.low);
        for (const Point& p : edge.points) place(p.share, p.vertex);
        place(1, edge.high);
    }
    for (uint32_t n = 0; n < lines_.size(); ++n) {
        std::stable_sort(lines_[n].begin(), lines_[n].end(),
                         [](const Point& a, const Point& b) { return a.share < b.share; });
        for (const Point& p : lines_[n]) linesOf_[p.vertex].push_back(n);
    }
}

const EdgePoints::Line* EdgePoints::commonLine(uint32_t a, uint32_t b) const {
    const auto ofA = linesOf_.find(a), ofB = linesOf_.find(b);
    if (a == b || ofA == linesOf_.end() || ofB == linesOf_.end()) return nullptr;
    for (const uint32_t n : ofA->second)
        if (std::find(ofB->second.begin(), ofB->second.end(), n) != ofB->second.end())
            return &lines_[n];
    return nullptr;
}

EdgePoints::Part EdgePoints::between(uint32_t from, uint32_t to) const {
    Part part;
    const Line* line = commonLine(from, to);
    if (line == nullptr) return part;
    const auto first = placeIn(*line, from), last = placeIn(*line, to);
    part.from = first->share;
    part.to = last->share;
    if (first < last)
        part.points.assign(first + 1, last);
    else
        part.points.assign(std::reverse_iterator(first), std::reverse_iterator(last + 1));
    return part;
}

}  // namespace sherd
