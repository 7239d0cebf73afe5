// How many keys of each tile have each value of a digit.

layout(local_size_x = 256) in;
layout(location = 0) uniform uint count;
layout(location = 1) uniform uint shift;  // of the digit, whose bits are 8

layout(std430, binding = 0) readonly buffer Keyed { uvec2 keyed[]; };
layout(std430, binding = 1) writeonly buffer Counts { uint counts[]; };  // [digit][tile]

shared uint of[256];

void main() {
    const uint own = gl_LocalInvocationID.x, tile = gl_WorkGroupID.x;
    of[own] = 0;
    barrier();
    const uint end = min((tile + 1u) * kTile, count);
    for (uint i = tile * kTile + own; i < end; i += 256u) atomicAdd(of[keyed[i].x >> shift & 255u], 1u);
    barrier();
    counts[own * gl_NumWorkGroups.x + tile] = of[own];
}
