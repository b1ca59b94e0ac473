// SPDX-License-Identifier: MIT
// The models of artists and scanners: several parts, touching, overlapping, coarse, far from 0.
#include <doctest/doctest.h>

#include <filesystem>

#include "cut_checks.h"
#include "geometry/closed_mesh.h"
#include "sherd/baker/import.h"
#include "support/models.h"
#include "volume/slab_cells.h"
#include "volume/volume_sites.h"
#include "volume/voronoi_cells.h"

using namespace sherd;
using namespace sherd::test;

TEST_CASE("real closed models are cut into closed pieces that fill them") {
    if (!haveSharedModels()) return;
    uint32_t cutModels = 0;
    for (const auto& entry : std::filesystem::directory_iterator(sharedDir() / "models/dev")) {
        if (entry.path().extension() != ".glb" && entry.path().extension() != ".obj") continue;
        CAPTURE(entry.path());
        const Result<Model> model = importModel(entry.path(), {});
        REQUIRE(model);
        for (const SurfaceMesh& mesh : model->meshes) {
            Solid solid;
            solid.positions = mesh.positions;
            solid.triangles = mesh.triangles;
            if (!edgesCancel(solid.triangles) ||
                !(signedVolume(solid.positions, solid.triangles, solid.positions[0]) > 0)) {
                continue;
            }
            ++cutModels;
            const CutGrid grid = CutGrid::around(solid.positions, solid.triangles).value();
            VolumeSites options;
            options.count = 20;
            const auto sites = volumeSites(solid.positions, solid.triangles, options).value();
            const double reach = grid.extent() / 2;
            const glm::dvec3 middle = grid.toWorld(glm::dvec3(0));
            for (const bool slices : {false, true}) {
                std::vector<CellFamily> cells{voronoiCells(sites, grid).value()};
                if (slices)
                    cells = sliceCells({{3, 3, 3}}, middle - reach, middle + reach, grid).value();
                CutSolid cut;
                std::string wrong;
                REQUIRE(cutSolid(solid, std::move(cells), cut, wrong));
                Random random(1);
                CHECK(whatBreaks(cut, random, 300) == "");
                CHECK(cut.cut.report.fans == 0);
            }
        }
    }
    MESSAGE(cutModels << " models cut");
    CHECK(cutModels >= 10);
}
