// SPDX-License-Identifier: MIT
// A body can be moved and turned but not scaled, so a node's global transform is split into a rigid
// part (kept as the rest pose) and a deformation (applied to the vertices). The split is carried
// down the chain of parents; a chain of pure rotations and translations leaves the deformation
// exactly the identity, and with it every bit of the vertices.
#include "import/node_transforms.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace sherd {
namespace {

/// Polar decomposition by averaging with the inverse transpose until it stays (N. J. Higham,
/// Computing the Polar Decomposition, 1986). Nothing if `m` is singular.
std::optional<glm::dmat3> nearestRotation(glm::dmat3 m) {
    // A mirror goes into the deformation.
    if (glm::determinant(m) < 0) m = -m;
    double scale = 0;
    for (int c = 0; c < 3; ++c) scale = std::max(scale, glm::length(m[c]));
    if (!(scale > 0) || !std::isfinite(scale)) return std::nullopt;
    m /= scale;
    for (int step = 0; step < 64; ++step) {
        const double determinant = glm::determinant(m);
        if (!(std::abs(determinant) > 1e-18)) return std::nullopt;
        const glm::dmat3 next = 0.5 * (m + glm::transpose(glm::inverse(m)));
        double change = 0;
        for (int c = 0; c < 3; ++c) change = std::max(change, glm::length(next[c] - m[c]));
        m = next;
        if (change < 1e-15) break;
    }
    return m;
}

/// Matrices are written with float rounding: within it, a rotation is meant to be one.
glm::dmat3 snapIdentity(const glm::dmat3& deform) {
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
            if (std::abs(deform[c][r] - (c == r ? 1.0 : 0.0)) > 2e-6) return deform;
        }
    }
    return glm::dmat3(1.0);
}

std::optional<NodeTransform> fromMatrix(const std::vector<double>& values) {
    NodeTransform local;
    glm::dmat3 linear;
    for (size_t i = 0; i < 12; ++i) {
        const auto row = static_cast<int>(i % 4);
        if (row < 3) linear[static_cast<int>(i / 4)][row] = values[i];
    }
    const auto rotation = nearestRotation(linear);
    if (!rotation) return std::nullopt;
    local.rotation = glm::normalize(glm::quat_cast(*rotation));
    local.deform = snapIdentity(glm::transpose(*rotation) * linear);
    local.translation = {values[12], values[13], values[14]};
    return local;
}

/// Nothing if the node flattens what it holds.
std::optional<NodeTransform> localTransform(const tinygltf::Node& node) {
    if (!node.matrix.empty()) return fromMatrix(node.matrix);
    NodeTransform local;
    if (!node.translation.empty()) {
        local.translation = {node.translation[0], node.translation[1], node.translation[2]};
    }
    if (!node.rotation.empty()) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(q);
        if (!(length > 1e-6)) return std::nullopt;
        local.rotation = q / length;
    }
    if (!node.scale.empty()) {
        for (int k = 0; k < 3; ++k) {
            local.deform[k][k] = node.scale[static_cast<size_t>(k)];
            if (local.deform[k][k] == 0) return std::nullopt;
        }
    }
    return local;
}

bool isUniform(const glm::dmat3& m) {
    return m == glm::dmat3(m[0][0]);
}

/// Rp Dp Rc Dc = (Rp Rc) (Rc^T Dp Rc) Dc.
NodeTransform compose(const NodeTransform& parent, const NodeTransform& child) {
    NodeTransform out;
    out.translation = parent.rotation * (parent.deform * child.translation) + parent.translation;
    out.rotation = glm::normalize(parent.rotation * child.rotation);
    if (isUniform(parent.deform)) {
        out.deform = parent.deform[0][0] * child.deform;
    } else {
        const glm::dmat3 rotation = glm::mat3_cast(child.rotation);
        out.deform = glm::transpose(rotation) * parent.deform * rotation * child.deform;
    }
    return out;
}

bool isUsable(const NodeTransform& t) {
    for (int k = 0; k < 3; ++k) {
        if (!std::isfinite(static_cast<float>(t.translation[k]))) return false;
        for (int c = 0; c < 3; ++c) {
            if (!std::isfinite(static_cast<float>(t.deform[c][k]))) return false;
        }
    }
    const double determinant = glm::determinant(t.deform);
    return std::isfinite(determinant) && determinant != 0;
}

}  // namespace

Result<std::vector<int>> nodeParents(const GltfSource& source) {
    const auto& nodes = source.model.nodes;
    std::vector<int> parents(nodes.size(), -1);
    for (size_t i = 0; i < nodes.size(); ++i) {
        const std::string pointer = "/nodes/" + std::to_string(i) + "/children";
        for (const int child : nodes[i].children) {
            if (child < 0 || static_cast<size_t>(child) >= nodes.size()) {
                return fail(ErrorCode::invalidData, "a child node does not exist",
                            source.where(pointer));
            }
            if (parents[static_cast<size_t>(child)] != -1) {
                return fail(ErrorCode::invalidData,
                            "node " + std::to_string(child) + " has two parents",
                            source.where(pointer));
            }
            parents[static_cast<size_t>(child)] = static_cast<int>(i);
        }
    }
    // With one parent each, whoever is not reached from a root hangs in a cycle.
    std::vector<int> reached;
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (parents[i] == -1) reached.push_back(static_cast<int>(i));
    }
    for (size_t i = 0; i < reached.size(); ++i) {
        const auto& children = nodes[static_cast<size_t>(reached[i])].children;
        reached.insert(reached.end(), children.begin(), children.end());
    }
    if (reached.size() != nodes.size()) {
        return fail(ErrorCode::invalidData, "some nodes are their own ancestors",
                    source.where("/nodes"));
    }
    return parents;
}

Result<NodeTransform> GlobalTransforms::of(int node) {
    std::vector<int> chain;
    NodeTransform global;
    for (int n = node; n != -1; n = parents_[static_cast<size_t>(n)]) {
        if (const auto& known = known_[static_cast<size_t>(n)]) {
            global = *known;
            break;
        }
        chain.push_back(n);
    }
    std::reverse(chain.begin(), chain.end());
    for (const int link : chain) {
        const auto local = localTransform(source_.model.nodes[static_cast<size_t>(link)]);
        if (local) global = compose(global, *local);
        if (!local || !isUsable(global)) {
            return fail(ErrorCode::invalidData,
                        "the node's transform flattens the object or is not finite; apply the "
                        "transform in the modelling tool and export again",
                        source_.where("/nodes/" + std::to_string(link)));
        }
        known_[static_cast<size_t>(link)] = global;
    }
    return global;
}

Placement relativeTo(const NodeTransform& frame, const NodeTransform& of) {
    const glm::dquat back = glm::conjugate(frame.rotation);
    Placement out{of.deform, back * (of.translation - frame.translation)};
    if (of.rotation != frame.rotation) {
        out.linear = glm::mat3_cast(glm::normalize(back * of.rotation)) * of.deform;
    }
    return out;
}

}  // namespace sherd
