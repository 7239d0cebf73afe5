#include "app/picture/still.h"

#include <fmt/format.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "app/choices/camera.h"
#include "app/files/dataset.h"
#include "app/files/picture_files.h"
#include "app/json_text.h"
#include "app/picture/depth_error.h"
#include "app/picture/error_text.h"
#include "app/picture/picture.h"
#include "render/image/color.h"

namespace app {

const glm::dvec3 kBackground = render::linearFromSrgb8(13, 17, 23);

DrawnStill drawStill(const Still& still, render::FrameRenderer& renderer, render::GlStep& onGpu,
                     const render::Extras& extras, const std::filesystem::path& file) {
    const Explorer& e = still.explorer;
    const auto views = eyes(e, still.placed.outline());
    const bool someOf = still.rung && still.rung->model == Model::Points;
    Picture picture = makePicture(someOf ? allBy(Model::Points, e) : e, still.variable,
                                  still.stepIndex, still.step, still.placed, still.tick);
    if (someOf) {
        picture.scene.stride = still.rung->stride;
        picture.scene.footprint = standingFor(picture.scene.footprint, still.rung->stride);
    }
    DrawnStill drawn{file, e.stereo.mode, {}, {}, isMixed(e, picture.scene), 0, false};
    for (const render::Layer& layer : picture.scene.layers)
        drawn.points += render::pointCount(layer);
    if (drawn.mixed) picture.legend.notes.emplace_back(kMixedColors);
    if (still.rung && *still.rung != Rung{modelOf(e)})
        picture.legend.notes.emplace_back("drawn by " + rungText(*still.rung));
    drawn.eyes = renderer.render({.scene = picture.scene,
                                  .grid = still.step.grid(),
                                  .legend = asDrawn(e, std::move(picture.legend)),
                                  .background = kBackground,
                                  .across = still.rung ? still.rung->across : 1},
                                 onGpu, views, extras);
    drawn.byGl = renderer.splatters().sumsByGl(picture.scene);
    if (still.error && !std::isnan(*still.error)) {
        drawn.metadata[kErrorKey] = fmt::format("{:.3g}", *still.error);
        if (!still.errorOf.empty()) drawn.metadata[kErrorOfKey] = still.errorOf;
    }
    Explorer alone = onlyThis(e, still.stepIndex, still.tick);
    alone.stepTime = timeKept(*still.variable.time, still.stepIndex);
    drawn.metadata[kSessionKey] = jsonText(toJson(alone, file.parent_path(), still.paths), -1);
    return drawn;
}

void write(DrawnStill drawn) {
    write(drawn.file, drawn.stereo, std::move(drawn.eyes), drawn.metadata);
}

}  // namespace app
