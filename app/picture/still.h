// A picture of one step as files have it: drawn whole, read back, written with its session. The
// headless command and a window's save are this one path, so that their pictures are the same.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/choices/explorer.h"
#include "app/choices/rung.h"
#include "app/choices/session.h"
#include "app/files/dataset.h"
#include "render/frame/frame.h"

namespace app {

// Of every picture; linear.
extern const glm::dvec3 kBackground;

struct Still {
    const Explorer& explorer;  // resolved
    const timeseries::Variable& variable;
    std::size_t stepIndex;
    const timeseries::SortedStep& step;
    const render::PlacedPoints& placed;  // of the explorer's scale
    std::int64_t tick;                   // of the explorer's sweep, if it has one
    Paths paths = Paths::Both;           // that its session keeps
    // Of its first eye (depth_error.h), which stands for both, where it is known: for its file. Not
    // in sight, or it would not be the picture that its session makes once more, among others.
    std::optional<double> error = {};
    std::string errorOf = {};  // the picture that this is of, where it is another
    // What is drawn of it, where that is not all, by the chosen model.
    std::optional<Rung> rung = {};
};

// What goes into a file, or two where the stereo mode makes two.
struct DrawnStill {
    std::filesystem::path file;
    Stereo stereo;
    std::vector<render::EyePicture> eyes;
    render::Metadata metadata;
    bool mixed;            // whether the picture says that its colours are
    std::uint64_t points;  // selected by its layers; the same one twice where two have it
    bool byGl;             // who summed it: else the program
};

// `onGpu` holds the step. Throws std::runtime_error on a GL error.
DrawnStill drawStill(const Still& still, render::FrameRenderer& renderer, render::GlStep& onGpu,
                     const render::Extras& extras, const std::filesystem::path& file);
// By the file's ending; needs nothing of what drew it. Throws ImageError.
void write(DrawnStill drawn);

}  // namespace app
