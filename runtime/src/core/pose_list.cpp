// SPDX-License-Identifier: MIT
#include "sherd/runtime/pose_list.h"

#include <algorithm>

#include "sherd/runtime/island_world.h"

namespace sherd {
namespace {

bool isSame(const RigidPose& a, const RigidPose& b) {
    return a.translation == b.translation && a.rotation == b.rotation;
}

}  // namespace

void PoseList::noteMoved(uint32_t object) {
    if (isMoved_.size() <= object) isMoved_.resize(object + 1, 0);
    if (isMoved_[object] != 0) return;
    isMoved_[object] = 1;
    moved_.push_back(object);
}

void PoseList::noteRegrouped(uint32_t object) {
    listed_ = std::min(listed_, object);
}

/// Next to the last one it becomes one with it.
void PoseList::noteChange(size_t first, size_t end) {
    if (first == end) return;
    if (!changes_.empty()) {
        Range& last = changes_.back();
        if (last.first <= first && first <= last.first + last.count) {
            last.count = std::max(last.count, uint32_t(end - last.first));
            return;
        }
    }
    changes_.push_back({uint32_t(first), uint32_t(end - first)});
}

void PoseList::append(const IslandWorld& world, uint32_t object) {
    firstOf_.push_back(poses_.size());
    const ObjectId id = world.idOf(object);
    if (!world.object(object).asset) return;
    const Asset& asset = *world.object(object).asset;
    members_.clear();
    for (const uint32_t i : world.object(object).islands)
        for (const uint32_t fragment : world.island(i).fragments)
            members_.emplace_back(fragment, i);
    // Islands are in the order of their first fragments, and mostly one after the other.
    if (!std::is_sorted(members_.begin(), members_.end()))
        std::sort(members_.begin(), members_.end());
    for (const auto& [fragment, i] : members_) {
        const IslandWorld::Places& places = world.toldPlacesOf(i);
        poses_.push_back({id, &asset.original(), fragment, places.now, places.before, asset.scale(),
                          world.fadeOf(world.island(i))});
        islandOf_.push_back(i);
    }
}

std::span<const FragmentPose> PoseList::list(const IslandWorld& world) {
    std::sort(moved_.begin(), moved_.end());
    for (const uint32_t object : moved_) {
        isMoved_[object] = 0;
        if (object >= listed_) continue;
        for (size_t p = firstOf_[object]; p < firstOf_[object + 1]; ++p) {
            const IslandWorld::Places& places = world.toldPlacesOf(islandOf_[p]);
            FragmentPose& pose = poses_[p];
            const float fade = world.fadeOf(world.island(islandOf_[p]));
            if (isSame(pose.pose, places.now) && isSame(pose.previous, places.before) &&
                pose.fade == fade)
                continue;
            pose.fade = fade;
            pose.pose = places.now;
            pose.previous = places.before;
            noteChange(p, p + 1);
        }
    }
    moved_.clear();
    relist(world);
    // Nobody may ever ask for them.
    constexpr size_t kMostChanges = 4096;
    if (changes_.size() > kMostChanges) changes_.assign(1, {0, uint32_t(poses_.size())});
    return poses_;
}

void PoseList::relist(const IslandWorld& world) {
    if (listed_ >= world.objectCount()) return;
    const size_t kept = listed_ < firstOf_.size() ? firstOf_[listed_] : 0;
    poses_.resize(kept);
    islandOf_.resize(kept);
    firstOf_.resize(listed_);
    for (uint32_t object = listed_; object < world.objectCount(); ++object) append(world, object);
    firstOf_.push_back(poses_.size());
    listed_ = world.objectCount();
    noteChange(kept, poses_.size());
}

std::span<const Range> PoseList::takeChanges(const IslandWorld& world) {
    (void)list(world);
    std::sort(changes_.begin(), changes_.end(),
              [](const Range& x, const Range& y) { return x.first < y.first; });
    taken_.clear();
    taken_.swap(changes_);
    size_t count = 0;
    for (const Range& change : taken_) {
        Range* last = count > 0 ? &taken_[count - 1] : nullptr;
        if (last && change.first <= last->first + last->count) {
            last->count = std::max(last->count, change.first + change.count - last->first);
        } else {
            taken_[count++] = change;
        }
    }
    taken_.resize(count);
    // The list may have become shorter since.
    const auto end = uint32_t(poses_.size());
    for (Range& range : taken_)
        range.count = std::min(range.first + range.count, end) - std::min(range.first, end);
    std::erase_if(taken_, [](const Range& range) { return range.count == 0; });
    return taken_;
}

}  // namespace sherd
