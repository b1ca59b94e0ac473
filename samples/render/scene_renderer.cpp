// SPDX-License-Identifier: MIT
#include "scene_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "gl_objects.h"
#include "shaders.h"

namespace sherd::samples {
namespace {

/// OpenGL takes offsets into a bound buffer as pointers.
const void* bufferOffset(size_t bytes) {
    return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr)
}

}  // namespace

glm::mat4 viewProjection(const SceneFrame& frame, float aspect) {
    const float distance = glm::distance(frame.eye, frame.focus);
    return glm::perspective(glm::radians(frame.fieldOfView), aspect, 0.02F * distance,
                            40 * distance) *
           glm::lookAt(frame.eye, frame.target, {0, 1, 0});
}

class SceneRenderer::Impl {
  public:
    Impl(const RendererOptions& options, GlProgram surface, GlProgram shadow, GlProgram sky,
         GlProgram smooth)
        : surface_(std::move(surface)),
          shadow_(std::move(shadow)),
          sky_(std::move(sky)),
          smooth_(std::move(smooth)),
          target_(options.width * options.samples, options.height * options.samples),
          smoothed_(options.width, options.height),
          shadowMap_(options.shadowSize),
          samples_(options.samples),
          width_(options.width * options.samples),
          height_(options.height * options.samples) {
        glGenVertexArrays(1, &noVertices_);
        const std::array<uint8_t, 3> white{255, 255, 255};
        whiteTexture_ = upload(1, 1, white.data());
        const std::array<RenderVertex, 4> corners{{{{-1, 0, -1}, {0, 1, 0}, {0, 0}},
                                                   {{-1, 0, 1}, {0, 1, 0}, {0, 1}},
                                                   {{1, 0, 1}, {0, 1, 0}, {1, 1}},
                                                   {{1, 0, -1}, {0, 1, 0}, {1, 0}}}};
        const std::array<uint32_t, 6> indices{0, 1, 2, 0, 2, 3};
        floor_ = addMesh(corners, indices);
    }

    ~Impl() {
        for (const GpuMesh& mesh : meshes_) {
            glDeleteVertexArrays(1, &mesh.vertexArray);
            glDeleteBuffers(1, &mesh.vertices);
            glDeleteBuffers(1, &mesh.indices);
        }
        glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
        glDeleteTextures(1, &whiteTexture_);
        glDeleteVertexArrays(1, &noVertices_);
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    [[nodiscard]] bool isComplete() const { return target_.isComplete() && smoothed_.isComplete(); }

    uint32_t addMesh(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices) {
        GpuMesh mesh;
        glGenVertexArrays(1, &mesh.vertexArray);
        glBindVertexArray(mesh.vertexArray);
        glGenBuffers(1, &mesh.vertices);
        glBindBuffer(GL_ARRAY_BUFFER, mesh.vertices);
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()),
                     vertices.data(), GL_STATIC_DRAW);
        glGenBuffers(1, &mesh.indices);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.indices);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size_bytes()),
                     indices.data(), GL_STATIC_DRAW);
        constexpr GLsizei kStride = sizeof(RenderVertex);
        const auto attribute = [](GLuint location, GLint components, size_t offset) {
            glEnableVertexAttribArray(location);
            glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, kStride,
                                  bufferOffset(offset));
        };
        attribute(0, 3, offsetof(RenderVertex, position));
        attribute(1, 3, offsetof(RenderVertex, normal));
        attribute(2, 2, offsetof(RenderVertex, uv));
        meshes_.push_back(mesh);
        return static_cast<uint32_t>(meshes_.size() - 1);
    }

    int32_t addTexture(const Picture& picture) {
        textures_.push_back(upload(picture.width, picture.height, picture.pixels.data()));
        return static_cast<int32_t>(textures_.size() - 1);
    }

    uint32_t addMaterial(const RenderMaterial& material) {
        materials_.push_back(material);
        return static_cast<uint32_t>(materials_.size() - 1);
    }

    Picture render(const SceneFrame& frame) {
        const glm::mat4 shadow = shadowMatrix(frame);
        glEnable(GL_DEPTH_TEST);
        drawShadows(frame, shadow);
        drawPicture(frame, shadow);
        if (samples_ > 1) return shrink(readBack(target_), width_ / samples_);
        smoothEdges();
        return readBack(smoothed_);
    }

  private:
    struct GpuMesh {
        GLuint vertexArray = 0;
        GLuint vertices = 0;
        GLuint indices = 0;
    };

    static GLuint upload(uint32_t width, uint32_t height, const uint8_t* pixels) {
        GLuint texture = 0;
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8, static_cast<GLsizei>(width),
                     static_cast<GLsizei>(height), 0, GL_RGB, GL_UNSIGNED_BYTE, pixels);
        glGenerateMipmap(GL_TEXTURE_2D);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        return texture;
    }

    static glm::mat4 shadowMatrix(const SceneFrame& frame) {
        const float r = frame.focusRadius;
        const glm::vec3 eye = frame.focus + glm::normalize(frame.sun) * (2 * r);
        return glm::ortho(-r, r, -r, r, 0.1F * r, 4 * r) * glm::lookAt(eye, frame.focus, {0, 1, 0});
    }

    void drawItems(const GlProgram& program, const SceneFrame& frame) const {
        for (const DrawItem& item : frame.items) {
            program.set("uModel", item.model);
            glBindVertexArray(meshes_[item.mesh].vertexArray);
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(item.indexCount), GL_UNSIGNED_INT,
                           bufferOffset(size_t{item.firstIndex} * sizeof(uint32_t)));
        }
    }

    void drawShadows(const SceneFrame& frame, const glm::mat4& shadow) const {
        const auto size = static_cast<GLsizei>(shadowMap_.size());
        glBindFramebuffer(GL_FRAMEBUFFER, shadowMap_.framebuffer());
        glViewport(0, 0, size, size);
        glClear(GL_DEPTH_BUFFER_BIT);
        shadow_.use();
        shadow_.set("uShadow", shadow);
        drawItems(shadow_, frame);
    }

    void drawPicture(const SceneFrame& frame, const glm::mat4& shadow) const {
        const glm::mat4 camera = viewProjection(frame, float(width_) / float(height_));
        glBindFramebuffer(GL_FRAMEBUFFER, target_.framebuffer());
        glViewport(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_));
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        drawSky(frame, camera);
        surface_.use();
        surface_.set("uViewProjection", camera);
        surface_.set("uShadow", shadow);
        surface_.set("uEye", frame.eye);
        surface_.set("uSun", glm::normalize(frame.sun));
        surface_.set("uFocus", frame.focus);
        surface_.set("uGridSize", frame.gridSize);
        surface_.set("uTexture", 0);
        surface_.set("uShadowMap", 1);
        glActiveTexture(GL_TEXTURE1);
        glBindTexture(GL_TEXTURE_2D, shadowMap_.texture());
        glActiveTexture(GL_TEXTURE0);
        drawSurfaces(frame);
        if (frame.floor) drawFloor(frame, 7 * glm::distance(frame.eye, frame.focus));
    }

    void drawSky(const SceneFrame& frame, const glm::mat4& camera) const {
        glDisable(GL_DEPTH_TEST);
        sky_.use();
        sky_.set("uInverseViewProjection", glm::inverse(camera));
        sky_.set("uEye", frame.eye);
        glBindVertexArray(noVertices_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glEnable(GL_DEPTH_TEST);
    }

    void drawSurfaces(const SceneFrame& frame) const {
        surface_.set("uGround", 0.0F);
        for (const DrawItem& item : frame.items) {
            const RenderMaterial& material = materials_[item.material];
            surface_.set("uModel", item.model);
            surface_.set("uColor", material.color);
            surface_.set("uRoughness", material.roughness);
            surface_.set("uMetallic", material.metallic);
            surface_.set("uGrain", material.grain);
            surface_.set("uTextured", material.texture >= 0 ? 1.0F : 0.0F);
            glBindTexture(GL_TEXTURE_2D, material.texture >= 0
                                             ? textures_[static_cast<size_t>(material.texture)]
                                             : whiteTexture_);
            glBindVertexArray(meshes_[item.mesh].vertexArray);
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(item.indexCount), GL_UNSIGNED_INT,
                           bufferOffset(size_t{item.firstIndex} * sizeof(uint32_t)));
        }
    }

    void drawFloor(const SceneFrame& frame, float radius) const {
        const glm::mat4 model =
            glm::scale(glm::translate(glm::mat4(1.0F), {frame.focus.x, 0.0F, frame.focus.z}),
                       glm::vec3(radius, 1, radius));
        surface_.set("uGround", 1.0F);
        surface_.set("uModel", model);
        surface_.set("uFadeRadius", radius);
        surface_.set("uRoughness", 0.75F);
        surface_.set("uMetallic", 0.0F);
        surface_.set("uGrain", 0.0F);
        surface_.set("uTextured", 0.0F);
        glBindTexture(GL_TEXTURE_2D, whiteTexture_);
        glBindVertexArray(meshes_[floor_].vertexArray);
        glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT, nullptr);
    }

    void smoothEdges() const {
        glBindFramebuffer(GL_FRAMEBUFFER, smoothed_.framebuffer());
        glDisable(GL_DEPTH_TEST);
        smooth_.use();
        smooth_.set("uPicture", 0);
        glBindTexture(GL_TEXTURE_2D, target_.texture());
        glBindVertexArray(noVertices_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }

    [[nodiscard]] Picture readBack(const GlTarget& from) const {
        const auto w = static_cast<GLint>(width_);
        const auto h = static_cast<GLint>(height_);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer());
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        const size_t row = size_t{3} * width_;
        std::vector<uint8_t> upsideDown(row * height_);
        glReadPixels(0, 0, w, h, GL_RGB, GL_UNSIGNED_BYTE, upsideDown.data());
        Picture picture{width_, height_, std::vector<uint8_t>(upsideDown.size())};
        for (uint32_t y = 0; y < height_; ++y) {
            std::copy_n(&upsideDown[row * (height_ - 1 - y)], row, &picture.pixels[row * y]);
        }
        return picture;
    }

    GlProgram surface_, shadow_, sky_, smooth_;
    GlTarget target_, smoothed_;
    GlShadowMap shadowMap_;
    uint32_t samples_;
    uint32_t width_, height_;  ///< in samples
    GLuint noVertices_ = 0;
    GLuint whiteTexture_ = 0;
    uint32_t floor_ = 0;
    std::vector<GpuMesh> meshes_;
    std::vector<GLuint> textures_;
    std::vector<RenderMaterial> materials_;
};

Result<std::unique_ptr<SceneRenderer>> SceneRenderer::create(const RendererOptions& options) {
    Result<GlProgram> surface = GlProgram::build(kSurfaceVertexShader, kSurfaceFragmentShader);
    if (!surface) return tl::unexpected(surface.error());
    Result<GlProgram> shadow = GlProgram::build(kShadowVertexShader, kShadowFragmentShader);
    if (!shadow) return tl::unexpected(shadow.error());
    Result<GlProgram> sky = GlProgram::build(kSkyVertexShader, kSkyFragmentShader);
    if (!sky) return tl::unexpected(sky.error());
    Result<GlProgram> smooth = GlProgram::build(kScreenVertexShader, kSmoothFragmentShader);
    if (!smooth) return tl::unexpected(smooth.error());
    auto impl = std::make_unique<Impl>(options, std::move(*surface), std::move(*shadow),
                                       std::move(*sky), std::move(*smooth));
    if (!impl->isComplete())
        return fail(ErrorCode::unsupported, "OpenGL refuses a framebuffer of this size");
    return std::unique_ptr<SceneRenderer>(new SceneRenderer(std::move(impl)));
}

SceneRenderer::SceneRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SceneRenderer::~SceneRenderer() = default;

uint32_t SceneRenderer::addMesh(std::span<const RenderVertex> vertices,
                                std::span<const uint32_t> indices) {
    return impl_->addMesh(vertices, indices);
}

int32_t SceneRenderer::addTexture(const Picture& picture) {
    return impl_->addTexture(picture);
}

uint32_t SceneRenderer::addMaterial(const RenderMaterial& material) {
    return impl_->addMaterial(material);
}

Picture SceneRenderer::render(const SceneFrame& frame) {
    return impl_->render(frame);
}

}  // namespace sherd::samples
