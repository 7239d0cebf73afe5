#include "app/picture/still.h"

#include <fmt/format.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "app/choices/camera.h"
#include "app/files/picture_files.h"
#include "app/json_text.h"
#include "app/picture/depth_error.h"
#include "app/picture/picture.h"
#include "render/image/color.h"

namespace app {

const glm::dvec3 kBackground = render::linearFromSrgb8(13, 17, 23);

bool writeStill(const Still& still, render::FrameRenderer& renderer, render::GlStep& onGpu,
                const render::Extras& extras, const std::filesystem::path& file) {
    const Explorer& e = still.explorer;
    const auto views = eyes(e.view, e.stereo, still.placed.boxHalfEdges(), e.size);
    Picture picture =
        makePicture(e, still.variable, still.stepIndex, still.step, still.placed, still.tick);
    const bool mixed = isMixed(e, picture.scene);
    if (mixed) picture.legend.notes.emplace_back(kMixedColors);
    render::Metadata metadata;
    if (still.error && std::isfinite(*still.error))
        metadata[kErrorKey] = fmt::format("{:.3g}", *still.error);
    const Explorer alone = onlyThis(e, still.stepIndex, still.tick);
    auto eyePictures = renderer.render(
        {picture.scene, still.step.grid(), picture.legend, kBackground}, onGpu, views, extras);
    metadata[kSessionKey] = jsonText(toJson(alone, file.parent_path(), still.paths), -1);
    write(file, e.stereo.mode, std::move(eyePictures), metadata);
    return mixed;
}

}  // namespace app
