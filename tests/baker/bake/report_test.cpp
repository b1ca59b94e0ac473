// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "sherd/baker/report.h"

using namespace sherd;

TEST_CASE("a report is JSON even when names are not UTF-8") {
    BakeReport report;
    report.source = "caf\xe9.glb";
    report.objects.emplace_back();
    report.objects[0].levels = {{1, 1, 1, 1.0}};
    report.objects[0].findings = {{"loose-ends", "lines end", "UV (0.1, 0.2)", 3}};
    const std::string json = toJson(report);
    CHECK(json.find("\"loose-ends\"") != std::string::npos);
    CHECK(json.find("\"count\": 3") != std::string::npos);
    CHECK(json.find('\xe9') == std::string::npos);
}
