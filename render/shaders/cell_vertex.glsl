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
    const vec2 beside = abs(1.0 - abs(vec2(least, most))), own = min(2.0 * beside, 1e18);
    const vec2 ramp = mix(own, vec2(kSharedRamp), clamp(2.0 - beside / (0.5 * kThinnest), 0.0, 1.0));
    float widest = 1e18;
    if ((crosses & 1u) != 0u) widest = min(widest, ramp.x);
    if ((crosses & 2u) != 0u) widest = min(widest, ramp.y);
    return max(widest, kNarrowRamp) / flatness;
}

// As cellSplatAt has it: more than arithmetic loses.
const float kMore = 0.01;

// As SeenBounds in render/model/seen_bounds.h, of an edge in view space: window offsets from the view axis.
void takeEdge(vec3 a, vec3 b, float near, vec2 focal, inout vec2 least, inout vec2 most) {
    const bool isA = -a.z > near, isB = -b.z > near;
    vec2 places[3] = vec2[3](vec2(0.0), vec2(0.0), vec2(0.0));
    int count = 0;
    if (isA) places[count++] = a.xy / -a.z;
    if (isB) places[count++] = b.xy / -b.z;
    if (isA != isB) places[count++] = mix(a.xy, b.xy, (near + a.z) / (a.z - b.z)) / near;
    for (int k = 0; k < count; ++k) {
        least = min(least, focal * places[k]);
        most = max(most, focal * places[k]);
    }
}
// More than arithmetic loses of these, too.
vec2 moreBeside(vec2 least, vec2 most) { return kMore + 1e-5 * max(abs(least), abs(most)); }

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
