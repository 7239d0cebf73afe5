#include "app/desktop/probe.h"

#include "app/picture.h"
#include "render/pick.h"

namespace app::desktop {

std::optional<panels::Reading> probe(const Shown& shown, const render::Lattice& lattice,
                                     const render::View& eye, glm::vec2 at) {
    const Picture picture = makePicture(shown.explorer, shown.dataset.about, shown.step,
                                        *shown.sorted, lattice, shown.explorer.play.tick);
    const glm::dvec2 window(static_cast<double>(at.x) + 0.5,
                            static_cast<double>(eye.size.y) - static_cast<double>(at.y) - 0.5);
    const auto picked = render::pick(picture.scene, eye, window);
    if (!picked) return std::nullopt;
    const timeseries::Grid& grid = shown.sorted->grid();
    const auto size = grid.size();
    const std::uint64_t i = picked->gridIndex;
    return panels::Reading{.gridIndex = i,
                           .index = {i % size[0], i / size[0] % size[1], i / size[0] / size[1]},
                           .value = shown.sorted->value(picked->point),
                           .position = grid.position(i),
                           .world = picked->world,
                           .step = shown.step};
}

}  // namespace app::desktop
