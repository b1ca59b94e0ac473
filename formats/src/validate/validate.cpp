// SPDX-License-Identifier: MIT
// Finding codes, stable for programs:
//   failures: not_closed, volume_not_positive, volume_wrong, children_ranges, inner_faces_unpaired,
//             volume_sum, mass_wrong, mass_sum, density_wrong, center_of_mass_wrong, inertia_wrong,
//             hidden_outside, hull_flat, hull_outside, bond_area, bond_centroid, bond_normal,
//             no_bonds, normal_not_unit, stale
//   warnings: no_collider, hull_small, hull_shared, hull_overlap, bond_missing
//   notes: object_open, self_intersecting, crossings_uncounted, overlaps_uncounted
#include "sherd/formats/validate.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "../extension_name.h"
#include "../gltf_resources.h"
#include "../source_hash.h"
#include "check_context.h"
#include "sherd/formats/glb_read.h"

namespace sherd {

namespace {

double diagonalOf(const FractureSet& set) {
    const std::vector<glm::vec3>& positions = set.geometry.positions;
    if (positions.empty()) return 0;
    glm::vec3 low = positions[0];
    glm::vec3 high = low;
    bool first = true;
    forEachTriangle(set, 0, [&](size_t, uint32_t a, uint32_t b, uint32_t c) {
        for (const uint32_t v : {a, b, c}) {
            low = first ? positions[v] : glm::min(low, positions[v]);
            high = first ? positions[v] : glm::max(high, positions[v]);
            first = false;
        }
    });
    return glm::length(glm::dvec3(high) - glm::dvec3(low));
}

void checkFresh(const nlohmann::json& document, std::span<const uint8_t> bin,
                const FractureSet& set, CheckContext& context) {
    const std::vector<size_t> meshes = meshesOf(document, set);
    if (sourceHash(document, bin, meshes) != set.sourceHash)
        context.find(Severity::failure, "stale", -1,
                     "the intact mesh has changed since the bake; bake again", "/sourceHash");
    const auto& nodes = document["nodes"];
    const auto checkShows = [&](int32_t node, bool itsMesh, const char* below) {
        const auto& entry = nodes[static_cast<size_t>(node)];
        if (entry.contains("mesh") && (!itsMesh || entry["mesh"] == set.mesh)) return;
        context.find(Severity::failure, "stale", -1,
                     "node " + std::to_string(node) + " shows " +
                         (itsMesh ? "another mesh" : "no mesh, but is part of the object") +
                         "; bake again",
                     below);
    };
    checkShows(set.node, true, "/mesh");
    for (const int32_t node : set.sameNodes) checkShows(node, true, "/mesh");
    for (const int32_t node : set.joinedNodes) checkShows(node, false, "/joined");
}

nlohmann::ordered_json levelJson(const LevelReport& level) {
    nlohmann::ordered_json out = {{"fragments", level.fragments},
                                  {"closed", level.closed},
                                  {"volumeShare", level.volumeShare},
                                  {"hiddenShare", level.hiddenShare}};
    if (level.coverageNone >= 0)
        out["coverage"] = {{"none", level.coverageNone}, {"double", level.coverageDouble}};
    if (level.selfIntersections >= 0) out["selfIntersections"] = level.selfIntersections;
    if (level.thinnest >= 0) out["thinnest"] = level.thinnest;
    return out;
}

}  // namespace

std::string shortNumber(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

std::string CheckContext::pointer(const char* below) const {
    std::string text("/extensions/");
    return text.append(kExtensionName)
        .append("/fractures/")
        .append(std::to_string(object))
        .append(below);
}

void CheckContext::find(Severity severity, const char* code, int32_t fragment, std::string message,
                        const char* below) const {
    report.findings.push_back(
        {severity, code, std::move(message), object, fragment, pointer(below)});
}

const char* nameOf(Severity severity) {
    switch (severity) {
        case Severity::note:
            return "note";
        case Severity::warning:
            return "warning";
        case Severity::failure:
            return "failure";
    }
    return "failure";
}

bool CheckReport::passed() const {
    return std::none_of(findings.begin(), findings.end(),
                        [](const Finding& f) { return f.severity == Severity::failure; });
}

void checkFractureSet(const FractureSet& set, const CheckOptions& options, int32_t object,
                      CheckReport& report) {
    ObjectReport out;
    out.name = set.name;
    out.diagonal = diagonalOf(set);
    MeshMeasurer measurer(set);
    CheckContext context{set, options, object, report, out, measurer.welded()};
    for (uint32_t f = 0; f < set.fragments.size(); ++f)
        context.measures.push_back(measurer.measure(f));
    forEachTriangle(set, 0, [&](size_t, uint32_t, uint32_t, uint32_t) { ++out.triangles; });
    checkClosed(context);
    checkLevelsAddUp(context);
    checkMass(context);
    checkCentersAndInertia(context);
    checkHulls(context);
    checkBonds(context);
    checkNormals(context);
    checkHiddenInside(context);
    measureHiddenArea(context);
    if (options.coverage) measureCoverage(context);
    if (options.shapes) measureShapes(context);
    report.objects.push_back(std::move(out));
}

Result<CheckReport> checkFractureSets(std::span<const uint8_t> glb, const CheckOptions& options) {
    try {
        const auto sets = readFractureSets(glb);
        if (!sets) return tl::unexpected<Error>(sets.error());
        CheckReport report;
        if (sets->empty()) return report;
        const auto document = splitGlb(glb, "");
        const auto json = nlohmann::json::parse(document->json);
        for (size_t s = 0; s < sets->size(); ++s) {
            const auto object = static_cast<int32_t>(s);
            checkFractureSet((*sets)[s], options, object, report);
            CheckContext context{(*sets)[s], options, object, report, report.objects.back(), {}};
            checkFresh(json, document->bin, (*sets)[s], context);
        }
        return report;
    } catch (const std::exception& e) {
        return fail(ErrorCode::limitExceeded, std::string("the file cannot be held: ") + e.what());
    }
}

std::string toJson(const CheckReport& report) {
    using Json = nlohmann::ordered_json;
    Json out = {
        {"passed", report.passed()}, {"objects", Json::array()}, {"findings", Json::array()}};
    for (const ObjectReport& object : report.objects) {
        Json entry = {{"name", object.name},
                      {"triangles", object.triangles},
                      {"boundaryEdges", object.boundaryEdges},
                      {"hiddenVertices", object.hiddenVertices},
                      {"verticesOutside", object.verticesOutside},
                      {"protrusion", object.protrusion},
                      {"diagonal", object.diagonal},
                      {"levels", Json::array()}};
        for (const LevelReport& level : object.levels) entry["levels"].push_back(levelJson(level));
        out["objects"].push_back(std::move(entry));
    }
    for (const Finding& finding : report.findings) {
        Json entry = {{"severity", nameOf(finding.severity)},
                      {"code", finding.code},
                      {"message", finding.message},
                      {"object", finding.object},
                      {"where", finding.where}};
        if (finding.fragment >= 0) entry["fragment"] = finding.fragment;
        out["findings"].push_back(std::move(entry));
    }
    return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sherd
