// Pieces of cells of an upright grid -> keys, the smaller the farther away: a sum of distances along
// the axes, as CellRank (render/splat/cell_pieces.h) has it, of bricks first, then of cells in one.
// The last piece comes first, so that of those of one cell the first is drawn last.
// After grid_indices.glsl and cell_piece.glsl.

layout(local_size_x = 256) in;
layout(location = 0) uniform uint count;
layout(location = 1) uniform uvec3 size;   // cells along x, y, z
layout(location = 2) uniform uvec3 eye;    // the cell that it is in, or beside
layout(location = 3) uniform uvec3 bricks; // along x, y, z, or none
layout(location = 4) uniform uint side;    // of one, in cells
layout(location = 5) uniform uint most;    // key there is

layout(std430, binding = 0) readonly buffer Pieces { Piece pieces[]; };
layout(std430, binding = 1) writeonly buffer Keyed { uvec2 keyed[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    if (i >= count) return;
    const uint number = count - 1u - i;
    const uvec3 at = indicesOf(pieces[number].cell, size);
    // Bricks along an axis: the eye's own cell, those above it, those below it.
    const uvec3 above = (size - eye - 1u + side - 1u) / side;
    uint away = 0u, within = 0u, brick = 0u;
    for (int a = 2; a >= 0; --a) {
        const uint cells = at[a] > eye[a] ? at[a] - eye[a] : eye[a] - at[a];
        const uint passed = (cells + side - 1u) / side;
        away += passed;
        within += cells == 0u ? 0u : (cells - 1u) % side;
        brick = brick * bricks[a] + (at[a] < eye[a] ? above[a] : 0u) + passed;
    }
    uint key = away;
    if (bricks.x > 0u) key = (away * bricks.x * bricks.y * bricks.z + brick) * (3u * side - 2u) + within;
    keyed[i] = uvec2(most - key, number);
}
