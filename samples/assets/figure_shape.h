// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

namespace sherd::samples {

/// A robed woman with an apple on a plinth, 1 m high, facing +z: one smooth shape function
/// (signed_distance.h).
double figureShape(const glm::dvec3& p);

inline constexpr double kFigurePlinth = 0.150;  ///< height of the plinth's top, metres
inline constexpr double kFigureNeck = 0.868;    ///< height of the neckline, metres

/// 1 where hair is, 0 elsewhere, for the paint.
double figureHair(const glm::dvec3& p);

}  // namespace sherd::samples
