// SPDX-License-Identifier: MIT
#include "sherd/runtime/structure.h"

#include <algorithm>
#include <utility>

namespace sherd {

void Structure::renew(std::shared_ptr<const Asset> asset) {
    asset_ = std::move(asset);
    standing_.clear();
    lost_.clear();
    pins_.clear();
    gone_.clear();
}

void Structure::makeRoom() {
    standing_.assign(graph().leafCount(), 0);
    lost_.assign(std::max<size_t>(graph().bonds().size(), 1), 0.0F);
}

void Structure::breakBond(uint32_t bond) {
    prepare();
    lost_[bond] = 1;
}

void Structure::hold(uint32_t bond) {
    if (isBroken(bond)) lost_[bond] = kAlmostAll;
}

void Structure::strengthen(uint32_t bond, float share) {
    if (isDamaged() && !isBroken(bond)) lost_[bond] = std::max(lost_[bond] - share, 0.0F);
}

void Structure::discard(uint32_t fragment) {
    prepare();
    if (gone_.empty()) gone_.assign(graph().leafCount(), 0);
    const Range leaves = graph().leavesOf(fragment);
    std::fill_n(gone_.begin() + leaves.first, leaves.count, uint8_t(1));
}

void Structure::pin(uint32_t leaf, bool pinned) {
    if (pins_.empty()) {
        if (!pinned) return;
        pins_.assign(graph().leafCount(), 0);
    }
    pins_[leaf] = pinned ? 1 : 0;
}

void Structure::open(uint32_t fragment) {
    prepare();
    const Range children = asset_->fragment(fragment).children;
    for (uint32_t c = children.first; c < children.first + children.count; ++c) {
        const Range leaves = graph().leavesOf(c);
        std::fill_n(standing_.begin() + leaves.first, leaves.count, c);
    }
}

void Structure::close(uint32_t fragment) {
    const Range leaves = graph().leavesOf(fragment);
    if (isDamaged()) std::fill_n(standing_.begin() + leaves.first, leaves.count, fragment);
}

void Structure::openDownTo(uint32_t fragment, Vector<uint32_t>& opened) {
    const uint32_t leaf = graph().leavesOf(fragment).first;
    for (;;) {
        const uint32_t standing = fragmentAt(leaf);
        // Parents lie in front of their children.
        if (standing > fragment || asset_->fragment(standing).children.count == 0) return;
        open(standing);
        opened.push_back(standing);
    }
}

}  // namespace sherd
