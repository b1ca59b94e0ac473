// SPDX-License-Identifier: MIT
// Where lines of width w meet, the centre line of their union is not the union of their centre
// lines: a crossing at angle a is torn into two junctions up to w / sin(a / 2) apart, and a line
// that leaves at a sharp angle does so w / (2 sin(a / 2)) too late. The discs of ink around torn
// junctions overlap whatever the angle (each touches the two nearer corners of ink between the
// lines and one of the further), and the lines are undisturbed from where the ink is as narrow as
// they are.
#include "map/bitmap_junctions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "map/line_fit.h"

namespace sherd {

namespace {

constexpr double kThinnedSlack = 1.5;  ///< texels by which thinning misplaces a junction
constexpr double kUnclearSlack = 5;  ///< texels: thin lines at a sharp angle, merged if they agree
constexpr double kOnePlace = 0.6;    ///< texels by which lines may miss a place they point to
constexpr double kMiterLimit = 4;    ///< SVG's: how far a pointed corner reaches, in radii

/// Part of a line as an undisturbed arm of a node: points[begin] is its first point.
struct Arm {
    uint32_t line = 0;
    bool atTo = false;  ///< at the line's far end
    size_t begin = 0;   ///< points counted from the node
    std::optional<StraightFit> fit;
};

/// The points of a line counted from one of its ends.
class FromEnd {
  public:
    FromEnd(const CentreLine& line, bool atTo) : points_(line.points), atTo_(atTo) {}
    const CentrePoint& operator[](size_t i) const {
        return atTo_ ? points_[points_.size() - 1 - i] : points_[i];
    }
    size_t size() const { return points_.size(); }

  private:
    const std::vector<CentrePoint>& points_;
    bool atTo_;
};

/// The first point that is out of the junction's ink.
size_t undisturbedFrom(const FromEnd& points, double junctionRadius, double lineRadius,
                       double lineLength) {
    const double least = std::min(std::max(junctionRadius, 1.0) + 1, 0.3 * lineLength);
    const double most = std::min(4 * junctionRadius + 4, 0.4 * lineLength);
    double walked = 0;
    for (size_t i = 1; i + 1 < points.size(); ++i) {
        walked += glm::distance(points[i - 1].at, points[i].at);
        if (walked >= most) return i;
        if (walked >= least && points[i].radius <= 1.08 * lineRadius + 0.25) return i;
    }
    return points.size() - 1;
}

/// The points of an arm from `begin` on: not beyond half of its line, nor more than `most`.
std::vector<CentrePoint> armPoints(const FromEnd& points, size_t begin, double length,
                                   size_t most) {
    std::vector<CentrePoint> result;
    double walked = 0;
    for (size_t i = begin; i + 1 < points.size() && result.size() < most; ++i) {
        if (!result.empty()) walked += glm::distance(result.back().at, points[i].at);
        if (walked > 0.5 * length) break;
        result.push_back(points[i]);
    }
    return result;
}

Arm makeArm(const CentreGraph& graph, uint32_t id, bool atTo) {
    const CentreLine& line = graph.lines[id];
    const FromEnd points(line, atTo);
    Arm arm{id, atTo, 0, std::nullopt};
    const double radius = medianRadius(line.points);
    const double length = lengthOf(line);
    arm.begin = undisturbedFrom(points, points[0].radius, radius, length);
    const auto least = static_cast<size_t>(std::max(8.0, 4 * radius));
    const std::vector<CentrePoint> window = armPoints(points, arm.begin, length, 8 * least);
    if (window.size() < 3) return arm;
    if (const std::optional<ArmFit> found =
            fitArm(window, least, glm::distance(points[0].at, window[0].at))) {
        arm.fit = found->fit;
        arm.begin += found->leaning;
    }
    return arm;
}

/// An arm has no points behind its node, which may have moved along it.
void startBeyond(Arm& arm, const CentreLine& line, const CentreNode& node) {
    if (!arm.fit) return;
    const FromEnd points(line, arm.atTo);
    while (arm.begin + 1 < points.size() / 2 &&
           glm::dot(points[arm.begin].at - node.at, arm.fit->direction) < 1 + node.radius / 2)
        ++arm.begin;
}

/// Replaces what is between the node and the arm's first point by the node.
void attach(CentreLine& line, const Arm& arm, const CentreNode& node) {
    std::vector<CentrePoint>& points = line.points;
    const CentrePoint end{node.at, node.radius};
    const size_t drop = std::min(arm.begin, points.size() - 1);
    if (arm.atTo) {
        points.resize(points.size() - drop);
        points.push_back(end);
    } else {
        points.erase(points.begin(), points.begin() + static_cast<ptrdiff_t>(drop));
        points.insert(points.begin(), end);
    }
}

/// All line ends at a node but those of `without`.
std::vector<Arm> armsOf(const CentreGraph& graph, uint32_t node, uint32_t without = UINT32_MAX) {
    std::vector<uint32_t> lines = graph.nodes[node].lines;
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    std::vector<Arm> arms;
    for (const uint32_t line : lines) {
        if (line == without) continue;
        if (graph.lines[line].from == node) arms.push_back(makeArm(graph, line, false));
        if (graph.lines[line].to == node) arms.push_back(makeArm(graph, line, true));
    }
    return arms;
}

std::vector<StraightFit> fitsOf(const std::vector<Arm>& arms) {
    std::vector<StraightFit> fits;
    for (const Arm& arm : arms)
        if (arm.fit) fits.push_back(*arm.fit);
    return fits;
}

void placeJunction(CentreGraph& graph, uint32_t id) {
    CentreNode& node = graph.nodes[id];
    std::vector<Arm> arms = armsOf(graph, id);
    const std::vector<StraightFit> fits = fitsOf(arms);
    if (fits.size() >= 2) {
        const glm::dvec2 meeting = meetingPoint(fits, node.at);
        // A line that bends within the ink may point anywhere.
        if (glm::distance(meeting, node.at) <= 3 * node.radius + 2) node.at = meeting;
    }
    for (Arm& arm : arms) {
        startBeyond(arm, graph.lines[arm.line], node);
        attach(graph.lines[arm.line], arm, node);
    }
}

/// Joins node `from` to node `into`.
void absorb(CentreGraph& graph, uint32_t into, uint32_t from) {
    for (const uint32_t id : graph.nodes[from].lines) {
        CentreLine& line = graph.lines[id];
        if (line.from == from) line.from = into;
        if (line.to == from) line.to = into;
        graph.nodes[into].lines.push_back(id);
    }
    graph.nodes[from].lines.clear();
    graph.nodes[into].radius = std::max(graph.nodes[into].radius, graph.nodes[from].radius);
}

/// Do all lines that go on from either end of the line point to one place on it?
bool pointToOnePlace(const CentreGraph& graph, uint32_t id) {
    const CentreLine& line = graph.lines[id];
    std::vector<Arm> arms = armsOf(graph, line.from, id);
    for (Arm& arm : armsOf(graph, line.to, id)) arms.push_back(arm);
    const std::vector<StraightFit> fits = fitsOf(arms);
    if (fits.size() < arms.size()) return false;
    const glm::dvec2 middle = (graph.nodes[line.from].at + graph.nodes[line.to].at) / 2.0;
    const glm::dvec2 place = meetingPoint(fits, middle);
    const double radius = std::max(line.points.front().radius, line.points.back().radius);
    if (glm::distance(place, middle) > lengthOf(line) / 2 + radius + 1) return false;
    return std::all_of(fits.begin(), fits.end(), [&](const StraightFit& fit) {
        return distanceTo(fit, place) <= kOnePlace + 0.1 * radius;
    });
}

bool isTorn(const CentreGraph& graph, uint32_t id) {
    const CentreLine& line = graph.lines[id];
    if (line.dead || line.closed()) return false;
    if (graph.degree(line.from) < 3 || graph.degree(line.to) < 3) return false;
    // The discs of the line's own ends: those of a merged node are not all around one place.
    const double apart = lengthOf(line) - line.points.front().radius - line.points.back().radius;
    if (apart <= kThinnedSlack) return true;
    return apart <= kUnclearSlack && line.from != line.to && pointToOnePlace(graph, id);
}

/// Is the line, loose at its end, no more than the tip of the corner that the node's other two
/// lines make?
bool isCornerTip(const CentreGraph& graph, uint32_t node, uint32_t id, double spur) {
    const CentreLine& line = graph.lines[id];
    const FromEnd points(line, line.to == node);
    const CentrePoint& end = points[points.size() - 1];
    const std::vector<Arm> arms = armsOf(graph, node, id);
    const std::vector<StraightFit> fits = fitsOf(arms);
    if (arms.size() != 2 || fits.size() != 2) return false;
    const glm::dvec2 from = graph.nodes[node].at;
    const double length = glm::distance(end.at, from);
    if (length == 0) return true;
    const glm::dvec2 axis = (end.at - from) / length;
    const double corner = glm::dot(meetingPoint(fits, from) - from, axis);
    if (corner <= 0) return false;
    const double radius = std::max(medianRadius(graph.lines[arms[0].line].points),
                                   medianRadius(graph.lines[arms[1].line].points));
    // Half the angle between the two sides, which point away from the corner.
    const double between = glm::length(fits[0].direction - fits[1].direction) / 2;
    const bool pointed = end.radius < 0.5 * radius && between > 0;
    const double tip = pointed ? std::min(radius / between, kMiterLimit * radius) : radius;
    return length + end.radius < corner + tip + spur;
}

}  // namespace

void mergeJunctions(CentreGraph& graph) {
    std::vector<uint32_t> into(graph.nodes.size());
    std::iota(into.begin(), into.end(), 0U);
    std::vector<uint32_t> torn;
    for (uint32_t i = 0; i < graph.lines.size(); ++i)
        if (isTorn(graph, i)) torn.push_back(i);
    std::vector<glm::dvec2> sum(graph.nodes.size());
    std::vector<double> count(graph.nodes.size(), 1);
    for (size_t i = 0; i < sum.size(); ++i) sum[i] = graph.nodes[i].at;
    for (const uint32_t id : torn) {
        uint32_t a = graph.lines[id].from;
        uint32_t b = graph.lines[id].to;
        removeLine(graph, id);
        if (a == b) continue;
        if (graph.degree(a) < graph.degree(b)) std::swap(a, b);
        absorb(graph, a, b);
        sum[a] += sum[b];
        count[a] += count[b];
        graph.nodes[a].at = sum[a] / count[a];
    }
    for (uint32_t i = 0; i < graph.nodes.size(); ++i) dissolve(graph, i);
}

void removeCornerTips(CentreGraph& graph, double spur) {
    for (uint32_t node = 0; node < graph.nodes.size(); ++node) {
        if (graph.degree(node) != 3) continue;
        const std::vector<uint32_t> lines = graph.nodes[node].lines;
        for (const uint32_t id : lines) {
            const CentreLine& line = graph.lines[id];
            if (!graph.hasTwoEnds(line)) continue;
            if (graph.degree(line.from == node ? line.to : line.from) != 1) continue;
            if (!isCornerTip(graph, node, id, spur)) continue;
            removeLine(graph, id);
            dissolve(graph, node);
            break;
        }
    }
}

void placeJunctions(CentreGraph& graph) {
    for (uint32_t i = 0; i < graph.nodes.size(); ++i)
        if (graph.degree(i) >= 3) placeJunction(graph, i);
}

}  // namespace sherd
