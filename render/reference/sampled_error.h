// How far a picture's optical depth is from the continuous truth (interval_truth.h), told from some
// of its pixels: so soon that every picture at rest can say it.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <limits>
#include <span>
#include <vector>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/together.h"
#include "timeseries/index/field_slabs.h"

namespace render {

// The optical depth of all layers, of W as path length, that a picture has at each of these pixels;
// row 0 is at the bottom.
using DepthAt = std::function<std::vector<double>(std::span<const glm::ivec2>)>;
// Of a picture that is there: [y][x].
DepthAt depthFrom(std::vector<float> depth, glm::ivec2 size);

// Of a picture whose planes are enlarged: `coarse` has them, of a view of this size, whose pixels
// have so many of the picture's across.
DepthAt enlarged(DepthAt coarse, int across, glm::ivec2 size);

struct Sampling {
    // Half of them, or more where it is small, from what the picture shows; the others from the
    // rest of what the grid covers, where the truth may have what the picture lacks.
    std::size_t pixels = 512;
    // So many pixels tell where that is, up to 16 times as many where few of them show something.
    std::size_t asked = std::numeric_limits<std::size_t>::max();
    // Of a range that is thinner than what a pixel sees of the field, few rays would tell their own
    // error.
    int raysAcross = 8;
    unsigned threads = sharingThreads();
};

// The truth at some pixels of a scene's picture, to hold what is drawn there against. Not a bit
// depends on the threads.
class SampledTruth {
 public:
    // A quarter of a pixel's rays tells most errors as well as all do: how far its halves are apart
    // tells whether it does.
    enum class Rays { Quarter, Rest };

    // `first`: of the picture that chooses the pixels. The scene and the view must outlive this.
    // REQUIRES: layers whose `cells.ranges` are there.
    SampledTruth(const Scene& scene, const View& view, const DepthAt& first,
                 const Sampling& sampling = {});

    std::span<const glm::ivec2> pixels() const { return pixels_; }
    // For how many of the picture's pixels each stands.
    std::span<const double> weights() const { return weights_; }

    // Each slab of the scene's field, in the grid's order, once for each of the rays that are
    // asked; Quarter has all of them where these cannot be parted, as of a mesh.
    void add(const timeseries::FieldSlab& slab, Rays rays);
    // Whether the rest may change such an error by more than a fiftieth of it. REQUIRES: the
    // quarter has been added, of all slabs.
    bool wantsRest(double error) const;

    bool hasRest() const { return hasRest_ || rest_.places.empty(); }

    // Of what was added.
    std::span<const double> depth() const { return depth_; }
    // sqrt( sum w (a - b)^2 / sum w truth^2 ) of optical depths at these pixels, which are there in
    // their order; against depth() itself an error's relative L2: 0 where both are
    // nothing, infinite where the truth is nothing and the picture is not.
    double apart(std::span<const double> a, std::span<const double> b) const;

 private:
    struct Group {
        std::vector<glm::dvec2> places = {};  // of rays in a pixel
        std::vector<double> depth = {};       // [pixel], the mean of these
    };
    void choosePixels(const DepthAt& first, const Sampling& sampling);
    void choosePlaces(int across);
    void average();

    const Scene& scene_;
    const View& view_;
    int raysAcross_;
    unsigned threads_;
    std::vector<glm::ivec2> pixels_;
    std::vector<double> weights_, depth_;
    std::array<Group, 2> quarter_;  // its halves, of which one may be empty
    Group rest_;
    bool hasRest_ = false;
};

}  // namespace render
