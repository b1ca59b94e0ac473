// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sherd {

/// A place that an artist should look at.
struct BakePlace {
    std::optional<glm::dvec3> position;  ///< object frame, metres
    std::optional<glm::dvec2> uv;        ///< as lines are drawn in
    std::string note;                    ///< what is there, e.g. the line; may be empty
};

/// Something that was degraded, ignored or merged, and the bake went on.
struct BakeFinding {
    std::string code;     ///< stable, for programs: "loose-end", "merged-piece", "open-mesh", ...
    std::string message;  ///< a sentence: what and what to do
    std::string where;    ///< UV, 3D position, element; may be empty
    uint32_t count = 1;   ///< how many of this kind; `where` names the first few
    std::vector<BakePlace> places = {};  ///< where they are, as far as they have a place; 1000 at
                                         ///< most
};

/// How the collider of a fragment fits; margins included.
struct BakedCollider {
    uint32_t hulls = 0;    ///< convex parts
    double coverage = 0;   ///< share of the fragment's volume in it
    double overlap = 0;    ///< how deep it is in those of fragments beside it, metres
    double outside = 0;    ///< how far it reaches out of the fragment, metres
    double uncovered = 0;  ///< how far the fragment's outer surface reaches out of it, metres
    bool convex = false;   ///< the fragment all but fills its own convex hull
};

/// The same of all fragments of a level.
struct BakedColliders {
    uint32_t hulls = 0;        ///< in all
    double coverage = 0;       ///< median
    double leastCoverage = 0;  ///< of one fragment
    double overlap = 0;        ///< the deepest, metres
    double outside = 0;        ///< the farthest, metres
    double uncovered = 0;      ///< likewise
};

struct BakedLevelReport {
    uint32_t fragments = 0;   ///< standing at this level, undivided shallower ones included
    uint32_t components = 0;  ///< surface components the lines of this level make, before merging
    uint32_t closed = 0;      ///< of fragments: proven closed
    double volumeShare = 0;   ///< sum of the fragments' volumes over the object's
    double hiddenShare = 0;   ///< of the fragments' surface: what shows only since they broke off
    // Not measured where they are empty.
    std::optional<double> coverageNone = {};         ///< share of the object that is in no fragment
    std::optional<double> coverageDouble = {};       ///< share of it that is in several
    std::optional<double> protrusion = {};           ///< the deepest, metres
    std::optional<uint64_t> selfIntersections = {};  ///< of all fragments
    std::optional<double> thinnest = {};             ///< of the thinnest fragment, metres
    std::optional<BakedColliders> colliders = {};
};

/// One piece; entry f is fragment f of the file, [0] the intact object.
struct BakedFragmentReport {
    std::string name;        ///< as drawn; may be empty
    uint32_t level = 0;      ///< at which it first appears
    bool closed = false;     ///< proven
    double volume = 0;       ///< cubic metres
    double hiddenShare = 0;  ///< of its surface
    // Not measured where they are empty.
    /// Share of it that lies in other fragments of its level, too.
    std::optional<double> overlap = {};
    /// How far its hidden faces reach out of the object, metres.
    std::optional<double> protrusion = {};
    /// Pairs of its triangles that cross or overlap.
    std::optional<uint64_t> selfIntersections = {};
    /// Straight inwards from the surface, metres: as much as a tenth of the surface has at most.
    std::optional<double> thinnest = {};
    std::optional<BakedCollider> collider = {};
};

/// A hole of the mesh that was closed (--cap-holes).
struct BakedCap {
    glm::dvec3 place{0};   ///< mean of the hole's corners, object frame, metres
    double length = 0;     ///< around the hole, metres
    double area = 0;       ///< of the cap, square metres
    uint32_t corners = 0;  ///< of the hole
    bool flat = false;     ///< filled in a plane; else by the triangles of least area
};

struct StageTime {
    std::string name;
    double seconds = 0;
};

/// What one object's bake did. `toJson` gives the same for machines.
struct BakedObjectReport {
    std::string name;
    uint32_t triangles = 0;
    uint32_t splitTriangles = 0;  ///< after cutting
    uint32_t parts = 0;           ///< connected parts of the surface
    double diagonal = 0;          ///< of the bounding box, metres
    double volume = 0;            ///< of the object, cubic metres; meaningless when open
    uint32_t boundaryEdges = 0;
    uint32_t bonds = 0;
    std::vector<BakedLevelReport> levels;        ///< [0]: the intact object
    std::vector<BakedFragmentReport> fragments;  ///< of all levels
    std::vector<BakedCap> caps;
    std::vector<BakeFinding> findings;
    std::vector<StageTime> stages;  ///< wall time; the medial surface runs beside the surface steps
};

struct BakeReport {
    std::string source;
    std::vector<BakedObjectReport> objects;
    double seconds = 0;
};

std::string toJson(const BakeReport& report);

}  // namespace sherd
