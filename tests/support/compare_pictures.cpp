// compare_pictures: what the tests of the program ask of picture files. Exit code 0: it is so;
// 1: it is not, with the figures on stderr; 2: wrong usage or a file that cannot be read.
//
//   same A B [TOLERANCE]   every view and every channel, R G B A apart by at most TOLERANCE (0)
//   differ-in CHANNEL A B  some value of a further channel, in any view, is not the same
//   differ-in centre A B   some pixel of the middle ninth, where neither legend nor labels stand
//   alike-halves across|along A   left and right (or upper and lower) half are the same bit for bit
//   describe A             prints "WxH", then a line a view: its name and further channels
//   session A FILE         writes the text that A keeps under isochronSession
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "render/image/exr.h"
#include "render/image/png.h"
#include "render/reference/image_compare.h"

namespace {

using render::ExrPicture;
using render::Image;

ExrPicture read(const std::string& file) {
    if (file.ends_with(".exr")) return render::readExr(file);
    render::PngPicture png = render::readPng(file);
    return {{{"", std::move(png.image), {}}}, std::move(png.metadata)};
}

// How far the two are apart; infinite where they have not the same views and channels.
double distance(const ExrPicture& a, const ExrPicture& b) {
    if (a.views.size() != b.views.size()) return HUGE_VAL;
    double most = 0;
    for (std::size_t i = 0; i < a.views.size(); ++i) {
        const auto &x = a.views[i], &y = b.views[i];
        if (x.name != y.name || x.image.size != y.image.size ||
            x.scalars.size() != y.scalars.size())
            return HUGE_VAL;
        most = std::max(most, render::comparePictures(x.image, y.image).maxAbsolute);
        for (const auto& [name, values] : x.scalars) {
            const auto other = y.scalars.find(name);
            if (other == y.scalars.end()) return HUGE_VAL;
            const std::span<const float> tested(values), reference(other->second);
            most = std::max(most, render::compareScalars(tested, reference).maxAbsolute);
        }
    }
    return most;
}

// How far the two are apart in a further channel that both have.
double distanceIn(const std::string& channel, const ExrPicture& a, const ExrPicture& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.views.size(); ++i) {
        const std::span<const float> tested(a.views.at(i).scalars.at(channel));
        const std::span<const float> reference(b.views.at(i).scalars.at(channel));
        most = std::max(most, render::compareScalars(tested, reference).maxAbsolute);
    }
    return most;
}

double distanceInTheCentre(const Image& a, const Image& b) {
    if (a.size != b.size) throw std::runtime_error("the pictures have not one size");
    double most = 0;
    for (int y = a.size.y / 3; y < a.size.y * 2 / 3; ++y)
        for (int x = a.size.x / 3; x < a.size.x * 2 / 3; ++x)
            for (int c = 0; c < 4; ++c)
                most = std::max<double>(most, std::abs(a.at(x, y)[c] - b.at(x, y)[c]));
    return most;
}

bool alikeHalves(const Image& image, bool across) {
    const glm::ivec2 half = across ? glm::ivec2(image.size.x / 2, image.size.y)
                                   : glm::ivec2(image.size.x, image.size.y / 2);
    const glm::ivec2 shift = image.size - half;
    for (int y = 0; y < half.y; ++y)
        for (int x = 0; x < half.x; ++x)
            if (image.at(x, y) != image.at(x + (across ? shift.x : 0), y + (across ? 0 : shift.y)))
                return false;
    return true;
}

void describe(const ExrPicture& picture) {
    const glm::ivec2 size = picture.views.front().image.size;
    std::cout << size.x << 'x' << size.y << '\n';
    for (const auto& view : picture.views) {
        std::cout << "view '" << view.name << "'";
        for (const auto& [name, values] : view.scalars)
            std::cout << ' ' << name << " up to "
                      << *std::max_element(values.begin(), values.end());
        std::cout << '\n';
    }
}

int run(const std::vector<std::string>& arguments) {
    const std::string verb = arguments.at(0);
    if (verb == "same") {
        const double apart = distance(read(arguments.at(1)), read(arguments.at(2)));
        const double tolerance = arguments.size() > 3 ? std::stod(arguments[3]) : 0;
        if (apart <= tolerance) return 0;
        std::cerr << arguments[1] << " and " << arguments[2] << " are " << apart << " apart\n";
        return 1;
    }
    if (verb == "differ-in") {
        const std::string& part = arguments.at(1);
        const ExrPicture a = read(arguments.at(2)), b = read(arguments.at(3));
        const double apart = part == "centre"
                                 ? distanceInTheCentre(a.views.front().image, b.views.front().image)
                                 : distanceIn(part, a, b);
        if (apart > 0) return 0;
        std::cerr << arguments[2] << " and " << arguments[3] << " are the same in " << part << '\n';
        return 1;
    }
    if (verb == "alike-halves") {
        for (const auto& view : read(arguments.at(2)).views)
            if (!alikeHalves(view.image, arguments.at(1) == "across")) {
                std::cerr << "the halves of " << arguments[2] << " are not the same\n";
                return 1;
            }
        return 0;
    }
    if (verb == "describe") {
        describe(read(arguments.at(1)));
        return 0;
    }
    if (verb == "session") {
        std::ofstream(arguments.at(2)) << read(arguments.at(1)).metadata.at("isochronSession");
        return 0;
    }
    std::cerr << "unknown: " << verb << '\n';
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        std::cerr << "compare_pictures: " << error.what() << '\n';
        return 2;
    }
}
