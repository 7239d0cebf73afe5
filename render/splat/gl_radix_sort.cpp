#include "render/splat/gl_radix_sort.h"

#include <string>

#include "render/gl/compute.h"
#include "render/shader_sources.h"

namespace render {
namespace {

constexpr std::uint64_t kTile = 1 << 12;
constexpr const char* kTileDefine = "#define kTile 4096u\n";
constexpr std::uint64_t kDigitValues = 256;

void atLeast(std::optional<gl::Buffer>& buffer, std::uint64_t bytes) {
    if (!buffer || buffer->bytes() < bytes) buffer.emplace(bytes);
}

GLuint tilesOf(std::uint64_t entries) { return static_cast<GLuint>((entries + kTile - 1) / kTile); }

}  // namespace

gl::Program GlRadixSort::scatter(const char* defines) {
    return gl::Program::ofCompute("radix_scatter", shaders::radix_scatter_comp,
                                  (std::string(kTileDefine) + defines).c_str());
}

void GlRadixSort::begin(std::uint64_t count) {
    for (auto& entries : entries_) atLeast(entries, count * kEntryBytes);
    atLeast(counts_, tilesOf(count) * kDigitValues * sizeof(std::uint32_t));
    held_ = count;
    now_ = 0;
    if (count_) return;
    count_ = gl::Program::ofCompute("radix_count", shaders::radix_count_comp, kTileDefine);
    scan_ = gl::Program::ofCompute("radix_scan", shaders::radix_scan_comp);
    scatter_ = scatter("");
}

void GlRadixSort::countDigits(unsigned shift) {
    const GLuint tiles = tilesOf(held_);
    entries().bindStorage(0);
    counts_->bindStorage(1);
    glUseProgram(count_->id());
    glUniform1ui(0, static_cast<GLuint>(held_));
    glUniform1ui(1, shift);
    gl::startGroups(tiles);
    glUseProgram(scan_->id());
    glUniform1ui(0, static_cast<GLuint>(kDigitValues) * tiles);
    gl::startGroups(1);
}

void GlRadixSort::scatterBy(unsigned shift, const gl::Program& program) {
    glUseProgram(program.id());
    glUniform1ui(0, static_cast<GLuint>(held_));
    glUniform1ui(1, shift);
    gl::startGroups(tilesOf(held_));
}

void GlRadixSort::sort(unsigned shift, unsigned digits) {
    for (unsigned digit = 0; digit < digits; ++digit) {
        countDigits(shift + 8 * digit);
        entries_[1 - now_]->bindStorage(2);
        scatterBy(shift + 8 * digit, *scatter_);
        now_ = 1 - now_;
    }
}

void GlRadixSort::last(unsigned shift, const gl::Program& scatter) {
    countDigits(shift);
    scatterBy(shift, scatter);
}

void GlRadixSort::shrink() {
    if (held_ > kKept) release();
}

void GlRadixSort::release() {
    entries_ = {};
    counts_.reset();
    held_ = 0;
}

std::uint64_t GlRadixSort::bytes() const {
    std::uint64_t sum = 0;
    for (const auto* held : {&entries_[0], &entries_[1], &counts_})
        if (*held) sum += (*held)->bytes();
    return sum;
}

}  // namespace render
