// SPDX-License-Identifier: MIT
#pragma once

#include "sherd/formats/result.h"

namespace sherd::cli {

/// What `sherd-bake` returns to the shell. Numbers are part of the interface and never reused.
enum ExitCode : int {
    kExitOk = 0,
    kExitInternal = 1,     ///< a mistake in Sherd itself
    kExitUsage = 2,        ///< the command line is not understood
    kExitBadArgument = 3,  ///< an option's value is outside its documented range
    kExitFileNotFound = 4,
    kExitFileRead = 5,
    kExitFileWrite = 6,
    kExitMalformed = 7,
    kExitInvalidData = 8,
    kExitUnsupported = 9,
    kExitUnsupportedExtension = 10,
    kExitLimitExceeded = 11,
    kExitNoTriangles = 12,
    kExitNoTextureCoordinates = 13,
    kExitSkinnedMesh = 14,
    kExitOpenMesh = 15,
    kExitNonManifoldMesh = 16,
    kExitEmptyMap = 17,
    kExitSeparatesNothing = 18,
    kExitNotClosed = 19,
    kExitCheckFailed = 20,    ///< `check` read the file and found it wrong
    kExitNoFractureSet = 21,  ///< `check` or `export` on a file that was never baked
};

/// The exit code of a failure.
constexpr int exitCodeOf(ErrorCode code) {
    switch (code) {
        case ErrorCode::badArgument:
            return kExitBadArgument;
        case ErrorCode::fileNotFound:
            return kExitFileNotFound;
        case ErrorCode::fileRead:
            return kExitFileRead;
        case ErrorCode::fileWrite:
            return kExitFileWrite;
        case ErrorCode::malformed:
            return kExitMalformed;
        case ErrorCode::invalidData:
            return kExitInvalidData;
        case ErrorCode::unsupported:
            return kExitUnsupported;
        case ErrorCode::unsupportedExtension:
            return kExitUnsupportedExtension;
        case ErrorCode::limitExceeded:
            return kExitLimitExceeded;
        case ErrorCode::noTriangles:
            return kExitNoTriangles;
        case ErrorCode::noTextureCoordinates:
            return kExitNoTextureCoordinates;
        case ErrorCode::skinnedMesh:
            return kExitSkinnedMesh;
        case ErrorCode::openMesh:
            return kExitOpenMesh;
        case ErrorCode::nonManifoldMesh:
            return kExitNonManifoldMesh;
        case ErrorCode::emptyMap:
            return kExitEmptyMap;
        case ErrorCode::separatesNothing:
            return kExitSeparatesNothing;
        case ErrorCode::notClosed:
            return kExitNotClosed;
        case ErrorCode::internal:
            return kExitInternal;
    }
    return kExitInternal;
}

}  // namespace sherd::cli
