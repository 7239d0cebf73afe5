#include "render/splat/gl_cell_lister.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>

#include "render/gl/compute.h"
#include "render/gl/debug_output.h"
#include "render/shader_sources.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/cell_view.h"
#include "render/splat/gl_cells.h"
#include "render/together.h"

namespace render {
namespace {

// GLSL mirror: Cells in shaders/cell_pieces.comp.
struct CellsBlock {
    glm::uvec4 points, clipLo, clipHi;
    double unitLength, steep, steepest, unused = 0;
};
constexpr std::uint32_t kSomeMissing = 1, kPerCrossing = 2, kLit = 4;

constexpr std::uint32_t kGroup = 256;  // cells
constexpr std::size_t kCorners = 8;

std::string definesOf(const timeseries::Field& field, bool ofCorners) {
    if (ofCorners) return "#define BYTES 8\n#define REAL\n#define CORNERS\n";
    return std::visit(
        [](const auto& values) {
            using T = typename std::decay_t<decltype(values)>::value_type;
            return fmt::format("#define BYTES {}\n{}{}", sizeof(T),
                               std::is_floating_point_v<T> ? "#define REAL\n" : "",
                               std::is_signed_v<T> ? "#define SIGNED\n" : "");
        },
        field.values);
}

CellsBlock blockOf(const Scene& scene) {
    const timeseries::Field& field = scene.cells->field();
    CellsBlock b{};
    b.points = {scene.cells->size() - 1u,
                (field.missing.empty() ? 0 : kSomeMissing) |
                    (scene.opacityPer == OpacityPer::Crossing ? kPerCrossing : 0) |
                    (scene.light == Light::Off ? 0 : kLit)};
    b.clipLo = {scene.clip.lo, 0};
    b.clipHi = {scene.clip.hi, 0};
    b.unitLength = scene.placed.unitLength();
    b.steep = steepnessOf(scene);
    b.steepest = kSteepest;
    return b;
}

// As the shader has it: below 0 where a colour is no map's.
glm::dvec2 mapOf(const RangeStyle& style) {
    const auto* map = std::get_if<ByValue>(&style.color);
    if (map == nullptr) return {0, -1};
    return {map->lo, std::max(map->halfWidth(), 0.0)};
}

// What `of` says of each of these cells.
template <typename Of>
auto ofEach(const timeseries::CellIndex& cells, std::span<const std::uint32_t> numbers,
            const Of& of) {
    constexpr std::size_t kWorthAThread = 1 << 12, kAhead = 16;
    std::vector<decltype(of(numbers[0]))> out(numbers.size());
    const unsigned shared = threadsFor(out.size(), kWorthAThread, sharingThreads());
    sharing(shared, [&](unsigned k) {
        const std::size_t end = out.size() * (k + 1) / shared;
        for (std::size_t i = out.size() * k / shared; i < end; ++i) {
            if (i + kAhead < end) cells.prefetch(numbers[i + kAhead]);
            out[i] = of(numbers[i]);
        }
    });
    return out;
}
using Corners = std::array<double, kCorners>;
gl::Buffer cornersOf(const timeseries::CellIndex& cells, std::span<const std::uint32_t> numbers) {
    return gl::Buffer(
        std::span<const Corners>(ofEach(cells, numbers, [&](std::uint32_t number) -> Corners {
            return cells.cornersOf().values(timeseries::indicesOf(number, cells.size()));
        })));
}
gl::Buffer cornerSlopesOf(const Scene& scene, std::span<const std::uint32_t> numbers) {
    const PointSlopes points(scene);
    return gl::Buffer(std::span<const CellSlopes>(
        ofEach(*scene.cells, numbers, [&](std::uint32_t number) -> CellSlopes {
            const ValuedCell cell = seenOctants(scene, number).cell;
            const auto [least, greatest] = std::ranges::minmax(cell.corners);
            return points.atCorners(timeseries::indicesOf(number, scene.cells->size()),
                                    cell.to - cell.from, 0.5 * greatest - 0.5 * least);
        })));
}

}  // namespace

struct GlCellLister::Given {
    const gl::Program* program;
    gl::Buffer cells, numbers, ranges, starts;
    std::optional<gl::Buffer> corners, cornerSlopes;  // where the field is not there
    const gl::Buffer *values, *missing;
};

bool GlCellLister::holdsField(const Scene& scene) const {
    return values_ && of_.lock() == scene.cells->sharedField() &&
           sent_ == scene.cells->field().grid->count();
}

void GlCellLister::rest() {
    if (!of_.expired()) return;
    values_.reset();
    missing_.reset();
}

std::uint64_t GlCellLister::bytes() const {
    std::uint64_t sum = 0;
    for (const auto* held : {&values_, &missing_})
        if (*held) sum += (*held)->bytes();
    return sum;
}

const gl::Program& GlCellLister::program(const timeseries::Field& field, bool ofCorners) {
    const std::pair key(ofCorners ? timeseries::ValueType::F64 : field.type(), ofCorners);
    if (const auto found = programs_.find(key); found != programs_.end()) return found->second;
    const std::string source = std::string(shaders::grid_indices_glsl) + shaders::cell_piece_glsl +
                               shaders::cell_pieces_comp;
    return programs_
        .emplace(key, gl::Program::ofCompute("cell_pieces", source.c_str(),
                                             definesOf(field, ofCorners).c_str()))
        .first->second;
}

void GlCellLister::makeRoom(const timeseries::Field& field) {
    // Words, of which the last may be part empty.
    const auto wordsOf = [](std::uint64_t bytes) { return (bytes + 3) / 4 * 4; };
    const std::uint64_t points = field.grid->count();
    const std::size_t each =
        std::visit([](const auto& values) { return sizeof values[0]; }, field.values);
    if (!field.missing.empty()) missing_.emplace(wordsOf((points + 7) / 8));
    values_.emplace(wordsOf(points * each));
}

// So many bytes more of the field, but no more at once than a frame has time for.
void GlCellLister::keepMore(const timeseries::Field& field, std::uint64_t bytes,
                            std::uint64_t mostBytes) {
    constexpr std::uint64_t kAtOnce = std::uint64_t{64} << 20, kBits = 32;  // of a word
    if (field.bytes() > mostBytes || !hasRoom_) return;
    try {
        if (!values_) makeRoom(field);
    } catch (const std::runtime_error&) {  // corners may yet have some
        gl::forgetErrors();
        missing_.reset();
        hasRoom_ = false;
        return;
    }
    std::visit(
        [&](const auto& values) {
            const std::size_t each = sizeof values[0];
            const std::uint64_t more = (std::min(bytes, kAtOnce) / each / kBits + 1) * kBits;
            const std::uint64_t end = std::min<std::uint64_t>(sent_ + more, values.size());
            values_->write(sent_ * each, (end - sent_) * each, values.data() + sent_);
            if (missing_) {
                std::vector<std::uint32_t> bits((end - sent_ + kBits - 1) / kBits);
                for (std::uint64_t i = sent_; i < end; ++i)
                    if (field.missing[i]) bits[(i - sent_) / kBits] |= 1u << i % kBits;
                missing_->write(sent_ / 8, bits.size() * sizeof bits[0], bits.data());
            }
            sent_ = end;
        },
        field.values);
}

GlCellLister::Asked GlCellLister::askedOf(const Scene& scene) {
    Asked asked;
    asked.numbers.reserve(cellCount(scene, Channels::Over, 0));
    for (const Layer& layer : scene.layers) {
        const auto first = static_cast<std::uint32_t>(asked.numbers.size());
        for (const timeseries::Run& run : layer.cells.candidates)
            for (std::uint64_t i = 0; i < run.count; ++i)
                asked.numbers.push_back(scene.cells->cell(run.first + i));
        const auto count = static_cast<std::uint32_t>(asked.numbers.size()) - first;
        asked.parts.push_back({first, count, asked.groups,
                               static_cast<std::uint32_t>(asked.ranges.size()),
                               static_cast<std::uint32_t>(layer.cells.ranges.size())});
        asked.groups += (count + kGroup - 1) / kGroup;
        for (const auto& range : layer.cells.ranges) asked.ranges.emplace_back(range.lo, range.hi);
    }
    return asked;
}

// Each time as many bytes of the field are sent as the corners of the cells are, or what values
// change there: it hardly ever costs more than twice what the better of the two does.
GlCellLister::Given GlCellLister::given(const Scene& scene, const Asked& asked,
                                        std::uint64_t mostBytes) {
    const std::shared_ptr<const timeseries::Field>& field = scene.cells->sharedField();
    if (of_.lock() != field) {
        of_ = field;
        values_.reset();
        missing_.reset();
        sent_ = 0;
        hasRoom_ = true;
    }
    const std::uint64_t sent =
        asked.numbers.size() *
        std::max(sizeof(Corners), scene.light == Light::Off ? 0 : sizeof(CellSlopes));
    if (!holdsField(scene)) keepMore(*field, sent, mostBytes);
    const bool isThere = holdsField(scene);
    const CellsBlock block = blockOf(scene);
    Given given{
        &program(*field, !isThere),
        gl::Buffer(sizeof block, &block),
        gl::Buffer(std::span<const std::uint32_t>(asked.numbers)),
        gl::Buffer(std::span<const glm::dvec2>(asked.ranges)),
        gl::Buffer(std::span<const std::uint32_t>(std::vector<std::uint32_t>(asked.groups + 1))),
        {},
        {},
        isThere ? &*values_ : nullptr,
        isThere && missing_ ? &*missing_ : nullptr};
    if (isThere) return given;
    if (sent > mostBytes) throw std::runtime_error(kTooManyPieces);
    given.corners.emplace(cornersOf(*scene.cells, asked.numbers));
    if (scene.light != Light::Off) given.cornerSlopes.emplace(cornerSlopesOf(scene, asked.numbers));
    return given;
}

void GlCellLister::run(const Scene& scene, const Asked& asked, const Given& given,
                       const Listed* makes) {
    glUseProgram(given.program->id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, given.cells.id());
    given.numbers.bindStorage(0);
    (given.corners ? *given.corners : *given.values).bindStorage(1);
    (given.missing ? *given.missing : given.numbers).bindStorage(2);
    given.ranges.bindStorage(3);
    given.starts.bindStorage(4);
    (makes ? *makes->pieces : given.starts).bindStorage(5);
    (given.cornerSlopes ? *given.cornerSlopes : given.numbers).bindStorage(6);
    (makes && makes->slopes ? *makes->slopes : given.starts).bindStorage(7);
    glUniform1i(3, makes ? 1 : 0);
    for (std::size_t k = 0; k < asked.parts.size(); ++k) {
        const Asked::Part& part = asked.parts[k];
        const glm::dvec2 map = mapOf(scene.layers[k].style);
        glUniform4ui(0, part.first, part.count, part.group, static_cast<GLuint>(k));
        glUniform2ui(1, part.firstRange, part.ranges);
        glUniform2dv(2, 1, &map.x);
        gl::startFor(part.count);
    }
}

std::vector<std::uint32_t> GlCellLister::sum(const Asked& asked, const Given& given) {
    if (!scan_) scan_ = gl::Program::ofCompute("radix_scan", shaders::radix_scan_comp);
    glUseProgram(scan_->id());
    glUniform1ui(0, asked.groups + 1);
    given.starts.bindStorage(1);
    gl::startGroups(1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<std::uint32_t> starts(asked.groups + 1), firsts;
    glGetNamedBufferSubData(given.starts.id(), 0,
                            static_cast<GLsizeiptr>(starts.size() * sizeof starts[0]),
                            starts.data());
    for (const Asked::Part& part : asked.parts) firsts.push_back(starts[part.group]);
    firsts.push_back(starts.back());
    return firsts;
}

GlCellLister::Listed GlCellLister::operator()(const Scene& scene, const gl::BufferTexture& sides,
                                              std::uint64_t mostBytes) {
    const Asked asked = askedOf(scene);
    const Given given = this->given(scene, asked, mostBytes);
    glBindTextureUnit(0, sides.id());
    run(scene, asked, given);
    Listed listed{nullptr, nullptr, sum(asked, given)};
    const std::uint64_t count = listed.firsts.back();
    if (count * GlCells::bytesOfOne(scene) > mostBytes) throw std::runtime_error(kTooManyPieces);
    listed.pieces = std::make_unique<gl::Buffer>(count * sizeof(GlCell));
    if (scene.light != Light::Off)
        listed.slopes = std::make_unique<gl::Buffer>(count * sizeof(CellSlopes));
    run(scene, asked, given, &listed);
    return listed;
}

}  // namespace render
