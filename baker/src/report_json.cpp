// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "sherd/baker/report.h"

namespace sherd {

namespace {

using OrderedJson = nlohmann::ordered_json;

/// What was not measured is left out.
template <class Value>
void put(OrderedJson& json, const char* key, const std::optional<Value>& value) {
    if (value) json[key] = *value;
}

OrderedJson colliderJson(const BakedCollider& collider) {
    return {{"hulls", collider.hulls},         {"coverage", collider.coverage},
            {"overlap", collider.overlap},     {"outside", collider.outside},
            {"uncovered", collider.uncovered}, {"convex", collider.convex}};
}

OrderedJson collidersJson(const BakedColliders& colliders) {
    return {{"hulls", colliders.hulls},
            {"coverage", {{"median", colliders.coverage}, {"least", colliders.leastCoverage}}},
            {"overlap", colliders.overlap},
            {"outside", colliders.outside},
            {"uncovered", colliders.uncovered}};
}

OrderedJson levelJson(const BakedLevelReport& level) {
    OrderedJson json{{"fragments", level.fragments},
                     {"components", level.components},
                     {"closed", level.closed},
                     {"volumeShare", level.volumeShare},
                     {"hiddenShare", level.hiddenShare}};
    if (level.coverageNone)
        json["coverage"] = {{"none", *level.coverageNone},
                            {"double", level.coverageDouble.value_or(0)}};
    put(json, "protrusion", level.protrusion);
    put(json, "selfIntersections", level.selfIntersections);
    put(json, "thinnest", level.thinnest);
    if (level.colliders) json["colliders"] = collidersJson(*level.colliders);
    return json;
}

OrderedJson fragmentJson(const BakedFragmentReport& fragment) {
    OrderedJson json{{"level", fragment.level},
                     {"closed", fragment.closed},
                     {"volume", fragment.volume},
                     {"hiddenShare", fragment.hiddenShare}};
    if (!fragment.name.empty()) json["name"] = fragment.name;
    put(json, "overlap", fragment.overlap);
    put(json, "protrusion", fragment.protrusion);
    put(json, "selfIntersections", fragment.selfIntersections);
    put(json, "thinnest", fragment.thinnest);
    if (fragment.collider) json["collider"] = colliderJson(*fragment.collider);
    return json;
}

}  // namespace

std::string toJson(const BakeReport& report) {
    OrderedJson root{{"sherdReport", 1},
                     {"source", report.source},
                     {"seconds", report.seconds},
                     {"objects", OrderedJson::array()}};
    for (const BakedObjectReport& object : report.objects) {
        OrderedJson entry{{"name", object.name},
                          {"triangles", object.triangles},
                          {"splitTriangles", object.splitTriangles},
                          {"parts", object.parts},
                          {"diagonal", object.diagonal},
                          {"volume", object.volume},
                          {"boundaryEdges", object.boundaryEdges},
                          {"bonds", object.bonds},
                          {"levels", OrderedJson::array()},
                          {"fragments", OrderedJson::array()},
                          {"findings", OrderedJson::array()},
                          {"stages", OrderedJson::array()}};
        for (const BakedLevelReport& level : object.levels) {
            entry["levels"].push_back(levelJson(level));
        }
        for (const BakedFragmentReport& fragment : object.fragments)
            entry["fragments"].push_back(fragmentJson(fragment));
        for (const BakedCap& cap : object.caps)
            entry["caps"].push_back({{"place", {cap.place.x, cap.place.y, cap.place.z}},
                                     {"length", cap.length},
                                     {"area", cap.area},
                                     {"corners", cap.corners},
                                     {"flat", cap.flat}});
        for (const BakeFinding& finding : object.findings) {
            OrderedJson found{{"code", finding.code},
                              {"message", finding.message},
                              {"where", finding.where},
                              {"count", finding.count}};
            for (const BakePlace& place : finding.places) {
                OrderedJson here = OrderedJson::object();
                if (place.position)
                    here["position"] = {place.position->x, place.position->y, place.position->z};
                if (place.uv) here["uv"] = {place.uv->x, place.uv->y};
                if (!place.note.empty()) here["note"] = place.note;
                found["places"].push_back(std::move(here));
            }
            entry["findings"].push_back(std::move(found));
        }
        for (const StageTime& stage : object.stages) {
            entry["stages"].push_back({{"name", stage.name}, {"seconds", stage.seconds}});
        }
        root["objects"].push_back(std::move(entry));
    }
    // Names come from files: replace what is not UTF-8 rather than throw.
    return root.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace sherd
