// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace sherd {

/// What went wrong, for programs. `sherd-bake` maps each to a documented exit code.
enum class ErrorCode {
    badArgument,           ///< an option or parameter outside its documented range
    fileNotFound,          ///< the file does not exist
    fileRead,              ///< the file exists but cannot be read
    fileWrite,             ///< the output cannot be written
    malformed,             ///< the bytes are not what the format says (syntax, truncation)
    invalidData,           ///< well-formed, but a number, index, count or reference is out of range
    unsupported,           ///< valid, but of a kind Sherd does not handle
    unsupportedExtension,  ///< a glTF extension in `extensionsRequired` that Sherd does not know
    limitExceeded,         ///< larger than a documented limit
    noTriangles,           ///< the model (or the chosen node) holds no triangles
    noTextureCoordinates,  ///< lines are drawn in UV, and the mesh has none
    skinnedMesh,           ///< skinned or morphed: it has no single shape to break
    openMesh,              ///< the surface has boundary edges
    nonManifoldMesh,   ///< an edge is used by more than two triangles, or twice in one direction
    emptyMap,          ///< the fracture map holds no line
    separatesNothing,  ///< the lines cut the surface into no more pieces than it had
    notClosed,         ///< a fragment failed the closedness proof: nothing is written
    internal,          ///< a mistake in Sherd itself
};

/// A failure: what (`message`, with what to do about it) and where (`where`: file, JSON pointer,
/// UV position or triangle; may be empty).
struct Error {
    ErrorCode code = ErrorCode::internal;
    std::string message;
    std::string where;
};

/// A value or an `Error`. No exception crosses a public Sherd interface.
template <class T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(ErrorCode code, std::string message, std::string where = {}) {
    return tl::unexpected<Error>(Error{code, std::move(message), std::move(where)});
}

}  // namespace sherd
