#include "render/splat/gl_mesh.h"

#include <algorithm>

namespace render {
namespace {

using Point = timeseries::Mesh::Point;
constexpr GLenum kTexel = GL_RGB32UI;
constexpr std::uint64_t kTexelBytes = 3 * sizeof(std::uint32_t);
static_assert(sizeof(Point) == 2 * kTexelBytes);

}  // namespace

std::uint64_t GlMesh::bytesOf(const timeseries::Mesh& mesh) {
    return mesh.stored().points.size_bytes();
}

std::uint64_t GlMesh::mostBytes() {
    GLint texels = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    return static_cast<std::uint64_t>(std::max(texels, 0)) * kTexelBytes;
}

std::uint64_t GlMesh::upload(std::uint64_t bytes) {
    const auto points = std::as_bytes(mesh_->stored().points);
    if (!onGpu_) {
        gl::Buffer buffer(points.size());
        gl::BufferTexture texture(kTexel, buffer);
        onGpu_.emplace(OnGpu{std::move(buffer), std::move(texture)});
    }
    const auto some = points.subspan(sent_, std::min(bytes, missingBytes()));
    onGpu_->buffer.write(sent_, some.size(), some.data());
    sent_ += some.size();
    return some.size();
}

}  // namespace render
