// Points of a mesh that a picture draws, one after another. In the mesh they lie anywhere, and are
// waited for; the next picture mostly draws the same ones from another place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "timeseries/grid/mesh.h"
#include "timeseries/grid/pages.h"

namespace render {

class DrawnPoints {
 public:
    // Before so many points of a picture, at most: what is known of another mesh is forgotten.
    void begin(const std::shared_ptr<const timeseries::Mesh>& mesh, std::size_t count);
    // The picture's from `first` on, which are the mesh's of these indices, as it keeps them: taken
    // from there where others were last in these places. Several threads may ask at once, each for
    // places of its own. The mesh must be alive.
    std::span<const timeseries::Mesh::Point> of(std::size_t first,
                                                std::span<const std::uint32_t> gridIndex);

 private:
    std::weak_ptr<const timeseries::Mesh> mesh_;
    timeseries::Mesh::Stored stored_{};
    bool isMore_ = false;  // than indices can tell from none
    timeseries::LargeVector<std::uint32_t> gridIndex_;
    timeseries::LargeVector<timeseries::Mesh::Point> points_;
};

}  // namespace render
