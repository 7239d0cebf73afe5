// PNG: 8-bit sRGB pictures for people. Measure on EXR files, not on these.
#pragma once

#include <filesystem>

#include "render/image/image.h"

namespace render {

// Opaque pictures become RGB, others RGBA with straight alpha. Light is clamped to [0, 1] (NaN is
// 0), encoded and rounded to the nearest of 256 steps, without dithering: the same picture gives
// the same bytes. Straight alpha cannot say "light without cover": colour where alpha is 0 is not
// seen again. Metadata go into uncompressed iTXt chunks, so that text tools find them. REQUIRES: a
// size >= 1. Throws ImageError; the old file is then untouched.
void writePng(const std::filesystem::path&, const Image&, const Metadata& = {});

struct PngPicture {
    Image image;
    Metadata metadata;  // tEXt, zTXt and iTXt chunks; of equal keys the first
};

// Any PNG, taken as sRGB whatever colour chunks it carries. Throws ImageError.
PngPicture readPng(const std::filesystem::path&);

}  // namespace render
