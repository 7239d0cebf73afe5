#include "app/files/picture_files.h"

#include <array>

#include "render/image/exr.h"
#include "render/image/picture_file.h"
#include "render/image/png.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using render::EyePicture;

render::ExrView exrView(std::string name, EyePicture picture) {
    render::ExrView view{std::move(name), std::move(picture.image), {}};
    if (!picture.opticalDepth.empty())
        view.scalars["opticalDepth"] = std::move(picture.opticalDepth);
    if (!picture.splatCount.empty()) view.scalars["splatCount"] = std::move(picture.splatCount);
    return view;
}

void writeOne(const fs::path& file, EyePicture picture, const render::Metadata& metadata) {
    if (render::isExr(file)) {
        const std::array views{exrView("", std::move(picture))};
        render::writeExr(file, views, metadata);
    } else {
        render::writePng(file, picture.image, metadata);
    }
}

}  // namespace

std::vector<fs::path> filesOf(const fs::path& file, Stereo stereo) {
    if (stereo != Stereo::LeftRight) return {file};
    const auto suffixed = [&](const char* suffix) {
        return fs::path(file).replace_filename(file.stem().string() + suffix +
                                               file.extension().string());
    };
    return {suffixed("_left"), suffixed("_right")};
}

void write(const fs::path& file, Stereo stereo, std::vector<EyePicture> eyes,
           const render::Metadata& metadata) {
    switch (stereo) {
        case Stereo::Off:
            return writeOne(file, std::move(eyes[0]), metadata);
        case Stereo::SideBySide:
            return writeOne(file, {render::sideBySide(eyes[0].image, eyes[1].image), {}, {}},
                            metadata);
        case Stereo::TopBottom:
            return writeOne(file, {render::topBottom(eyes[0].image, eyes[1].image), {}, {}},
                            metadata);
        case Stereo::LeftRight:
            writeOne(filesOf(file, stereo)[0], std::move(eyes[0]), metadata);
            return writeOne(filesOf(file, stereo)[1], std::move(eyes[1]), metadata);
        case Stereo::MultiView: {
            const std::array views{exrView("left", std::move(eyes[0])),
                                   exrView("right", std::move(eyes[1]))};
            return render::writeExr(file, views, metadata);
        }
    }
}

}  // namespace app
