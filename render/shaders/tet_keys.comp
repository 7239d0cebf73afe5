// Tetrahedra -> keys, the smaller the farther away: first each one's own, of its middle; then, in the
// order that these have made, that of its cell: its place in an order of cells, or else of its
// middle, where tetrahedra of a cell stay together but where another cell is as far away, to a float,
// and of one in several layers those of the last layer come first.

layout(local_size_x = 256) in;
layout(location = 0) uniform uint count;
layout(location = 1) uniform int keys;  // C++ mirror: GlPieceOrder::Keys
layout(location = 2) uniform vec4 eye;   // the eye's place over a length s, and its distance from the origin over s
layout(location = 3) uniform float perS;

// C++ mirror: GlTet in render/splat/gl_tets.h.
struct Piece {
    vec4 corners[4];
    float least, most, perRange, steep, mapPlace, mapPerValue;
    uint kind, cell;
};
layout(std430, binding = 0) readonly buffer Pieces { Piece pieces[]; };
layout(std430, binding = 1) readonly buffer Cells { uint cells[]; };        // of each piece
layout(std430, binding = 2) readonly buffer Middles { vec4 middles[]; };    // of each cell
layout(std430, binding = 3) buffer Keyed { uvec2 keyed[]; };
layout(std430, binding = 4) readonly buffer Places { uint places[]; };      // of each cell, the nearest first
const int kOwnMiddles = 0, kCellsPlaces = 2;

// How much farther than the origin, as depth_keys.comp has it; as a number whose order is the
// float's, the farthest first.
uint keyOf(vec3 a) {
    const vec3 e = eye.xyz, small = a * perS;
    const float sum = length(small - e) + eye.w;
    const uint bits = floatBitsToUint(sum > 0.0 ? (dot(a, small) - 2.0 * dot(a, e)) / sum : 0.0);
    return ~(bits ^ (bits >> 31 != 0u ? ~0u : 0x80000000u));
}

void main() {
    const uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    if (i >= count) return;
    const bool ofCells = keys != kOwnMiddles;
    const uint number = ofCells ? keyed[i].y : i;
    if (keys == kCellsPlaces) {
        keyed[i].x = ~places[cells[number]];
        return;
    }
    const Piece p = pieces[number];
    const vec3 middle = ofCells ? middles[cells[number]].xyz
                                : p.corners[0].xyz + 0.25 * (p.corners[1] + p.corners[2] + p.corners[3]).xyz;
    const uint key = keyOf(middle);
    keyed[i] = uvec2(ofCells ? (key & ~7u) | 7u - (p.kind >> 8) : key, number);
}
