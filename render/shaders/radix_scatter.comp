// Entries -> where those of their digit go, in their order. Stable: each round of a tile's 256 tells
// by bits which of them come before another of the same digit.
// Variants of what the last digit's makes: POINTS (the draw list of those that are drawn), VALUES
// (which have values), PLACES (numbers alone).

layout(local_size_x = 256) in;
layout(location = 0) uniform uint count;
layout(location = 1) uniform uint shift;

layout(std430, binding = 0) readonly buffer Keyed { uvec2 keyed[]; };
layout(std430, binding = 1) readonly buffer Starts { uint starts[]; };  // [digit][tile]
#if defined(POINTS)
layout(location = 2) uniform uint drawn;  // the first of all
layout(std430, binding = 2) readonly buffer GridIndices { uint gridIndices[]; };
#ifdef VALUES
layout(std430, binding = 3) readonly buffer Values { float values[]; };
#endif
// C++ mirror: SortedPoint in render/splat/gl_depth_order.h.
struct SortedPoint {
    uint gridIndex;
    float value;
    uint layer;
};
layout(std430, binding = 4) writeonly buffer List { SortedPoint list[]; };

void put(uint to, uvec2 entry) {
    if (to >= drawn) return;
    SortedPoint p;
    p.gridIndex = gridIndices[entry.y];
#ifdef VALUES
    p.value = values[entry.y];
#else
    p.value = 0.0;
#endif
    p.layer = entry.x >= ~0u - 8u ? 255u : entry.x & 7u;  // kNoLayer in splat_points.glsl
    list[to] = p;
}
#elif defined(PLACES)
layout(std430, binding = 2) writeonly buffer Numbers { uint numbers[]; };

void put(uint to, uvec2 entry) { numbers[to] = entry.y; }
#else
layout(std430, binding = 2) writeonly buffer Sorted { uvec2 sorted[]; };

void put(uint to, uvec2 entry) { sorted[to] = entry; }
#endif

shared uint next[256];        // where the next of each digit goes
shared uint has[256u * 8u];   // of each digit, which of this round have it: 8 words of bits

void main() {
    const uint own = gl_LocalInvocationID.x, tile = gl_WorkGroupID.x;
    next[own] = starts[own * gl_NumWorkGroups.x + tile];
    for (uint word = 0u; word < 8u; ++word) has[own * 8u + word] = 0u;
    barrier();
    const uint end = min((tile + 1u) * kTile, count);
    for (uint first = tile * kTile; first < end; first += 256u) {
        const uint i = first + own, word = own >> 5, bit = own & 31u;
        uvec2 entry = uvec2(0u);
        uint digit = 0u;
        if (i < end) {
            entry = keyed[i];
            digit = entry.x >> shift & 255u;
            atomicOr(has[digit * 8u + word], 1u << bit);
        }
        barrier();
        if (i < end) {
            uint to = next[digit] + uint(bitCount(has[digit * 8u + word] & ((1u << bit) - 1u)));
            for (uint before = 0u; before < word; ++before) to += uint(bitCount(has[digit * 8u + before]));
            put(to, entry);
        }
        barrier();
        for (uint of = 0u; of < 8u; ++of) {
            next[own] += uint(bitCount(has[own * 8u + of]));
            has[own * 8u + of] = 0u;
        }
        barrier();
    }
}
