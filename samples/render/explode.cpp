// SPDX-License-Identifier: MIT
#include "explode.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <limits>

namespace sherd::samples {
namespace {

constexpr float kWithinPiece = 0.7F;  ///< of the factor, for what broke off a piece

struct Bounds {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};

    void add(const glm::vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

/// Pieces of a slender object have little way to go across it: the shorter its extent along an
/// axis, the more that way counts.
glm::vec3 stretch(const Asset& asset) {
    Bounds bounds;
    for (const glm::vec3& p : asset.geometry().positions) bounds.add(p);
    const glm::vec3 share = (bounds.high - bounds.low) / asset.diagonal();
    return 1.0F / glm::sqrt(glm::max(share, 0.05F));
}

glm::vec3 offset(const Asset& asset, uint32_t fragment, const glm::vec3& factor) {
    glm::vec3 way(0);
    for (int32_t at = static_cast<int32_t>(fragment); at > 0;) {
        const Fragment& piece = asset.fragment(static_cast<uint32_t>(at));
        const glm::vec3 step =
            piece.centerOfMass - asset.fragment(static_cast<uint32_t>(piece.parent)).centerOfMass;
        way += step * factor * (piece.parent == 0 ? 1.0F : kWithinPiece);
        at = piece.parent;
    }
    return way;
}

}  // namespace

std::vector<FragmentPose> pullApart(const Asset& asset, uint32_t level, float factor) {
    const RigidPose& rest = asset.set().restPose;
    const glm::vec3 factors = factor * stretch(asset);
    std::vector<FragmentPose> pieces;
    for (const uint32_t fragment : fragmentsAtLevel(asset.set(), level)) {
        FragmentPose piece;
        piece.asset = &asset;
        piece.fragment = fragment;
        piece.pose = rest;
        piece.pose.translation += rest.rotation * offset(asset, fragment, factors);
        piece.previous = piece.pose;
        pieces.push_back(piece);
    }
    return pieces;
}

std::vector<glm::vec3> shownPlaces(const Asset& asset, const std::vector<FragmentPose>& pieces) {
    const FractureGeometry& geometry = asset.geometry();
    std::vector<glm::vec3> places;
    for (const FragmentPose& piece : pieces) {
        for (const DrawRange& range : asset.drawRanges(piece.fragment)) {
            for (uint32_t i = 0; i < range.indices.count; ++i) {
                const glm::vec3& p = geometry.positions[geometry.indices[range.indices.first + i]];
                places.push_back(piece.pose.translation + piece.pose.rotation * p);
            }
        }
    }
    return places;
}

void setDown(const Asset& asset, std::vector<FragmentPose>& pieces) {
    Bounds bounds;
    for (const glm::vec3& p : shownPlaces(asset, pieces)) bounds.add(p);
    const glm::vec3 middle = (bounds.low + bounds.high) * 0.5F;
    const glm::vec3 down(-middle.x, -bounds.low.y, -middle.z);
    for (FragmentPose& piece : pieces) {
        piece.pose.translation += down;
        piece.previous = piece.pose;
    }
}

}  // namespace sherd::samples
