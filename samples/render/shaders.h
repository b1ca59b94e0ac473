// SPDX-License-Identifier: MIT
#pragma once

namespace sherd::samples {

extern const char* const kSurfaceVertexShader;
extern const char* const kSurfaceFragmentShader;
extern const char* const kShadowVertexShader;
extern const char* const kShadowFragmentShader;
extern const char* const kScreenVertexShader;
extern const char* const kSmoothFragmentShader;
extern const char* const kSkyVertexShader;
extern const char* const kSkyFragmentShader;

}  // namespace sherd::samples
