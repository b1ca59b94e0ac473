// SPDX-License-Identifier: MIT
// A limestone statue of a robed woman on a plinth.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "figure_shape.h"
#include "noise.h"
#include "sample_object.h"
#include "surface_nets.h"
#include "unwrap.h"

namespace sherd::samples {
namespace {

/// Goes on to `end` in even steps of about `step`.
void appendPlanes(std::vector<double>& planes, double end, double step) {
    const double begin = planes.back();
    const auto count = static_cast<uint32_t>(std::lround((end - begin) / step));
    for (uint32_t i = 1; i <= count; ++i) planes.push_back(begin + (end - begin) * i / count);
}

/// The grid narrows upwards as the figure does, so that the head gets the finest triangles.
BentGrid figureGrid() {
    BentGrid grid{{{{-0.225}, {-0.02}, {-0.258}}}, {}};
    appendPlanes(grid.planes[0], 0.225, 0.0172);
    appendPlanes(grid.planes[1], 0.16, 0.016);
    appendPlanes(grid.planes[1], 0.84, 0.0148);
    appendPlanes(grid.planes[1], 1.04, 0.0072);
    appendPlanes(grid.planes[2], 0.258, 0.0172);
    grid.bend = [](const glm::dvec3& q) {
        const double y = q.y;
        const double narrow =
            1 - 0.22 * smoothStep(0.13, 0.30, y) - 0.40 * smoothStep(0.80, 0.92, y);
        return glm::dvec3(q.x * narrow, y, q.z * narrow);
    };
    return grid;
}

Mesh figureMesh() {
    Mesh mesh = meshShape(figureShape, figureGrid());
    unwrap(mesh, {});
    // The shape's own gradient would turn by more than a right angle within some triangles.
    computeNormals(mesh, 50);
    return mesh;
}

/// How much of the sky is open above the place: 1 on a ridge, less in a fold.
double openness(const glm::dvec3& p, const glm::dvec3& normal) {
    double closed = 0;
    for (const double reach : {0.006, 0.014, 0.030})
        closed += std::clamp(1 - figureShape(p + normal * reach) / reach, 0.0, 1.0) / 3;
    return 1 - closed;
}

glm::dvec3 paintFigure(const SurfacePoint& point) {
    const glm::dvec3& p = point.position;
    const double open = openness(p, point.normal);
    const double cloud = fractalNoise(p * 6.0, 4, 3);
    const double bedding = fractalNoise({p.x * 7, p.y * 60 + 2 * cloud, p.z * 7}, 3, 5);
    const double grain = fractalNoise(p * 170.0, 2, 4);
    const double pit = smoothStep(0.34, 0.46, fractalNoise(p * 75.0, 3, 12));
    glm::dvec3 stone = glm::mix(glm::dvec3(0.86, 0.80, 0.68), glm::dvec3(0.78, 0.69, 0.54),
                                smoothStep(-0.4, 0.5, cloud));
    stone *= 1 + 0.05 * bedding + 0.06 * grain - 0.16 * pit;
    if (p.y < kFigurePlinth - 0.004) stone *= glm::dvec3(0.80, 0.79, 0.78);
    // Traces of old paint in the hair and in the depths of the robe.
    const double worn =
        smoothStep(-0.25, 0.35, fractalNoise(p * 26.0, 3, 40) + 0.55 * (0.8 - open));
    if (p.y > kFigureNeck)
        stone = glm::mix(stone, glm::dvec3(0.46, 0.27, 0.17), 0.6 * worn * figureHair(p));
    // Soot keeps where rain does not reach; lichen likes the plinth.
    const double soot = smoothStep(0.05, 0.55, (1 - open) + 0.25 * cloud - 0.06);
    stone = glm::mix(stone, glm::dvec3(0.30, 0.27, 0.235), 0.62 * soot);
    const double lichen = smoothStep(0.16, 0.34, fractalNoise(p * 19.0, 4, 61) - 0.5 * p.y + 0.12);
    return glm::mix(stone, glm::dvec3(0.55, 0.56, 0.38) * (1 + 0.3 * grain), 0.45 * lichen);
}

CrackPattern figureCracks(const Mesh& mesh) {
    CrackPattern pattern;
    pattern.options = {{1, 0.85, 1}, 0.035, 0.12, 5, 4, 8};
    pattern.level1 = {{{0.00, 0.945, 0.00}, 0},  {{-0.10, 0.735, 0.0}, 0},
                      {{0.06, 0.760, 0.03}, 0},  {{-0.03, 0.540, 0.02}, 0},
                      {{0.06, 0.400, -0.02}, 0}, {{-0.02, 0.250, 0.02}, 0},
                      {{-0.08, 0.060, 0.02}, 0}, {{0.09, 0.070, -0.01}, 0}};
    pattern.level2 =
        scatterSites(mesh, pattern, {{3, 3, 4, 4, 4, 4, 3, 3}, {0.0, 0.62, 0.1}, 0.03, 1});
    return pattern;
}

}  // namespace

SampleObject makeFigure() {
    SampleObject figure;
    figure.name = "figure";
    figure.mesh = figureMesh();
    figure.texture = paintTexture(figure.mesh, kSampleTexture, paintFigure);
    figure.roughness = 0.85;
    figure.stuff = {{0.60, 0.52, 0.39}, 2200};
    figure.cracks = figureCracks(figure.mesh);
    return figure;
}

}  // namespace sherd::samples
