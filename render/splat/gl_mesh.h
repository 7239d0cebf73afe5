// A mesh on the GPU, as it is in memory: places and cells are worked out from it there.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "render/gl/object.h"
#include "timeseries/grid/mesh.h"

namespace render {

// One for all steps that lie on the mesh. Room is taken with the first upload(), and points come in
// slices.
class GlMesh {
 public:
    // Asks nothing of GL.
    explicit GlMesh(std::shared_ptr<const timeseries::Mesh> mesh) : mesh_(std::move(mesh)) {}
    static std::uint64_t bytesOf(const timeseries::Mesh& mesh);
    // Of the largest mesh that shaders can read here.
    static std::uint64_t mostBytes();

    const timeseries::Mesh& mesh() const { return *mesh_; }
    // Sends points until `bytes` are reached, and returns how many bytes were sent. Throws
    // std::runtime_error when the driver has no room.
    std::uint64_t upload(std::uint64_t bytes);
    std::uint64_t missingBytes() const { return bytesOf(*mesh_) - sent_; }
    std::uint64_t bytes() const { return onGpu_ ? bytesOf(*mesh_) : 0; }

    // REQUIRES: upload() was called. Two texels a point, as Mesh::Stored has it.
    const gl::BufferTexture& points() const { return onGpu_->texture; }

 private:
    struct OnGpu {
        gl::Buffer buffer;
        gl::BufferTexture texture;
    };
    std::shared_ptr<const timeseries::Mesh> mesh_;
    std::optional<OnGpu> onGpu_;
    std::uint64_t sent_ = 0;  // bytes
};

}  // namespace render
