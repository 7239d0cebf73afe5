// What the truth of a layer's opacity is of. Pure.
#pragma once

#include "render/model/scene.h"

namespace render {

// As the scene has it, also where points stand for what lies between them: they are held against
// what cells would be. Of layers that are drawn by points beside others by cells, lengths.
inline OpacityPer truthPer(const Scene& scene, const Layer& layer) {
    return layer.byPoints ? OpacityPer::Length : scene.opacityPer;
}

}  // namespace render
