// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/result.h"

namespace sherd {

enum class Severity {
    note,     ///< worth knowing; not the baker's doing
    warning,  ///< works, but not as well as it could
    failure,  ///< the file must not ship
};

/// "note", "warning" or "failure".
const char* nameOf(Severity severity);

/// One thing that `check` found. `code` is stable; programs may switch on it.
struct Finding {
    Severity severity = Severity::failure;
    std::string code;  ///< e.g. "not_closed"; all are listed in validate.cpp
    std::string message;
    int32_t object = 0;     ///< which fracture set of the file
    int32_t fragment = -1;  ///< -1: the object as a whole
    std::string where;      ///< JSON pointer
};

struct LevelReport {
    uint32_t fragments = 0;      ///< that make up the object at this level
    uint32_t closed = 0;         ///< of them
    double volumeShare = 0;      ///< their volume over the object's
    double hiddenShare = 0;      ///< of the fragments' area: what shows only since they broke off
    double coverageNone = -1;    ///< share of points in no fragment; -1: not measured
    double coverageDouble = -1;  ///< share of points in more than one
    int64_t selfIntersections = -1;  ///< pairs of triangles of one fragment whose insides share a
                                     ///< point; -1: not measured
    /// Metres; a tenth of the thinnest fragment's surface is no thicker, straight inwards. -1: not
    /// measured, or there is none.
    double thinnest = -1;
};

struct ObjectReport {
    std::string name;
    std::vector<LevelReport> levels;
    uint32_t triangles = 0;      ///< of the intact object
    uint32_t boundaryEdges = 0;  ///< of the intact object: above 0, it is open
    uint32_t hiddenVertices = 0;
    uint32_t verticesOutside = 0;  ///< hidden ones outside the object by more than the tolerance
    double protrusion = 0;  ///< metres: how far vertices, edge midpoints and centroids of hidden
                            ///< triangles reach outside at most
    double diagonal = 0;    ///< metres, of the intact object's bounding box
};

struct CheckReport {
    std::vector<ObjectReport> objects;
    std::vector<Finding> findings;

    bool passed() const;
};

struct CheckOptions {
    double tolerance = 1e-5;  ///< how far hidden vertices may lie outside, share of the diagonal
    bool coverage = false;    ///< also measure coverage
    bool shapes = false;      ///< also count self-intersections and find the thinnest part
    uint32_t coveragePoints = 20000;
    uint32_t seed = 1;
};

/// Proves from the bytes alone what the specification promises. Fails only if the file cannot be
/// read; everything else is a finding. A file without fracture sets gives a report without objects.
Result<CheckReport> checkFractureSets(std::span<const uint8_t> glb,
                                      const CheckOptions& options = {});

/// The same for one set that passed the reader's rules; the source hash is not compared.
void checkFractureSet(const FractureSet& set, const CheckOptions& options, int32_t object,
                      CheckReport& report);

/// The report as JSON text.
std::string toJson(const CheckReport& report);

// Invariants of one set, for tests and validating builds.

/// Over equal positions, without triangles of two equal corners, every directed edge is used as
/// often as its reverse.
bool isClosed(const FractureSet& set, uint32_t fragment);

/// Signed volume of the fragment's own mesh, m^3.
double meshVolume(const FractureSet& set, uint32_t fragment);

/// Whether each parent's ranges are the concatenation of its children's, and the faces that
/// dividing it exposes cancel pairwise (the object itself excepted: it may have a core).
bool childrenAddUp(const FractureSet& set, uint32_t parent);

}  // namespace sherd
