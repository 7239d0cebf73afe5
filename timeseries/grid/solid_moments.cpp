#include "timeseries/grid/solid_moments.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "timeseries/grid/solid_moments.cpp"
#include <hwy/foreach_target.h>  // the first of these
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace timeseries {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using D = hn::Vec<Doubles>;

HWY_INLINE D d(double x) { return hn::Set(Doubles(), x); }

struct Place {
    D x, y, z;
};
HWY_INLINE Place operator+(const Place& a, const Place& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Place operator-(const Place& a, const Place& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Place operator*(const Place& a, D by) {
    return {hn::Mul(a.x, by), hn::Mul(a.y, by), hn::Mul(a.z, by)};
}

// Of tetrahedra that share the corner 0: 6 times the volume V, 24 times the integral of x and 120
// times that of x x^T. Of one, with s the sum of its corners v, the latter two are V s / 4 and
// V (sum v v^T + s s^T) / 20.
struct Integrals {
    D volume, first[3], second[6];
};

HWY_INLINE void addSquare(const Place& v, D* squares) {
    squares[0] = hn::MulAdd(v.x, v.x, squares[0]);
    squares[1] = hn::MulAdd(v.x, v.y, squares[1]);
    squares[2] = hn::MulAdd(v.x, v.z, squares[2]);
    squares[3] = hn::MulAdd(v.y, v.y, squares[3]);
    squares[4] = hn::MulAdd(v.y, v.z, squares[4]);
    squares[5] = hn::MulAdd(v.z, v.z, squares[5]);
}

HWY_INLINE void addTetrahedron(const Place& a, const Place& b, const Place& c, Integrals& sum) {
    const D x = hn::NegMulAdd(b.z, c.y, hn::Mul(b.y, c.z)),
            y = hn::NegMulAdd(b.x, c.z, hn::Mul(b.z, c.x)),
            z = hn::NegMulAdd(b.y, c.x, hn::Mul(b.x, c.y));
    const D volume = hn::MulAdd(a.x, x, hn::MulAdd(a.y, y, hn::Mul(a.z, z)));
    const Place s = a + b + c;
    D squares[6] = {d(0), d(0), d(0), d(0), d(0), d(0)};
    for (const Place& v : {a, b, c, s}) addSquare(v, squares);
    sum.volume = hn::Add(sum.volume, volume);
    sum.first[0] = hn::MulAdd(volume, s.x, sum.first[0]);
    sum.first[1] = hn::MulAdd(volume, s.y, sum.first[1]);
    sum.first[2] = hn::MulAdd(volume, s.z, sum.first[2]);
    for (int i = 0; i < 6; ++i) sum.second[i] = hn::MulAdd(volume, squares[i], sum.second[i]);
}

// What a face of so many corners and the origin span: to one side positive.
HWY_INLINE void addFace(const Place* corners, const std::uint8_t* face, std::size_t size,
                        Integrals& sum) {
    if (size == 3) return addTetrahedron(corners[face[0]], corners[face[1]], corners[face[2]], sum);
    Place middle = corners[face[0]];
    for (std::size_t i = 1; i < size; ++i) middle = middle + corners[face[i]];
    middle = middle * d(1 / static_cast<double>(size));
    for (std::size_t i = 0; i < size; ++i)
        addTetrahedron(middle, corners[face[i]], corners[face[i + 1 == size ? 0 : i + 1]], sum);
}

HWY_INLINE void measureFrom(const CellType& type, std::size_t begin, SolidColumns& solids) {
    const Doubles lanes;
    const D none = d(0);
    Place corners[SolidColumns::kMostCorners], apex{none, none, none};
    for (std::size_t i = 0; i < type.corners; ++i) {
        const auto& rows = solids.corners[i];
        corners[i] = {hn::Load(lanes, rows[0] + begin), hn::Load(lanes, rows[1] + begin),
                      hn::Load(lanes, rows[2] + begin)};
        apex = apex + corners[i];
    }
    apex = apex * d(1.0 / type.corners);
    for (std::size_t i = 0; i < type.corners; ++i) corners[i] = corners[i] - apex;
    Integrals sum{none, {none, none, none}, {none, none, none, none, none, none}};
    const std::uint8_t* face = type.faces.data();
    for (const std::uint8_t size : type.faceSizes) {
        addFace(corners, face, size, sum);
        face += size;
    }
    const D volume = hn::Mul(hn::Abs(sum.volume), d(1.0 / 6));
    const auto isSolid = hn::And(hn::Gt(volume, d(0)), hn::IsFinite(volume));
    hn::Store(hn::IfThenElseZero(isSolid, volume), lanes, solids.volume + begin);
    const D middle[3] = {apex.x, apex.y, apex.z};
    D mean[3];
    for (int c = 0; c < 3; ++c) {
        mean[c] = hn::Div(sum.first[c], hn::Mul(d(4), sum.volume));
        mean[c] = hn::IfThenElseZero(isSolid, mean[c]);
        hn::Store(hn::Add(middle[c], mean[c]), lanes, solids.centroid[c] + begin);
    }
    for (int r = 0, i = 0; r < 3; ++r)
        for (int c = r; c < 3; ++c, ++i) {
            const D about = hn::Div(sum.second[i], hn::Mul(d(20), sum.volume));
            hn::Store(hn::IfThenElseZero(isSolid, hn::NegMulAdd(mean[r], mean[c], about)), lanes,
                      solids.second[i] + begin);
        }
}

HWY_ATTR void MeasureSolids(const CellType& type, std::size_t count, SolidColumns& solids) {
    for (std::size_t i = 0; i < count; i += hn::Lanes(Doubles())) measureFrom(type, i, solids);
}

}  // namespace HWY_NAMESPACE
}  // namespace timeseries
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace timeseries {
HWY_EXPORT(MeasureSolids);

void measureSolids(const CellType& type, std::size_t count, SolidColumns& solids) {
    HWY_DYNAMIC_DISPATCH(MeasureSolids)(type, count, solids);
}

}  // namespace timeseries
#endif
