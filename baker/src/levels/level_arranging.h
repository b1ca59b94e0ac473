// SPDX-License-Identifier: MIT
// Levels in the order of the plan, whatever the order they were cut in.
//
// All lines are cut first, and their leaves closed by one interior: it depends on the mesh alone.
// Cuts through the volume divide these leaves, those of one piece together. So a level of lines
// below a cut is there before it: what it adds is to let leaves part that were together until then.
#pragma once

#include "appearance/hidden_mesh.h"
#include "levels/level_order.h"
#include "sherd/baker/report.h"
#include "surface/cut_surface.h"

namespace sherd {

struct ArrangedObject {
    const SurfaceMesh& mesh;
    CutSurface& cut;         ///< its surface gains what cuts add, its topology follows
    Components& components;  ///< of all levels of lines; then of the order's levels
    HiddenMesh& hidden;      ///< likewise
};

struct ArrangeOptions {
    double snapDistance = 0;  ///< of labels, metres
    unsigned threads = 1;     ///< results do not depend on it
    bool shells = false;      ///< pieces are meant to be hollow
};

/// Errors: separatesNothing, limitExceeded, notClosed, badArgument (a choice chooses nothing), and
/// why the first piece cannot be cut if none can.
Result<void> arrangeLevels(const LevelOrder& order, const FracturePlan& plan,
                           const ArrangeOptions& options, const ArrangedObject& object,
                           BakedObjectReport& report);

}  // namespace sherd
