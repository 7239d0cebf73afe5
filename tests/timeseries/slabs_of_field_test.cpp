// Slabs of a step's field, wherever its values come from: together all cells, once.
#include "timeseries/index/field_slabs.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/random_field.h"
#include "tests/support/step_bytes.h"
#include "tests/support/step_stores.h"

namespace timeseries {
namespace {

struct Cells {
    std::size_t first, end;
    friend bool operator==(const Cells&, const Cells&) = default;
};

// What the slab has of each point beside its cells is what the field has.
template <typename T>
void expectValuesOf(const Field& field, const FieldSlab& slab) {
    const auto& all = std::get<std::vector<T>>(field.values);
    const auto& some = std::get<std::vector<T>>(slab.values.values);
    const auto isMissing = [](const Field& of, const std::vector<T>& values, std::size_t i) {
        return values[i] != values[i] || (!of.missing.empty() && of.missing[i]);
    };
    const auto [nx, ny, nz] = slab.points;
    for (std::size_t cell = slab.firstCell; cell < slab.endCell; ++cell)
        for (const std::size_t side : {0, 1}) {
            const std::size_t z = std::clamp<std::size_t>(cell + side, 1, nz) - 1;
            for (std::size_t i = 0; i < nx * ny; ++i) {
                const std::size_t whole = z * nx * ny + i, is = slab.indexOf(i % nx, i / nx, z);
                ASSERT_LT(is, some.size());
                ASSERT_EQ(isMissing(slab.values, some, is), isMissing(field, all, whole));
                if (!isMissing(field, all, whole)) {
                    ASSERT_EQ(some[is], all[whole]) << cell << ", " << z;
                }
            }
        }
}

template <typename T>
std::vector<Cells> slabsOf(const Field& field, const SortedStep& step, std::size_t bytes) {
    std::vector<Cells> seen;
    const auto look = [&](const FieldSlab& slab) {
        EXPECT_EQ(slab.points, field.grid->size());
        expectValuesOf<T>(field, slab);
        seen.push_back({slab.firstCell, slab.endCell});
        return !testing::Test::HasFatalFailure();
    };
    forEachSlab(step, look, bytes);
    return seen;
}

// A step of a file, and the source that it was made of, which breaks off after so many reads.
struct Stored {
    Stored(const Field& of, std::size_t lasts) : field(of), left(lasts) {
        const auto never = [](const std::string& why) -> SortedStep {
            throw std::runtime_error(why);
        };
        const auto open = [this]() -> PlanesOf {
            return [this](std::size_t first, std::size_t count, Field& planes) {
                if (left == 0) return false;
                --left;
                planes = planesOf(first, count);
                return true;
            };
        };
        step = SortedStep::stored(tests::opened(tests::written(SortedStep::build(of))), of.grid,
                                  false, {never, {}, open});
    }
    Field planesOf(std::size_t first, std::size_t count) const {
        const auto size = field.grid->size();
        const auto from = static_cast<std::ptrdiff_t>(first * size[0] * size[1]),
                   to = from + static_cast<std::ptrdiff_t>(count * size[0] * size[1]);
        Field part;
        std::visit(
            [&]<typename T>(const std::vector<T>& all) {
                part.values = std::vector<T>(all.begin() + from, all.begin() + to);
            },
            field.values);
        if (!field.missing.empty())
            part.missing.assign(field.missing.begin() + from, field.missing.begin() + to);
        return part;
    }

    const Field& field;
    std::size_t left;
    std::optional<SortedStep> step;
};

template <typename T>
class FieldSlabs : public testing::Test {};
using SlabTypes = testing::Types<std::uint8_t, std::int16_t, std::uint64_t, float, double>;
TYPED_TEST_SUITE(FieldSlabs, SlabTypes);

TYPED_TEST(FieldSlabs, AreTheFieldFromMemoryFromItsSourceAndFromTheStepItself) {
    std::mt19937_64 random(4);
    for (const std::array<std::size_t, 3> size :
         {std::array<std::size_t, 3>{5, 4, 9}, {7, 1, 2}, {3, 6, 1}, {1, 1, 12}}) {
        const Field field = tests::randomField<TypeParam>(random, size, 1);
        const std::size_t plane = size[0] * size[1] * sizeof(TypeParam);
        for (const std::size_t bytes : {std::size_t{1}, plane, 3 * plane, kSlabBytes, kAllAtOnce}) {
            SCOPED_TRACE(testing::Message() << size[2] << " planes, " << bytes << " bytes");
            std::vector<Cells> wanted;
            const std::size_t each = std::max<std::size_t>(bytes / plane, 1);
            for (std::size_t at = 0; at <= size[2]; at += each)
                wanted.push_back({at, std::min(at + each, size[2] + 1)});
            const SortedStep held = SortedStep::buildWithField(field);
            EXPECT_EQ(slabsOf<TypeParam>(field, held, bytes), wanted);
            const std::size_t asked = wanted.size() > 1 ? wanted.size() : 0;
            for (const std::size_t lasts : {asked, asked / 2, std::size_t{0}}) {
                const Stored stored(field, lasts);
                EXPECT_EQ(slabsOf<TypeParam>(field, *stored.step, bytes), wanted) << lasts;
                EXPECT_EQ(stored.left, 0u);
            }
        }
    }
}

TEST(FieldSlab, AreNoMoreThanWanted) {
    std::mt19937_64 random(5);
    const Field field = tests::randomField<float>(random, {4, 4, 20}, 0);
    const Stored stored(field, 10);
    std::size_t seen = 0;
    forEachSlab(
        *stored.step, [&](const FieldSlab&) { return ++seen < 3; }, 1);
    EXPECT_EQ(seen, 3u);
    EXPECT_EQ(stored.left, 7u);
}

using SlabsInStores = step_stores::StepStores;

// While it is the one that the step was made of.
TEST_F(SlabsInStores, AreReadOfTheSourceOfAStep) {
    (void)maker()->keep(0);
    const auto step = maker()->make(0);
    ASSERT_TRUE(step->file());
    const auto planesOf = step->openPlanes();
    ASSERT_TRUE(planesOf);
    const auto whole = std::get<std::vector<float>>(step->field().values);
    Field planes;
    for (const std::size_t count : {3, 3, 5, 1}) {
        ASSERT_TRUE(planesOf(7, count, planes));
        EXPECT_TRUE(std::ranges::equal(std::get<std::vector<float>>(planes.values),
                                       std::span(whole).subspan(7 * 24 * 24, count * 24 * 24)));
    }
    step_stores::nrrdOf(file, 50);
    EXPECT_FALSE(planesOf(0, 24, planes));
    EXPECT_FALSE(step->openPlanes());
}

}  // namespace
}  // namespace timeseries
