// SPDX-License-Identifier: MIT
// OpenGL objects that clean up after themselves.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "sherd/formats/result.h"

namespace sherd::samples {

class GlProgram {
  public:
    static Result<GlProgram> build(const char* vertexShader, const char* fragmentShader);
    GlProgram() = default;
    ~GlProgram();
    GlProgram(GlProgram&& other) noexcept;
    GlProgram& operator=(GlProgram&& other) noexcept;
    GlProgram(const GlProgram&) = delete;
    GlProgram& operator=(const GlProgram&) = delete;

    void use() const { glUseProgram(id_); }
    void set(const char* name, float value) const;
    void set(const char* name, int value) const;
    void set(const char* name, const glm::vec3& value) const;
    void set(const char* name, const glm::mat4& value) const;

  private:
    GLuint id_ = 0;
};

/// A framebuffer with a colour texture and a depth renderbuffer.
class GlTarget {
  public:
    GlTarget(uint32_t width, uint32_t height);
    ~GlTarget();
    GlTarget(const GlTarget&) = delete;
    GlTarget& operator=(const GlTarget&) = delete;

    [[nodiscard]] GLuint framebuffer() const { return framebuffer_; }
    [[nodiscard]] GLuint texture() const { return color_; }
    [[nodiscard]] bool isComplete() const;

  private:
    GLuint framebuffer_ = 0;
    GLuint color_ = 0;
    GLuint depth_ = 0;
};

/// A depth texture seen from the sun, compared in the sampler.
class GlShadowMap {
  public:
    explicit GlShadowMap(uint32_t size);
    ~GlShadowMap();
    GlShadowMap(const GlShadowMap&) = delete;
    GlShadowMap& operator=(const GlShadowMap&) = delete;

    [[nodiscard]] GLuint framebuffer() const { return framebuffer_; }
    [[nodiscard]] GLuint texture() const { return texture_; }
    [[nodiscard]] uint32_t size() const { return size_; }

  private:
    uint32_t size_;
    GLuint framebuffer_ = 0;
    GLuint texture_ = 0;
};

}  // namespace sherd::samples
