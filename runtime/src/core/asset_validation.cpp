// SPDX-License-Identifier: MIT
#include "core/asset_validation.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace sherd {
namespace {

bool finite(float x) {
    return std::isfinite(x);
}
bool finite(const glm::vec3& v) {
    return finite(v.x) && finite(v.y) && finite(v.z);
}

bool unit(const glm::quat& q) {
    const float norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    return finite(norm) && std::abs(norm - 1.0F) < 1e-3F;
}

bool inside(Range range, size_t size) {
    return uint64_t(range.first) + range.count <= size;
}

tl::unexpected<Error> invalid(std::string message, std::string where) {
    return fail(ErrorCode::invalidData, std::move(message) + "; bake the object again",
                std::move(where));
}

std::string at(const char* table, size_t index, const char* field) {
    return std::string("/") + table + "/" + std::to_string(index) + field;
}

Result<void> checkGeometry(const FractureSet& set) {
    const FractureGeometry& geometry = set.geometry;
    const size_t vertices = geometry.positions.size();
    for (size_t v = 0; v < vertices; ++v) {
        if (!finite(geometry.positions[v])) {
            return invalid("a position is not finite", at("geometry/positions", v, ""));
        }
    }
    for (size_t i = 0; i < geometry.indices.size(); ++i) {
        if (geometry.indices[i] >= vertices) {
            return invalid("an index names a vertex that does not exist",
                           at("geometry/indices", i, ""));
        }
    }
    for (size_t a = 0; a < geometry.attributes.size(); ++a) {
        const Attribute& attribute = geometry.attributes[a];
        const bool widthOk = attribute.components >= 1 && attribute.components <= 4;
        if (!widthOk || attribute.values.size() != vertices * attribute.components) {
            return invalid("an attribute does not cover every vertex",
                           at("geometry/attributes", a, ""));
        }
    }
    for (size_t p = 0; p < geometry.primitives.size(); ++p) {
        const Primitive& primitive = geometry.primitives[p];
        if (!inside(primitive.indices, geometry.indices.size()) ||
            primitive.indices.count % 3 != 0) {
            return invalid("a primitive's indices leave the buffer",
                           at("geometry/primitives", p, ""));
        }
        if (primitive.material >= set.materials.size()) {
            return invalid("a primitive names a material that does not exist",
                           at("geometry/primitives", p, "/material"));
        }
    }
    return {};
}

Result<void> checkRanges(const FractureSet& set) {
    if (set.fragmentRanges.size() != set.fragments.size() * set.geometry.primitives.size()) {
        return invalid("there is not one index range per fragment and primitive",
                       "/fragmentRanges");
    }
    for (size_t r = 0; r < set.fragmentRanges.size(); ++r) {
        const Range range = set.fragmentRanges[r];
        if (!inside(range, set.geometry.indices.size()) || range.count % 3 != 0) {
            return invalid("a fragment's indices leave the buffer", at("fragmentRanges", r, ""));
        }
    }
    return {};
}

Result<void> checkTree(const FractureSet& set) {
    if (set.fragments.empty()) return invalid("there are no fragments", "/fragments");
    if (set.fragments[0].parent != -1) {
        return invalid("fragment 0 must be the object itself", "/fragments/0/parent");
    }
    // Children lie strictly behind their parent, so the tree has no cycle; each is claimed by the
    // parent it names, so none is claimed twice.
    size_t claimed = 1;
    for (size_t f = 0; f < set.fragments.size(); ++f) {
        const Fragment& fragment = set.fragments[f];
        const Range children = fragment.children;
        if (children.count == 0) continue;
        if (!inside(children, set.fragments.size()) || children.first <= f) {
            return invalid("the children are not fragments behind their parent",
                           at("fragments", f, "/children"));
        }
        for (uint32_t c = children.first; c < children.first + children.count; ++c) {
            if (set.fragments[c].parent != int32_t(f) || set.fragments[c].level <= fragment.level) {
                return invalid("a child does not name its parent, or its level is not deeper",
                               at("fragments", c, "/parent"));
            }
        }
        claimed += children.count;
    }
    if (claimed != set.fragments.size()) {
        return invalid("a fragment is nobody's child", "/fragments");
    }
    return {};
}

Result<void> checkFragment(const FractureSet& set, size_t f) {
    const Fragment& fragment = set.fragments[f];
    if (!finite(fragment.mass) || fragment.mass <= 0) {
        return invalid("the mass must be a positive number", at("fragments", f, "/mass"));
    }
    if (!finite(fragment.centerOfMass)) {
        return invalid("the centre of mass is not finite", at("fragments", f, "/centerOfMass"));
    }
    const glm::vec3 inertia = fragment.inertiaDiagonal;
    if (!finite(inertia) || inertia.x <= 0 || inertia.y <= 0 || inertia.z <= 0) {
        return invalid("the moments of inertia must be positive numbers",
                       at("fragments", f, "/inertiaDiagonal"));
    }
    if (!unit(fragment.inertiaOrientation)) {
        return invalid("the orientation is not a unit quaternion",
                       at("fragments", f, "/inertiaOrientation"));
    }
    const bool surfaceOk = finite(fragment.friction) && fragment.friction >= 0 &&
                           finite(fragment.restitution) && fragment.restitution >= 0;
    if (!surfaceOk) {
        return invalid("friction and restitution must not be negative",
                       at("fragments", f, "/friction"));
    }
    if (!finite(fragment.toughness) || fragment.toughness < 0) {
        return invalid("the toughness must not be negative", at("fragments", f, "/toughness"));
    }
    if (fragment.hulls.count == 0 || !inside(fragment.hulls, set.hulls.size())) {
        return invalid("the fragment has no collider", at("fragments", f, "/hulls"));
    }
    return {};
}

Result<void> checkColliders(const FractureSet& set) {
    for (size_t p = 0; p < set.hullPoints.size(); ++p) {
        if (!finite(set.hullPoints[p])) {
            return invalid("a collider point is not finite", at("hullPoints", p, ""));
        }
    }
    for (size_t h = 0; h < set.hulls.size(); ++h) {
        const ConvexHull& hull = set.hulls[h];
        if (hull.points.count == 0 || !inside(hull.points, set.hullPoints.size())) {
            return invalid("a collider's points leave the table", at("hulls", h, "/points"));
        }
        if (!finite(hull.margin) || hull.margin < 0) {
            return invalid("a collision margin must not be negative", at("hulls", h, "/margin"));
        }
    }
    return {};
}

Result<void> checkBonds(const FractureSet& set) {
    const auto count = int64_t(set.fragments.size());
    for (size_t b = 0; b < set.bonds.size(); ++b) {
        const Bond& bond = set.bonds[b];
        const bool endsOk = bond.a >= 0 && bond.a < count && bond.b >= -1 && bond.b < count;
        if (!endsOk || bond.a == bond.b) {
            return invalid("a bond names a fragment that does not exist", at("bonds", b, ""));
        }
        const bool numbersOk = finite(bond.area) && bond.area >= 0 && finite(bond.toughness) &&
                               bond.toughness >= 0 && finite(bond.strength) && bond.strength >= 0 &&
                               finite(bond.centroid) && finite(bond.normal);
        if (!numbersOk) {
            return invalid("a bond's area, strength and toughness must not be negative",
                           at("bonds", b, "/area"));
        }
    }
    return {};
}

}  // namespace

Result<void> validateForRuntime(const FractureSet& set) {
    if (auto ok = checkTree(set); !ok) return ok;
    if (auto ok = checkGeometry(set); !ok) return ok;
    if (auto ok = checkRanges(set); !ok) return ok;
    if (auto ok = checkColliders(set); !ok) return ok;
    for (size_t f = 0; f < set.fragments.size(); ++f) {
        if (auto ok = checkFragment(set, f); !ok) return ok;
    }
    return checkBonds(set);
}

}  // namespace sherd
