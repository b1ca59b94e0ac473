// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sherd/baker/cluster.h"
#include "sherd/baker/fracture_map.h"
#include "sherd/baker/pattern.h"
#include "sherd/baker/projection.h"
#include "sherd/baker/volume_cut.h"
#include "sherd/formats/result.h"

namespace sherd {

/// What closes a piece below its patch of the surface.
enum class InteriorType : uint8_t {
    medial,  ///< a sheet on the medial surface (thesis 4.8)
    shell,   ///< a sheet at a thickness of its own, never past the medial surface
    solid    ///< cut through to the far side, no sheet (thesis 6.3.2); medial where that fails
};

enum class InteriorNormals : uint8_t {
    smooth,  ///< sheets are rounded up to the crease angle, walls are flat
    flat     ///< every face is
};

/// How thick a shell is. Never thicker than to the medial surface.
struct ShellSettings {
    double thickness = 0;   ///< metres; 0: 2 % of the diagonal
    std::string attribute;  ///< scales it from vertex to vertex, 0..1: "COLOR_0", "_THICK"...
    uint32_t channel = 0;   ///< of the attribute
    std::filesystem::path texture;  ///< or PNG or JPEG over the UV set of the lines: white as
                                    ///< thick as said, black nothing
    std::shared_ptr<const GreyImage> picture = {};  ///< what `texture` names; see readGreyImage
};

/// Bumps on broken faces, by a seeded random field of the place that all pieces share.
struct Roughness {
    double amplitude = 0;  ///< metres that a point moves at most; 0: smooth
    double size = 0;       ///< metres from one bump to the next; 0: a twentieth of the diagonal
    uint32_t seed = 1;
};

/// How pieces look inside.
struct InteriorSettings {
    InteriorType type = InteriorType::medial;  ///< open surfaces get a shell in any case
    ShellSettings shell;
    bool thesis = false;          ///< the thesis' own: 10 Laplacian steps before and after, and
                                  ///< line ends on both sides of a seam averaged in order
    int preSmoothing = 3;         ///< 0..1000 steps before the medial surface is sought
    int postSmoothing = 0;        ///< 0..1000 steps on the medial surface; each loses volume
    double separationAngle = 50;  ///< degrees, 0..180: walls a ball sees nearer together than this
                                  ///< make no branch of the medial surface (thesis 6.3.1)
    double scaleAxis = 1.2;       ///< 1..10: balls that others cover when scaled by this make none
    double smallestRadius = 0;    ///< 0..1 of the diagonal: smaller balls make none (thesis 6.3.1)
    std::string material;  ///< name of a material of the model; empty: a neutral one is added
    /// By name, for faces below a material of the outer surface; `material` below all others.
    std::map<std::string, std::string> materials;
    double uvMetresPerTile =
        0;  ///< size of one texture tile on hidden faces; 0: a quarter of the diagonal
    InteriorNormals normals = InteriorNormals::smooth;
    double creaseAngle = 60;  ///< degrees, 0..180: edges of sheets at a larger angle stay sharp
    /// The attribute that tells how far below the surface hidden faces are, as share of the
    /// object's deepest: "COLOR_n" (grey; white on the surface itself) or "_NAME" (a number; 0
    /// there). Empty: none.
    std::string depthColor;
    Roughness roughness;
};

struct PhysicsSettings {
    double density = 1000;       ///< kg/m^3
    double friction = 0.5;       ///< static and dynamic
    double restitution = 0.05;   ///< 0..1
    double strength = 1e6;       ///< Pa
    double toughness = 50;       ///< J/m^2
    uint32_t convexParts = 8;    ///< 1..8 per piece at most; only concave ones need several
    uint32_t hullVertices = 16;  ///< 4..255 per part; up to 64 if its shape needs them
    double hullMargin = 0.01;    ///< metres at most; never above a tenth of the thinnest extent
};

/// What holds for pieces whose outer surface is mostly of one material, or that a label says are of
/// it. What is not said is as in PhysicsSettings.
struct PhysicalMaterial {
    std::optional<double> density;      ///< kg/m^3
    std::optional<double> friction;     ///< static and dynamic
    std::optional<double> restitution;  ///< 0..1
    std::optional<double> strength;     ///< Pa
    std::optional<double> toughness;    ///< J/m^2
};

/// Where the world holds the object. Places are those of the scene, metres.
struct RecipeAnchor {
    enum class Kind : uint8_t {
        below,  ///< the outer surface below a plane
        box,    ///< the outer surface in a box along the scene's axes
        label   ///< a piece by its name
    };
    Kind kind = Kind::below;
    glm::dvec3 point{0.0};             ///< below: on the plane
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< below: upwards from it, of any length
    glm::dvec3 low{0.0}, high{0.0};    ///< box: its corners
    std::string label;                 ///< label: the name
    std::optional<double> strength;    ///< Pa; else the held piece's own
    std::optional<double> toughness;   ///< J/m^2; else the held piece's own
    std::string where;                 ///< its pointer in the recipe, for messages
};

/// Which lines a point outside the drawing's page meets.
enum class PageWrap : uint8_t {
    texture,  ///< those that the picture of its material shows there; without a picture, repeat
    none,     ///< the page is a part of an endless sheet
    repeat,
    mirror,
    clamp
};

/// Where one level comes from: lines (a drawing or a pattern), a cut through the volume, or groups
/// of the pieces of the next finer level.
struct RecipeLevel {
    std::filesystem::path map;  ///< SVG, JSON, PNG or JPEG, relative to the recipe
    std::string name;           ///< may be empty
    Projection projection;      ///< how the drawing lies on the object
    std::optional<Pattern> pattern;
    std::optional<VolumeCut> cut;
    std::optional<Cluster> cluster;
    // Of bonds between pieces that part at this level. Lines and labels of drawings win.
    std::optional<double> strength;   ///< Pa
    std::optional<double> toughness;  ///< J/m^2
    PieceChoice only;   ///< pieces of the level before that it divides; a cut has the same
    std::string where;  ///< its pointer in the recipe, for messages; may be empty
};

/// Everything a bake can be told. Defaults are the command line's.
struct Recipe {
    std::string file;                 ///< where it was read from, for messages; empty: nowhere
    std::string pointer;              ///< of the recipe in that file; empty: it is the whole file
    std::vector<RecipeLevel> levels;  ///< coarse to fine; empty: the maps given on the command line
    InteriorSettings interior;
    PhysicsSettings physics;
    /// By name, as the model's materials or drawings' labels have it.
    std::map<std::string, PhysicalMaterial> materials;
    std::vector<RecipeAnchor> anchors;  ///< a place that several hold belongs to the first
    double curveTolerance = 1e-4;       ///< curve to flattened line, UV units
    double seamJoinShare =
        0.005;  ///< ends nearer than this share of the diagonal are joined across a seam
    double minimumComponentShare = 1e-5;  ///< of the surface: smaller components join a neighbour
    double closeGaps = 0;     ///< dangling line ends reach so far for the nearest line: UV
                              ///< units in drawings, shares of the diagonal over the surface
    double snapShare = 0.05;  ///< lines in 3D farther than this share of the diagonal from the
                              ///< surface are left out
    PageWrap wrap = PageWrap::texture;  ///< lines outside [0, 1] of the UV set
    bool modelLines = true;             ///< lines modelled on the object cut too
    bool splitParts = false;            ///< every patch of a pattern's cell is a piece of its own
    BitmapOptions bitmap;
    std::vector<std::pair<std::string, uint32_t>> levelOfColor;  ///< see MapReadOptions
    bool capHoles = false;   ///< close the holes of open meshes by hidden faces
    bool allowOpen = false;  ///< bake meshes with open or non-manifold edges; borders get a rim
    /// Metres per unit of the scene; empty: 1, as glTF has it. Another one puts the whole scene
    /// below a node that scales it, before anything else: what a recipe or drawing says is in
    /// metres.
    std::optional<double> unitScale;
    /// Whether the report also gets the measures that take time: coverage, protrusion,
    /// self-intersections, thickness. Empty: `sherd-bake` takes them if a report is written.
    std::optional<bool> measure;
    unsigned threads = 2;  ///< at most; results do not depend on it

    /// Where a part of it stands, for messages: "wall.json#/levels/0".
    std::string place(const std::string& inner) const { return file + "#" + pointer + inner; }
};

/// Whether the finest of several levels is a cluster, which then has nothing to group.
bool endsInCluster(const std::vector<RecipeLevel>& levels);

/// "medial". Error badArgument.
Result<InteriorType> parseInteriorType(std::string_view text);

/// "texture", "none", "repeat", "mirror" or "clamp". Error badArgument.
Result<PageWrap> parsePageWrap(std::string_view text);

/// Reads a recipe (JSON, comments allowed). Unknown keys and wrong types are errors with their JSON
/// pointer. Paths of maps are made relative to the recipe's folder.
Result<Recipe> readRecipe(const std::filesystem::path& path);
Result<Recipe> parseRecipe(std::string_view text, const std::string& name);

}  // namespace sherd
