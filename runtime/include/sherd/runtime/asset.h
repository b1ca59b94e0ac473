// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/result.h"
#include "sherd/runtime/bond_graph.h"
#include "sherd/runtime/mass_moments.h"

namespace sherd {

/// One draw call's worth of a fragment: a run of `Asset::geometry().indices`.
struct DrawRange {
    uint32_t material = 0;     ///< index into FractureSet::materials
    uint32_t exposedFrom = 0;  ///< 0: outer surface; k >= 1: hidden until broken to level k
    Range indices;             ///< triangles; never empty
};

/// A baked object ready for use in a game: immutable, shared by any number of worlds and threads.
/// Masses differ from the file's where those did not add up: the parts of every fragment compose to
/// it, and the leaves to the mass of the object.
class Asset {
  public:
    /// Checks every index, count and number of the set, whoever made it, and takes it over.
    static Result<std::shared_ptr<const Asset>> fromFractureSet(FractureSet set);

    /// The same object `factor` times as large and of the same substance: lengths, areas, masses
    /// and inertias by their powers of it, masses also times `density`. Drawn as the original,
    /// scaled: it has no vertices of its own. The original itself for 1 and 1.
    static Result<std::shared_ptr<const Asset>> scaled(const std::shared_ptr<const Asset>& asset,
                                                       float factor, float density = 1);
    /// Metres per metre of `original`.
    [[nodiscard]] float scale() const { return scale_; }
    /// kg/m^3 per kg/m^3 of `original`.
    [[nodiscard]] float density() const { return density_; }
    /// What this is a scaled copy of: this when it is none.
    [[nodiscard]] const Asset& original() const { return original_ ? *original_ : *this; }

    [[nodiscard]] const FractureSet& set() const { return set_; }
    [[nodiscard]] const std::string& name() const { return set_.name; }

    /// Vertices and indices of all fragments of all levels: upload once, draw by `drawRanges`. The
    /// original's, in its size.
    [[nodiscard]] const FractureGeometry& geometry() const { return original().set_.geometry; }

    [[nodiscard]] uint32_t fragmentCount() const { return uint32_t(set_.fragments.size()); }
    /// Name, physical material, mass, ... of one fragment.
    [[nodiscard]] const Fragment& fragment(uint32_t f) const { return set_.fragments[f]; }

    /// What fragment f shows as a body of its own (fragment 0: the intact object).
    [[nodiscard]] std::span<const DrawRange> drawRanges(uint32_t f) const;

    /// The leaves and the bonds that hold them together.
    [[nodiscard]] const BondGraph& graph() const { return graph_; }

    /// About the centre of mass of the whole object, along the object's axes.
    [[nodiscard]] const MassMoments& massMoments(uint32_t f) const { return massMoments_[f]; }

    /// Around a fragment's colliders, object frame.
    struct Box {
        glm::vec3 low, high;
    };
    /// Metres; 0 inside.
    static float distance(const Box& box, const glm::vec3& point);
    [[nodiscard]] const Box& box(uint32_t f) const { return boxes_[f]; }
    /// The same where `pose` puts the object, along the axes of its world.
    [[nodiscard]] Box boxAt(uint32_t f, const RigidPose& pose) const;
    /// Around the boxes of some fragments; one at least.
    [[nodiscard]] Box boxAround(std::span<const uint32_t> fragments) const;

    /// Energy that breaking every bond among the children of f would consume at dissipation 1: the
    /// sum of toughness x area, J. 0 when they share none.
    [[nodiscard]] float breakEnergy(uint32_t f) const { return breakEnergy_[f]; }

    /// Tells bakes apart: of the source's hash, the tree and the bonds, with their size
    /// (FNV-1a, 64 bit).
    [[nodiscard]] uint64_t bakeHash() const { return bakeHash_; }

    /// Diagonal of the object's bounding box, metres.
    [[nodiscard]] float diagonal() const { return diagonal_; }

  private:
    explicit Asset(FractureSet set);
    static Result<std::shared_ptr<const Asset>> checked(std::shared_ptr<const Asset> asset);

    FractureSet set_;
    std::vector<DrawRange> drawRanges_;
    std::vector<Range> drawRangesOf_;  ///< per fragment, into drawRanges_
    BondGraph graph_;
    std::vector<Box> boxes_;
    std::vector<MassMoments> massMoments_;  ///< per fragment
    std::vector<float> breakEnergy_;
    float diagonal_ = 0;
    uint64_t bakeHash_ = 0;
    std::shared_ptr<const Asset> original_;  ///< null: this is one
    float scale_ = 1;
    float density_ = 1;
};

/// The assets of a baked GLB, one per fractured object, in file order. A file that holds none is an
/// error (`invalidData`): it was never baked, or a tool dropped the extension afterwards.
Result<std::vector<std::shared_ptr<const Asset>>> loadAssets(std::span<const uint8_t> glb);
Result<std::vector<std::shared_ptr<const Asset>>> loadAssets(const std::filesystem::path& path);

/// The game's own way to its files: an archive, a patch, a network.
struct FileReader {
    void* user = nullptr;  ///< handed back
    /// Fills `bytes` with the file. False: there is none, or it cannot be read. Must not throw.
    bool (*read)(void* user, const char* path, std::vector<uint8_t>& bytes) = nullptr;
};
Result<std::vector<std::shared_ptr<const Asset>>> loadAssets(const FileReader& reader,
                                                             const char* path);

}  // namespace sherd
