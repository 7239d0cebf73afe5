// The points of a draw list's pieces -> a key each, the smaller the farther away, and where the
// point lies on the GPU; those of a block in the order of the sorted step, which ties keep. A
// workgroup a piece.
// After splat_points.glsl.

layout(local_size_x = 256) in;

// C++ mirror: KeysBlock in render/splat/gl_depth_order.cpp.
layout(std140, binding = 1) uniform Keys {
    mat4 worldFromAxes;
    vec4 eye;   // the eye's place over a length s, and its distance from the origin over s
    vec4 keys;  // 1 / s; the points' farthest distance from the origin; keys per unit; the last key
} keys;

// C++ mirror: OrderedPiece.
struct Piece {
    uint first, count, to, layer;  // to: where its block's points go
    uint from, last, ranks, subset;
};
layout(std430, binding = 0) readonly buffer Pieces { Piece pieces[]; };
layout(std430, binding = 1) readonly buffer GridIndices { uint gridIndices[]; };
layout(std430, binding = 2) readonly buffer PlacesInBlocks { uint placesInBlocks[]; };  // 16 bits each
// Of each place in a block, how many of a subset (render/points/subset.h) come before it.
layout(std430, binding = 4) readonly buffer Before { uint before[]; };
layout(std430, binding = 3) writeonly buffer Keyed { uvec2 keyed[]; };  // from bit 3 on, the key; below, the layer

const uint kWhole = ~0u;

// Relative to the distance of the origin, which may be large beside all that lies about it:
// |a - e| - |e| = (a a - 2 a e) / (|a - e| + |e|), everything over s.
uint keyOf(vec3 at) {
    const vec3 a = mat3(keys.worldFromAxes) * at, e = keys.eye.xyz, small = a * keys.keys.x;
    const float sum = length(small - e) + keys.eye.w;
    const float beyond = sum > 0.0 ? (dot(a, small) - 2.0 * dot(a, e)) / sum : 0.0;
    const float key = (keys.keys.y - beyond) * keys.keys.z + 0.5;
    return uint(clamp(key, 0.0, keys.keys.w));
}

void main() {
    const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    if (number >= pieces.length()) return;
    const Piece piece = pieces[number];
    for (uint i = gl_LocalInvocationID.x; i < piece.count; i += gl_WorkGroupSize.x) {
        const uint place = piece.first + i;
        const uint inBlock = placesInBlocks[place >> 1] >> 16u * (place & 1u) & 0xffffu;
        uint key = ~0u;  // comes last
        if (isDrawn(inBlock, piece.from, piece.last, piece.ranks)) {
            const Point p = pointOf(gridIndices[place]);
            const bool somewhere = !any(isnan(p.at)) && !any(isinf(p.at));
            // Clipped: after all that is seen, before what is not drawn at all.
            key = p.clipped || !somewhere ? ~0u - 8u : keyOf(p.at) << 3 | piece.layer;
        }
        const uint at = piece.subset == kWhole ? inBlock : before[piece.subset + inBlock];
        keyed[piece.to + at] = uvec2(key, place);
    }
}
