// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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
    uint32_t hullVertices = 16;  ///< 4..255 per collider
    double hullMargin = 0.01;    ///< metres at most; never above a tenth of the thinnest extent
};

/// Which lines a point outside the drawing's page meets.
enum class PageWrap : uint8_t {
    texture,  ///< those that the picture of its material shows there; without a picture, repeat
    none,     ///< the page is a part of an endless sheet
    repeat,
    mirror,
    clamp
};

/// Where one level comes from: lines (a drawing or a pattern), or a cut through the volume.
struct RecipeLevel {
    std::filesystem::path map;  ///< SVG, JSON, PNG or JPEG, relative to the recipe
    std::string name;           ///< may be empty
    Projection projection;      ///< how the drawing lies on the object
    std::optional<Pattern> pattern;
    std::optional<VolumeCut> cut;
};

/// Everything a bake can be told. Defaults are the command line's.
struct Recipe {
    std::string file;                 ///< where it was read from, for messages; empty: nowhere
    std::vector<RecipeLevel> levels;  ///< coarse to fine; empty: the maps given on the command line
    InteriorSettings interior;
    PhysicsSettings physics;
    double curveTolerance = 1e-4;  ///< curve to flattened line, UV units
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
    /// Whether the report also gets the measures that take time: coverage, protrusion,
    /// self-intersections, thickness. Empty: `sherd-bake` takes them if a report is written.
    std::optional<bool> measure;
    unsigned threads = 2;  ///< at most; results do not depend on it
};

/// "medial". Error badArgument.
Result<InteriorType> parseInteriorType(std::string_view text);

/// "texture", "none", "repeat", "mirror" or "clamp". Error badArgument.
Result<PageWrap> parsePageWrap(std::string_view text);

/// Reads a recipe (JSON, comments allowed). Unknown keys and wrong types are errors with their JSON
/// pointer. Paths of maps are made relative to the recipe's folder.
Result<Recipe> readRecipe(const std::filesystem::path& path);
Result<Recipe> parseRecipe(std::string_view text, const std::string& name);

}  // namespace sherd
