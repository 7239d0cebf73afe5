#include "render/splat/gl_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "render/points/block_order.h"

namespace render {
namespace {

constexpr std::uint64_t kPointBytes = sizeof(std::uint32_t) + sizeof(std::uint16_t);
constexpr std::uint64_t kValueBytes = sizeof(float);

std::vector<glm::vec2> levelTable(const PlacedPoints& placed) {
    const auto levels = placed.mesh()->stored().levels;
    if (levels.empty()) return {glm::vec2(0)};
    // Only several have heights of their own.
    const double perUnit = placed.scale().z, height = levels.size() > 1 ? std::abs(perUnit) : 0;
    std::vector<glm::vec2> table;
    for (const auto& level : levels)
        table.emplace_back(glm::dvec2(perUnit * level.at, height * level.height));
    return table;
}

std::vector<glm::vec2> axisTable(const PlacedPoints& placed) {
    if (placed.isMesh()) return levelTable(placed);
    std::vector<glm::vec2> table;
    for (int a = 0; a < 3; ++a)
        for (std::size_t i = 0; i < placed.positions()[a].size(); ++i)
            table.emplace_back(placed.positions()[a][i], placed.widths()[a][i]);
    return table;
}

constexpr std::uint64_t kMostDrawable = std::numeric_limits<GLint>::max();

std::uint64_t blockCount(std::uint64_t points) {
    return (points + GlStep::kBlock - 1) / GlStep::kBlock;
}

std::uint64_t pointsOf(std::uint64_t block, std::uint64_t points) {
    return std::min(GlStep::kBlock, points - block * GlStep::kBlock);
}

// Ascending.
std::vector<std::uint64_t> neededBlocks(const Scene& scene) {
    std::vector<bool> touched(blockCount(scene.step.size()));
    for (const Layer& layer : scene.layers)
        for (const timeseries::Run& run : layer.runs)
            for (std::uint64_t b = run.first / GlStep::kBlock;
                 b * GlStep::kBlock < run.first + run.count; ++b)
                touched[b] = true;
    std::vector<std::uint64_t> blocks;
    for (std::uint64_t b = 0; b < touched.size(); ++b)
        if (touched[b]) blocks.push_back(b);
    return blocks;
}

void extend(gl::Buffer& buffer, std::uint64_t bytes) {
    gl::Buffer larger(bytes);
    // It may be larger already, should another buffer have found no room then.
    glCopyNamedBufferSubData(buffer.id(), larger.id(), 0, 0,
                             static_cast<GLsizeiptr>(std::min(buffer.bytes(), larger.bytes())));
    buffer = std::move(larger);
}

template <typename T>
void write(gl::Buffer& buffer, std::uint64_t first, const std::vector<T>& what) {
    buffer.write(first * sizeof(T), what.size() * sizeof(T), what.data());
}

}  // namespace

GlStep::GlStep(const timeseries::SortedStep& step, const PlacedPoints& placed,
               std::shared_ptr<GlMesh> mesh)
    : slot_(blockCount(step.size()), kNowhere),
      slotPoints_(std::min(kBlock, step.size())),
      axisTable_(axisTable(placed)) {
    if (!placed.isMesh()) return;
    const bool isIts = mesh && &mesh->mesh() == placed.mesh().get();
    mesh_ = isIts ? std::move(mesh) : std::make_shared<GlMesh>(placed.mesh());
}

void GlStep::makeRoom(std::span<const std::uint64_t> blocks) {
    const std::uint64_t needed =
        taken_ + static_cast<std::uint64_t>(std::ranges::count_if(
                     blocks, [&](std::uint64_t block) { return !isThere(block); }));
    if (needed <= slots_) return;
    const std::uint64_t most = std::min<std::uint64_t>(slot_.size(), kMostDrawable / slotPoints_);
    if (needed > most)
        throw std::length_error(
            fmt::format("the {} points in and about these ranges are more than the {} that can be "
                        "drawn: choose fewer",
                        needed * slotPoints_, kMostDrawable));
    const std::uint64_t slots = std::clamp(2 * slots_, needed, most), points = slots * slotPoints_;
    if (!gridIndex_) gridIndex_.emplace(0);
    if (!placeInBlock_) placeInBlock_.emplace(0);
    extend(*gridIndex_, points * sizeof(std::uint32_t));
    extend(*placeInBlock_, (points + 1) / 2 * 2 * sizeof(std::uint16_t));  // whole words of 32 bits
    for (auto* const held : {&values_, &coming_})
        if (*held) extend((*held)->buffer, points * kValueBytes);
    slots_ = slots;
}

void GlStep::place(const PlacedPoints& placed) {
    axisTable_ = axisTable(placed);
    axisPoints_.reset();
}

const gl::BufferTexture& GlStep::axisPoints() const {
    if (!axisPoints_) {
        gl::Buffer buffer{std::span<const glm::vec2>(axisTable_)};
        gl::BufferTexture texture(GL_RG32F, buffer);
        axisPoints_.emplace(AxisPoints{std::move(buffer), std::move(texture)});
    }
    return axisPoints_->texture;
}

void GlStep::upload(const Scene& scene, const std::optional<ValueScale>& scale,
                    std::uint64_t bytes) {
    const auto blocks = neededBlocks(scene);
    makeRoom(blocks);
    ScaledValues* const values = valuesOn(scale);
    std::uint64_t sent = mesh_ ? mesh_->upload(bytes) : 0;
    for (const std::uint64_t block : blocks) {
        if (sent > 0 && sent >= bytes) break;
        sent += send(scene, block, values);
    }
    if (!coming_ || !std::ranges::all_of(blocks, [&](auto b) { return coming_->present[b]; }))
        return;
    values_.emplace(std::move(*coming_));
    coming_.reset();
}

GlStep::ScaledValues* GlStep::valuesOn(const std::optional<ValueScale>& scale) {
    if (!scale || (values_ && values_->scale == *scale)) {
        coming_.reset();
        return scale ? &*values_ : nullptr;
    }
    if (!coming_ || coming_->scale != *scale)
        coming_.emplace(
            ScaledValues{gl::Buffer(room() * kValueBytes), *scale, Blocks(slot_.size())});
    return &*coming_;
}

std::uint64_t GlStep::send(const Scene& scene, std::uint64_t block, ScaledValues* values) {
    const bool sendPoints = !isThere(block);
    const bool sendValues = values != nullptr && !values->present[block];
    if (!sendPoints && !sendValues) return 0;
    const std::uint64_t first = block * kBlock;
    const std::uint64_t count = pointsOf(block, scene.step.size());
    const timeseries::Run run{first, count};
    const timeseries::Columns columns = scene.step.columns({&run, 1});
    const auto index = columns.gridIndex.subspan(first, count);
    // Whatever the axes are stretched by: points and their values may be sent apart.
    const std::vector<std::uint16_t> places = scene.placed.isMesh()
                                                  ? blockOrder(index, *scene.placed.mesh())
                                                  : blockOrder(index, scene.placed.size());
    if (sendPoints) {
        std::vector<std::uint32_t> ordered;
        ordered.reserve(count);
        for (const std::uint16_t place : places) ordered.push_back(index[place]);
        slot_[block] = static_cast<std::uint32_t>(taken_++);
        write(*gridIndex_, placeOf(first), ordered);
        write(*placeInBlock_, placeOf(first), places);
    }
    if (sendValues) {
        std::vector<float> scaled;
        scaled.reserve(count);
        std::visit(
            [&](const auto& of) {
                for (const std::uint16_t place : places)
                    scaled.push_back(values->scale(static_cast<double>(of[first + place])));
            },
            columns.values);
        write(values->buffer, placeOf(first), scaled);
        values->present[block] = true;
    }
    return count * ((sendPoints ? kPointBytes : 0) + (sendValues ? kValueBytes : 0));
}

std::uint64_t GlStep::missingBytes(const Scene& scene,
                                   const std::optional<ValueScale>& scale) const {
    const ScaledValues* values = nullptr;
    for (const auto* held : {&values_, &coming_})
        if (*held && scale && (*held)->scale == *scale) values = &**held;
    std::uint64_t missing = mesh_ ? mesh_->missingBytes() : 0;
    for (const std::uint64_t block : neededBlocks(scene)) {
        const std::uint64_t count = pointsOf(block, scene.step.size());
        if (!isThere(block)) missing += count * kPointBytes;
        if (scale && !(values != nullptr && values->present[block])) missing += count * kValueBytes;
    }
    return missing;
}

std::uint64_t GlStep::neededBytes(const Scene& scene, const std::optional<ValueScale>& scale) {
    std::uint64_t points = 0;
    for (const std::uint64_t block : neededBlocks(scene))
        points += pointsOf(block, scene.step.size());
    return points * (kPointBytes + (scale ? kValueBytes : 0)) +
           (scene.placed.isMesh() ? GlMesh::bytesOf(*scene.placed.mesh()) : 0);
}

bool GlStep::ready(const Scene& scene) const {
    const bool byValue = neededScale(scene).has_value();
    if (mesh_ && mesh_->missingBytes() > 0) return false;
    return std::ranges::all_of(neededBlocks(scene), [&](std::uint64_t block) {
        return isThere(block) && (!byValue || (values_ && values_->present[block]));
    });
}

ValueScale GlStep::serving(const ValueScale& wanted) const {
    for (const auto* held : {&values_, &coming_})
        if (*held && (*held)->scale.serves(wanted)) return (*held)->scale;
    return wanted;
}

std::uint64_t GlStep::bytes() const {
    std::uint64_t bytes = axisTable_.size() * sizeof axisTable_[0];
    if (mesh_) bytes += mesh_->bytes() / static_cast<std::uint64_t>(mesh_.use_count());
    for (const auto* held : {&gridIndex_, &placeInBlock_})
        if (*held) bytes += (*held)->bytes();
    for (const auto* held : {&values_, &coming_})
        if (*held) bytes += (*held)->buffer.bytes();
    return bytes;
}

}  // namespace render
