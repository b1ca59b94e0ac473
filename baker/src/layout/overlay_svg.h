// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sherd/baker/layout.h"

namespace sherd {

/// A layer of the template that is locked and never read back as lines, `id` "sherd-guide-...".
/// Every element inside needs an id that begins with "sherd-guide" too, for editors that dissolve
/// layers.
std::string guideLayer(const std::string& id, const std::string& label, const std::string& content);

/// Overlays as layers: lines, rings around places to look at, and a legend where it covers
/// the least of the meshes' charts. Empty for overlays without any. Counts `spots`.
std::string overlayLayers(std::span<const LayoutOverlay> overlays,
                          std::span<const SurfaceMesh> meshes, double size, size_t& spots);

}  // namespace sherd
