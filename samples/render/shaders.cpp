// SPDX-License-Identifier: MIT
#include "shaders.h"

namespace sherd::samples {

const char* const kSurfaceVertexShader = R"glsl(#version 330 core
layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in vec2 aUv;
uniform mat4 uModel;
uniform mat4 uViewProjection;
uniform mat4 uShadow;
out vec3 vWorld;
out vec3 vObject;
out vec3 vNormal;
out vec2 vUv;
out vec3 vShadow;

void main() {
    vec4 world = uModel * vec4(aPosition, 1.0);
    vWorld = world.xyz;
    vObject = aPosition;
    vNormal = mat3(uModel) * aNormal;
    vUv = aUv;
    vShadow = (uShadow * vec4(world.xyz, 1.0)).xyz * 0.5 + 0.5;
    gl_Position = uViewProjection * world;
}
)glsl";

const char* const kSurfaceFragmentShader = R"glsl(#version 330 core
in vec3 vWorld;
in vec3 vObject;
in vec3 vNormal;
in vec2 vUv;
in vec3 vShadow;
uniform sampler2D uTexture;
uniform sampler2DShadow uShadowMap;
uniform vec3 uEye;
uniform vec3 uSun;
uniform vec3 uColor;
uniform vec3 uFocus;
uniform float uGridSize;
uniform float uFadeRadius;
uniform float uRoughness;
uniform float uMetallic;
uniform float uGrain;
uniform float uTextured;
uniform float uGround;
out vec4 oColor;

const vec3 kSunLight = vec3(3.3, 2.95, 2.45);
const vec3 kSkyLight = vec3(0.52, 0.62, 0.80);
const vec3 kGroundLight = vec3(0.30, 0.265, 0.23);

float hash(vec3 p) {
    p = fract(p * vec3(0.1031, 0.1030, 0.0973));
    p += dot(p, p.yxz + 33.33);
    return fract((p.x + p.y) * p.z);
}

float noise(vec3 p) {
    vec3 i = floor(p);
    vec3 f = p - i;
    f = f * f * (3.0 - 2.0 * f);
    vec4 low = vec4(hash(i), hash(i + vec3(1, 0, 0)), hash(i + vec3(0, 1, 0)), hash(i + vec3(1, 1, 0)));
    vec4 high = vec4(hash(i + vec3(0, 0, 1)), hash(i + vec3(1, 0, 1)), hash(i + vec3(0, 1, 1)), hash(i + vec3(1, 1, 1)));
    vec4 plane = mix(low, high, f.z);
    vec2 line = mix(plane.xy, plane.zw, f.y);
    return mix(line.x, line.y, f.x);
}

float sunlit(float facing) {
    if (any(lessThan(vShadow, vec3(0.0))) || any(greaterThan(vShadow, vec3(1.0)))) return 1.0;
    vec2 texel = 1.0 / vec2(textureSize(uShadowMap, 0));
    // By how much the surface itself may come nearer to the sun within the reach of the samples.
    // It must not depend on what casts the shadow: hidden faces end at the surface, and offset by
    // less than the surface they would darken it along every crack.
    float slope = min(sqrt(1.0 - facing * facing) / max(facing, 1e-3), 12.0);
    float bias = 0.0008 + 1.2 * slope * texel.x;
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            sum += texture(uShadowMap, vec3(vShadow.xy + vec2(x, y) * 1.3 * texel, vShadow.z - bias));
        }
    }
    return sum / 9.0;
}

vec3 tonemap(vec3 c) {
    c *= 0.52;
    // Narkowicz's fit of the ACES film curve, then sRGB's approximate gamma.
    c = c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14);
    return pow(clamp(c, 0.0, 1.0), vec3(1.0 / 2.2));
}

vec3 backdrop(float height) {
    return mix(vec3(0.30, 0.33, 0.37), vec3(0.10, 0.15, 0.23), smoothstep(0.0, 0.6, height));
}

vec3 groundColor(vec3 p) {
    vec2 cell = p.xz / uGridSize;
    vec2 width = fwidth(cell) * 1.2 + 0.012;
    vec2 line = smoothstep(width, vec2(0.0), abs(fract(cell - 0.5) - 0.5));
    float grid = max(line.x, line.y) * clamp(0.05 / max(width.x, width.y), 0.0, 1.0);
    float speckle = noise(p * 9.0 / uGridSize) * 0.08 + noise(p * 1.3 / uGridSize) * 0.10;
    return vec3(0.135, 0.137, 0.142) * (0.90 + speckle) * (1.0 - 0.35 * grid);
}

void main() {
    vec3 n = normalize(vNormal);
    vec3 toEye = normalize(uEye - vWorld);
    if (dot(n, toEye) < 0.0 && uGround < 0.5 && !gl_FrontFacing) n = -n;
    vec3 base = uColor;
    if (uTextured > 0.5) base *= texture(uTexture, vUv).rgb;
    if (uGrain > 0.0) {
        vec3 p = vObject * uGrain;
        float rough = 0.5 * noise(p) + 0.3 * noise(p * 2.7) + 0.2 * noise(p * 7.1);
        base *= 0.72 + 0.56 * rough;
    }
    if (uGround > 0.5) base = groundColor(vWorld);

    float facing = max(dot(n, uSun), 0.0);
    float light = facing > 0.0 ? sunlit(facing) : 0.0;
    vec3 half_ = normalize(uSun + toEye);
    float alpha = uRoughness * uRoughness;
    float nh = max(dot(n, half_), 0.0);
    float d = nh * nh * (alpha * alpha - 1.0) + 1.0;
    float specular = alpha * alpha / (4.0 * d * d + 1e-4);
    vec3 f0 = mix(vec3(0.04), base, uMetallic);
    vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - max(dot(half_, toEye), 0.0), 5.0);

    float up = n.y * 0.5 + 0.5;
    vec3 ambient = mix(kGroundLight, kSkyLight, up);
    // Close to the floor less of the sky is seen.
    if (uGround < 0.5) ambient *= mix(0.62, 1.0, smoothstep(0.0, 0.6 * uGridSize, vWorld.y));
    vec3 diffuse = base * (1.0 - uMetallic);
    vec3 color = diffuse * (ambient + kSunLight * facing * light * 0.62);
    color += kSunLight * facing * light * specular * fresnel;
    vec3 mirrored = reflect(-toEye, n);
    vec3 sky = mix(kGroundLight, backdrop(mirrored.y) * 1.8, smoothstep(-0.15, 0.15, mirrored.y));
    vec3 rim = f0 + (1.0 - f0) * pow(1.0 - max(dot(n, toEye), 0.0), 5.0) * (1.0 - uRoughness);
    color += sky * rim * (1.0 - 0.6 * uRoughness);

    if (uGround > 0.5) {
        float away = length(vWorld.xz - uFocus.xz) / uFadeRadius;
        color = mix(color, backdrop(0.0), smoothstep(0.35, 1.0, away));
    }
    oColor = vec4(tonemap(color), 1.0);
}
)glsl";

const char* const kShadowVertexShader = R"glsl(#version 330 core
layout(location = 0) in vec3 aPosition;
uniform mat4 uModel;
uniform mat4 uShadow;
void main() { gl_Position = uShadow * (uModel * vec4(aPosition, 1.0)); }
)glsl";

const char* const kShadowFragmentShader = R"glsl(#version 330 core
void main() {}
)glsl";

const char* const kScreenVertexShader = R"glsl(#version 330 core
void main() { gl_Position = vec4((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1, 0.0, 1.0); }
)glsl";

// Blurs along edges of brightness, after T. Lottes, "FXAA", 2009. On software OpenGL it costs a
// third of what multisampling does.
const char* const kSmoothFragmentShader = R"glsl(#version 330 core
uniform sampler2D uPicture;
out vec4 oColor;

float luma(vec3 c) { return dot(c, vec3(0.30, 0.59, 0.11)); }

void main() {
    vec2 texel = 1.0 / vec2(textureSize(uPicture, 0));
    vec2 at = gl_FragCoord.xy * texel;
    vec3 here = texture(uPicture, at).rgb;
    float m = luma(here);
    float nw = luma(textureOffset(uPicture, at, ivec2(-1, 1)).rgb);
    float ne = luma(textureOffset(uPicture, at, ivec2(1, 1)).rgb);
    float sw = luma(textureOffset(uPicture, at, ivec2(-1, -1)).rgb);
    float se = luma(textureOffset(uPicture, at, ivec2(1, -1)).rgb);
    float low = min(m, min(min(nw, ne), min(sw, se)));
    float high = max(m, max(max(nw, ne), max(sw, se)));
    if (high - low < max(0.03, 0.10 * high)) {
        oColor = vec4(here, 1.0);
        return;
    }
    vec2 along = vec2((sw + se) - (nw + ne), (nw + sw) - (ne + se));
    along /= min(abs(along.x), abs(along.y)) + max(0.03 * (nw + ne + sw + se), 0.008);
    along = clamp(along, -6.0, 6.0) * texel;
    vec3 near = 0.5 * (texture(uPicture, at - along / 6.0).rgb + texture(uPicture, at + along / 6.0).rgb);
    vec3 wide = 0.5 * near + 0.25 * (texture(uPicture, at - along / 2.0).rgb + texture(uPicture, at + along / 2.0).rgb);
    float w = luma(wide);
    oColor = vec4(w < low || w > high ? near : wide, 1.0);
}
)glsl";

const char* const kSkyVertexShader = R"glsl(#version 330 core
uniform mat4 uInverseViewProjection;
out vec3 vFar;
void main() {
    vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1);
    vec4 far = uInverseViewProjection * vec4(corner, 1.0, 1.0);
    vFar = far.xyz / far.w;
    gl_Position = vec4(corner, 1.0, 1.0);
}
)glsl";

const char* const kSkyFragmentShader = R"glsl(#version 330 core
in vec3 vFar;
uniform vec3 uEye;
out vec4 oColor;

vec3 tonemap(vec3 c) {
    c *= 0.52;
    c = c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14);
    return pow(clamp(c, 0.0, 1.0), vec3(1.0 / 2.2));
}

void main() {
    float height = max(normalize(vFar - uEye).y, 0.0);
    vec3 color = mix(vec3(0.30, 0.33, 0.37), vec3(0.10, 0.15, 0.23), smoothstep(0.0, 0.6, height));
    oColor = vec4(tonemap(color), 1.0);
}
)glsl";

}  // namespace sherd::samples
