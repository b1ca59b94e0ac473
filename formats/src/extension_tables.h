// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/geometry_packing.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Appends typed tables to a binary chunk and describes them as accessors.
class TableWriter {
  public:
    /// Numbers continue those of the document that the tables are added to.
    TableWriter(std::vector<uint8_t>& bin, size_t firstView, size_t firstAccessor)
        : bin_(bin), viewCount_(firstView), accessorCount_(firstAccessor) {}

    /// All tables until the next call share one bufferView.
    void beginView();
    void endView();
    /// Accessor index. `components` 1 to 4.
    size_t floats(std::span<const float> values, uint32_t components);
    size_t integers(std::span<const uint32_t> values, uint32_t components);

    /// A bufferView of its own, of anything; its index.
    size_t bytes(std::span<const uint8_t> bytes);

    const std::vector<std::string>& views() const { return views_; }
    const std::vector<std::string>& accessors() const { return accessors_; }

  private:
    size_t add(std::span<const uint8_t> bytes, uint32_t componentType, uint32_t components);

    std::vector<uint8_t>& bin_;
    size_t viewCount_;
    size_t accessorCount_;
    size_t viewBegin_ = 0;
    std::vector<std::string> views_;
    std::vector<std::string> accessors_;
};

/// One fracture set as the JSON of `fractures[i]`; its numbers go into the tables.
Result<nlohmann::ordered_json> fractureJson(const FractureSet& set, TableWriter& tables,
                                            const GeometryPacking& packing);

}  // namespace sherd
