// A piece of a cell or a tetrahedron of one -> two triangles over the pixels that it may touch: put
// before both vertex shaders.
// Variants: ORDERED (pieces come in the order of a list).

#ifdef ORDERED
layout(std430, binding = 1) readonly buffer Places { uint places[]; };
#endif
layout(location = 0) uniform uint first;  // to draw

layout(location = 0) flat out vec4 centreAndBase;  // window offset of the centre; base depth; of a tetrahedron, f across a pixel
layout(location = 1) flat out vec4 range;          // least, most, per range; the widest ramp
layout(location = 2) flat out vec4 map;            // place of f = 0, per f
layout(location = 3) flat out uvec2 kind;          // bit 0, 1: crosses least, most; layer

// As alongCell() and widestRamp() have them (render/model/cell_splat.h): of a pixel that steps so much of a cell
// aside; bit 0 and 1 of `crosses`: the range's least and most.
const float kOrdinaryStep = 0.25, kFlatStep = 0.5, kNarrowRamp = 0.125, kSharedRamp = 2.0 / 3.0, kThinnest = 1e-2;
float flatnessOf(float step) { return clamp((step - kOrdinaryStep) / (kFlatStep - kOrdinaryStep), 0.0, 1.0); }
float widestRamp(float least, float most, uint crosses, float flatness) {
    if (!(flatness > 0.0)) return 1e18;
    const vec2 beside = abs(1.0 - abs(vec2(least, most)));
    float widest = 1e18;
    if ((crosses & 1u) != 0u) widest = min(widest, beside.x > kThinnest ? 2.0 * beside.x : kSharedRamp);
    if ((crosses & 2u) != 0u) widest = min(widest, beside.y > kThinnest ? 2.0 * beside.y : kSharedRamp);
    return max(widest, kNarrowRamp) / flatness;
}

// As cellSplatAt has it: more than arithmetic loses.
const float kMore = 0.01;

uint pieceOfVertex() {
    const uint number = first + uint(gl_VertexID) / 6u;
#ifdef ORDERED
    return places[number];
#else
    return number;
#endif
}

// The vertex lies nowhere, or at a corner of the pixels between these offsets from the view axis.
void putNowhere() { gl_Position = vec4(-2.0, -2.0, 0.0, 1.0); }
void putAt(vec2 lo, vec2 hi) {
    const uint k = uint(gl_VertexID) % 6u, corner = k < 3u ? k : k - 2u;  // 0 1 2, 1 2 3
    const vec2 place = mix(lo, hi, vec2(corner & 1u, corner >> 1)) + view.window.xy;
    gl_Position = vec4(place / view.window.zw * 2.0 - 1.0, 0.0, 1.0);
}
