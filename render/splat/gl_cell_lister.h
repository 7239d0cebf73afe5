// The cells of upright grids, listed by the GPU: it is sent their numbers, and has the field, or is
// sent the values at their corners.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "render/gl/object.h"
#include "render/model/scene.h"

namespace render {

class GlCellLister {
 public:
    struct Listed {
        std::unique_ptr<gl::Buffer> pieces;  // GlCell, layer by layer, as cells are listed
        std::unique_ptr<gl::Buffer> slopes;  // CellSlopes of each, where light falls on them
        std::vector<std::uint32_t> firsts;   // of each layer, and the end
    };
    // `sides`: as GlCells has them. Throws std::runtime_error where the pieces are more than
    // mostBytes, or there is no room.
    Listed operator()(const Scene& scene, const gl::BufferTexture& sides, std::uint64_t mostBytes);
    // Whether all of the scene's field is there.
    bool holdsField(const Scene& scene) const;
    void rest();                  // gives back a field that is gone
    std::uint64_t bytes() const;  // that it keeps on the GPU

 private:
    // The candidates of all layers, and each layer's own.
    struct Asked {
        struct Part {
            std::uint32_t first, count, group;  // of the numbers; its first workgroup
            std::uint32_t firstRange, ranges;
        };
        std::vector<Part> parts;
        std::vector<std::uint32_t> numbers;
        std::vector<glm::dvec2> ranges;
        std::uint32_t groups = 0;
    };
    static Asked askedOf(const Scene& scene);
    // What shaders read of them.
    struct Given;
    Given given(const Scene& scene, const Asked& asked, std::uint64_t mostBytes);
    // Counts the pieces of each workgroup, or makes them.
    void run(const Scene& scene, const Asked& asked, const Given& given,
             const Listed* makes = nullptr);
    // Counts -> the first piece of each layer, and the end.
    std::vector<std::uint32_t> sum(const Asked& asked, const Given& given);

    void keepMore(const timeseries::Field& field, std::uint64_t bytes, std::uint64_t mostBytes);
    void makeRoom(const timeseries::Field& field);
    const gl::Program& program(const timeseries::Field& field, bool ofCorners);

    std::map<std::pair<timeseries::ValueType, bool>, gl::Program> programs_;
    std::optional<gl::Program> scan_;

    std::weak_ptr<const timeseries::Field> of_;   // of which these are:
    std::optional<gl::Buffer> values_, missing_;  // missing: a bit a point, of one that has some
    std::uint64_t sent_ = 0;                      // points
    bool hasRoom_ = true;
};

}  // namespace render
