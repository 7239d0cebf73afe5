// Cells of an upright grid -> what is to be seen of them with each range of their layer, as
// forEachPiece() (render/splat/cell_pieces.h) and cell::seeField() (render/model/cell_splat.h) have
// it, of values in double. Twice: how many each workgroup makes; and, once these are summed, they themselves.
// Variants: what a field's value is, 1 to 8 bytes of it (BYTES) and of which kind (SIGNED, REAL);
// CORNERS (doubles, eight a cell that is asked for, instead of a field's values).
// After grid_indices.glsl and cell_piece.glsl.

layout(local_size_x = 256) in;
layout(location = 0) uniform uvec4 part;   // the first cell, how many, the first workgroup, the layer
layout(location = 1) uniform uvec2 among;  // the layer's first range, how many
layout(location = 2) uniform dvec2 map;    // by value: the map's end and half width; else that is < 0
layout(location = 3) uniform bool makes;   // else counts

// C++ mirror: CellsBlock in render/splat/gl_cell_lister.cpp.
layout(std140, binding = 0) uniform Cells {
    uvec4 points;  // along x, y, z; w: bit 0, some are missing; 1, each passage counts; 2, light falls
    uvec4 clipLo, clipHi;
    double unitLength, steep, steepest;
} cells;
layout(binding = 0) uniform samplerBuffer axisSides;  // per axis and cell: middle, size
layout(std430, binding = 0) readonly buffer Numbers { uint numbers[]; };
layout(std430, binding = 1) readonly buffer Values { uint values[]; };
layout(std430, binding = 2) readonly buffer Missing { uint missing[]; };  // a bit a point
layout(std430, binding = 3) readonly buffer Ranges { dvec2 ranges[]; };
layout(std430, binding = 4) buffer Starts { uint starts[]; };  // of each workgroup
layout(std430, binding = 5) writeonly buffer Pieces { Piece pieces[]; };
layout(std430, binding = 6) readonly buffer CornerSlopes { float cornerSlopes[]; };  // of CORNERS, a cell and axis eight
layout(std430, binding = 7) writeonly buffer Slopes { float slopes[]; };  // as fragments read them

const double kThinnest = 1e-2LF;  // as cell_splat.h has it

double valueAt(uint i) {
#if BYTES == 8
    const uvec2 bits = uvec2(values[2u * i], values[2u * i + 1u]);
#if defined(REAL)
    return packDouble2x32(bits);
#elif defined(SIGNED)
    return double(int(bits.y)) * 4294967296.0LF + double(bits.x);
#else
    return double(bits.y) * 4294967296.0LF + double(bits.x);
#endif
#elif BYTES == 4
#if defined(REAL)
    return double(uintBitsToFloat(values[i]));
#elif defined(SIGNED)
    return double(int(values[i]));
#else
    return double(values[i]);
#endif
#else
    const int perWord = 4 / BYTES, bits = 8 * BYTES;
    const uint word = values[i / uint(perWord)];
    const int at = int(i % uint(perWord)) * bits;
#if defined(SIGNED)
    return double(bitfieldExtract(int(word), at, bits));
#else
    return double(bitfieldExtract(word, at, bits));
#endif
#endif
}

// Whether it is there, and finite.
bool isValue(double v) { return !isnan(v) && !isinf(v); }

// Eight doubles, of the corners: as bits, for NVIDIA's driver keeps arrays of doubles as floats.
struct Eight {
    uvec2 of[8];
};
double at(Eight e, uint k) { return packDouble2x32(e.of[k]); }

struct Corners {
    Eight values;
    uint octants;  // that are seen, a bit each
};

uvec3 pointAt(uvec3 cell, uint corner) {
    const uvec3 up = max(cell + uvec3(corner & 1u, corner >> 1 & 1u, corner >> 2), uvec3(1u)) - 1u;
    return min(up, cells.points.xyz - 1u);
}

bool isClipped(uvec3 point) {
    return any(lessThan(point, cells.clipLo.xyz)) || any(greaterThan(point, cells.clipHi.xyz));
}

// As fillMissing has it: of the corners that are there and are the fewest edges from this one.
double meanOfNearest(Corners c, uint corner) {
    for (int away = 1; away <= 3; ++away) {
        double sum = 0.0LF, least = 0.0LF, greatest = 0.0LF;
        uint count = 0u;
        for (uint k = 0u; k < 8u; ++k) {
            if (bitCount(k ^ corner) != away || (c.octants >> k & 1u) == 0u) continue;
            const double v = at(c.values, k);
            sum += v / 4.0LF;
            least = count == 0u ? v : min(least, v);
            greatest = count == 0u ? v : max(greatest, v);
            ++count;
        }
        if (count > 0u) return clamp(sum * (4.0LF / double(count)), least, greatest);
    }
    return 0.0LF;  // none is there, and nothing is seen
}

// Whether that is the value of a point that is there.
bool isThere(uint point, double v) {
    return isValue(v) && ((cells.points.w & 1u) == 0u || (missing[point >> 5] >> (point & 31u) & 1u) == 0u);
}

// Of the cell that is the place-th asked for.
Corners cornersOf(uint place, uvec3 cell) {
    Corners c;
    c.octants = 0u;
    for (uint k = 0u; k < 8u; ++k) {
        const uvec3 p = pointAt(cell, k);
        const uint point = p.x + cells.points.x * (p.y + cells.points.y * p.z);
#ifdef CORNERS
        const double v = valueAt(8u * place + k);
        if (!isValue(v)) continue;
#else
        const double v = valueAt(point);
        if (!isThere(point, v)) continue;
#endif
        c.values.of[k] = unpackDouble2x32(v);
        c.octants |= 1u << k;
    }
    for (uint k = 0u; k < 8u; ++k) {
        if ((c.octants >> k & 1u) == 0u) c.values.of[k] = unpackDouble2x32(meanOfNearest(c, k));
    }
    for (uint k = 0u; k < 8u; ++k) {
        if (isClipped(pointAt(cell, k))) c.octants &= ~(1u << k);
    }
    return c;
}

double between(double a, double b, double t) { return a + t * (b - a); }
double within(Eight e, dvec3 u) {
    const double low = between(between(at(e, 0u), at(e, 1u), u.x), between(at(e, 2u), at(e, 3u), u.x), u.y);
    const double high = between(between(at(e, 4u), at(e, 5u), u.x), between(at(e, 6u), at(e, 7u), u.x), u.y);
    return between(low, high, u.z);
}

// The corners of what is seen as this octant, or of all of the cell.
Eight cornersOf(Corners c, uint octant) {
    if (octant == kWholeCell) return c.values;
    const dvec3 first = 0.5LF * dvec3(octant & 1u, octant >> 1 & 1u, octant >> 2);
    Eight e;
    for (uint k = 0u; k < 8u; ++k) {
        e.of[k] = unpackDouble2x32(within(c.values, first + 0.5LF * dvec3(k & 1u, k >> 1 & 1u, k >> 2)));
    }
    return e;
}

// As cell::coefficients(), the corners' order kept.
void toCoefficients(inout float f[8]) {
    for (uint step = 1u; step < 8u; step *= 2u) {
        for (uint k = 0u; k < 8u; ++k) {
            if ((k & step) != 0u) continue;
            const float a = f[k], b = f[k + step];
            f[k] = (a + b) / 2.0;
            f[k + step] = b - a;
        }
    }
}

bool touches(double least, double greatest, dvec2 range) { return least <= range.y && greatest >= range.x; }

// Whether a passage through the range counts, however short it is.
bool isThin(double extent, dvec2 range, dvec3 size) {
    return (cells.points.w & 2u) != 0u && extent > 0.0LF &&
           extent / (range.y - range.x) * 2.0LF * length(cells.unitLength / size) > 1.0LF;
}

// At a point, what values / extent change a unit of length along an axis; as PointSlopes has it
// (render/splat/cell_slopes.h).
double slopeAt(uvec3 at, uint axis, double extent) {
    const uvec3 steps = uvec3(1u, cells.points.x, cells.points.x * cells.points.y);
    const uvec3 n = cells.points.xyz + 1u;
    const uint point = at.x + steps.y * at.y + steps.z * at.z;
    const int first = int(axis == 0u ? 0u : axis == 1u ? n.x : n.x + n.y) + int(at[axis]);
    const bool hasBelow = at[axis] > 0u, hasAbove = at[axis] + 1u < cells.points[axis];
    const uint low = hasBelow ? point - steps[axis] : point, up = hasAbove ? point + steps[axis] : point;
    const double below = valueAt(low), above = valueAt(up);
    const bool fromBelow = hasBelow && isThere(low, below), toAbove = hasAbove && isThere(up, above);
    const double here = valueAt(point);
    if (!(fromBelow && toAbove) && !isThere(point, here)) return 0.0LF;
    const double way = (fromBelow ? double(texelFetch(axisSides, first).y) : 0.0LF) +
                       (toAbove ? double(texelFetch(axisSides, first + 1).y) : 0.0LF);
    if (way == 0.0LF) return 0.0LF;
    const double apart = 0.5LF * (toAbove ? above : here) - 0.5LF * (fromBelow ? below : here);
    return 2.0LF * (apart / extent) / way;
}

// What f changes over a cell at a corner, along an axis; of CORNERS as it is of the whole cell.
double cornerSlope(uint place, uvec3 cell, uint corner, uint axis, dvec3 size, double extent) {
    if (!(extent > 0.0LF)) return 0.0LF;
#ifdef CORNERS
    return double(cornerSlopes[24u * place + 8u * axis + corner]);
#else
    const double changes = slopeAt(pointAt(cell, corner), axis, extent) * size[axis];
    return isValue(changes) ? clamp(changes, -1e9LF, 1e9LF) : 0.0LF;
#endif
}

// Of the piece that becomes the to-th, of a cell that is the place-th asked for: of this size, and
// in which the field is reference + extent f.
void takeSlopes(uint to, uint place, uvec3 cell, uint octant, dvec3 size, double extent, double whole) {
    for (uint axis = 0u; axis < 3u; ++axis) {
        Corners c;
        for (uint k = 0u; k < 8u; ++k) {
            double changes = cornerSlope(place, cell, k, axis, size, extent);
#ifdef CORNERS
            changes *= (octant == kWholeCell ? 1.0LF : 0.5LF) * (whole / extent);
            if (!isValue(changes)) changes = 0.0LF;
            changes = clamp(changes, -1e9LF, 1e9LF);
#endif
            c.values.of[k] = unpackDouble2x32(changes);
        }
        const Eight of = cornersOf(c, octant);
        float f[8];
        for (uint k = 0u; k < 8u; ++k) f[k] = float(at(of, k));
        toCoefficients(f);
        const uint begin = 24u * to + 8u * axis;
        const uint order[8] = uint[8](0u, 1u, 2u, 4u, 3u, 5u, 6u, 7u);
        for (uint k = 0u; k < 8u; ++k) slopes[begin + k] = f[order[k]];
    }
}

// Half of what there is between the least and the greatest.
double extentOf(Eight e) {
    double least = at(e, 0u), greatest = least;
    for (uint k = 1u; k < 8u; ++k) {
        least = min(least, at(e, k));
        greatest = max(greatest, at(e, k));
    }
    return 0.5LF * greatest - 0.5LF * least;
}

float floatPlace(double at) { return float(clamp(at, -1e30LF, 1e30LF)); }

// Of these corners, whose least and greatest they are, with that range.
Piece pieceOf(Eight values, double least, double greatest, dvec2 range, bool thin) {
    Piece p;
    p.kind = 0u;
    p.least = p.most = p.perRange = 0.0;
    p.low = p.high = vec4(0.0);
    const double reference = 0.5LF * least + 0.5LF * greatest, extent = 0.5LF * greatest - 0.5LF * least;
    p.mapPlace = p.mapPerValue = 0.0;
    if (map.y > 0.0LF) {
        dvec2 colored = dvec2(reference, extent);  // as cell::coloredField() has it
        if (thin) {
            const double middle = 0.5LF * range.x + 0.5LF * range.y;
            const double share = min((0.5LF * range.y - 0.5LF * range.x) / extent / (kThinnest / 2.0LF), 1.0LF);
            colored = dvec2(middle + share * (reference - middle), share * extent);
        }
        p.mapPlace = floatPlace((0.5LF * colored.x - 0.5LF * map.x) / map.y);
        p.mapPerValue = floatPlace(0.5LF * colored.y / map.y);
    } else if (map.y == 0.0LF) {
        p.mapPlace = 0.5;
    }
    p.steep = float(extent > 0.0LF ? min(cells.steep / extent, cells.steepest) : cells.steepest);
    if (!(extent > 0.0LF)) return p;
    float f[8];
    for (uint k = 0u; k < 8u; ++k) {
        precise double apart = at(values, k) - reference;
        f[k] = float(apart / extent);
    }
    toCoefficients(f);
    p.low = vec4(f[0], f[1], f[2], f[4]);
    p.high = vec4(f[3], f[5], f[6], f[7]);
    const bool crossesLeast = thin || least < range.x, crossesMost = thin || greatest > range.y;
    p.kind = uint(crossesLeast) << 4 | uint(crossesMost) << 5;
    double lo = 2.0LF * ((0.5LF * range.x - 0.5LF * reference) / extent);
    double hi = 2.0LF * ((0.5LF * range.y - 0.5LF * reference) / extent);
    if (thin) {
        const double middle = (lo + hi) / 2.0LF, way = max(hi - middle, kThinnest / 2.0LF);
        lo = middle - way;
        hi = middle + way;
        p.perRange = float(1.0LF / (2.0LF * way));
    }
    if (crossesLeast) p.least = float(lo);
    if (crossesMost) p.most = float(hi);
    return p;
}

// What is to be seen of a cell, the place-th asked for, from that place on if `writes`; returns how many.
uint take(Corners c, uint place, uint number, uvec3 cell, bool writes, uint first) {
    const uvec3 n = cells.points.xyz + 1u;
    const bool isWhole = c.octants == 255u;
    uint count = 0u;
    for (uint octant = isWhole ? kWholeCell : 0u; octant < (isWhole ? kWholeCell + 1u : 8u); ++octant) {
        if (!isWhole && (c.octants >> octant & 1u) == 0u) continue;
        const Eight e = cornersOf(c, octant);
        double least = at(e, 0u), greatest = least;
        for (uint k = 1u; k < 8u; ++k) {
            least = min(least, at(e, k));
            greatest = max(greatest, at(e, k));
        }
        const dvec3 size = dvec3(texelFetch(axisSides, int(cell.x)).y,
                                 texelFetch(axisSides, int(n.x + cell.y)).y,
                                 texelFetch(axisSides, int(n.x + n.y + cell.z)).y);
        for (uint k = among.x; k < among.x + among.y; ++k) {
            if (!touches(least, greatest, ranges[k])) continue;
            const bool thin = isThin(0.5LF * greatest - 0.5LF * least, ranges[k],
                                     isWhole ? size : 0.5LF * size);
            // One that only touches the range has no length in it.
            const bool hasLength = least == greatest || (least < ranges[k].y && greatest > ranges[k].x);
            if (!thin && !hasLength) continue;
            if (writes) {
                Piece p = pieceOf(e, least, greatest, ranges[k], thin);
                p.cell = number;
                p.kind |= octant | part.w << 8;
                pieces[first + count] = p;
                if ((cells.points.w & 4u) != 0u)
                    takeSlopes(first + count, place, cell, octant, isWhole ? size : 0.5LF * size,
                               0.5LF * greatest - 0.5LF * least, extentOf(c.values));
            }
            ++count;
        }
    }
    return count;
}

shared uint sums[256];

// Of what the workgroup's threads have, that of those before this one; all of it in sums[255].
uint before(uint own, uint count) {
    sums[own] = count;
    barrier();
    for (uint by = 1u; by < 256u; by *= 2u) {
        const uint more = own >= by ? sums[own - by] : 0u;
        barrier();
        sums[own] += more;
        barrier();
    }
    return sums[own] - count;
}

void main() {
    const uint group = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    const uint own = gl_LocalInvocationID.x, i = group * 256u + own;
    Corners c;
    c.octants = 0u;
    uint number = 0u;
    uvec3 cell = uvec3(0u);
    if (i < part.y) {
        number = numbers[part.x + i];
        cell = indicesOf(number, cells.points.xyz + 1u);
        c = cornersOf(part.x + i, cell);
    }
    const uint count = take(c, part.x + i, number, cell, false, 0u), inGroup = before(own, count);
    if (makes) {
        if (count > 0u) take(c, part.x + i, number, cell, true, starts[part.z + group] + inGroup);
    } else if (own == 255u && group * 256u < part.y) {
        starts[part.z + group] = sums[255];
    }
}
