// Where points of a grid lie and what of them is drawn: put before the vertex shader of splats, and
// before what finds how far away they are. After grid_indices.glsl.
// Variants: MESH (points lie one by one, their cells in any shape).

// C++ mirror: SplatViewBlock in render/splat/gl_splat_view.h.
layout(std140, binding = 0) uniform SplatView {
    mat4 viewFromAxes;
    vec4 rayAxis;   // ray of the view axis; w: its length in the world
    vec4 perPixelX; // of rays, per pixel; w: pixels per unit of x / -z
    vec4 perPixelY; // w: pixels per unit of y / -z
    vec4 window;    // window position of the view axis, size in pixels
    vec4 depths;    // near; window depth = (y d + z) / d of view depth d: y, z; guard in pixels
    vec4 kernel;    // radius in cells, smallest radius at unit depth, mass of a cell with sides 1, point's side in pixels
    vec4 slopeAndLengths;  // squares of x / -z and y / -z per pixel; view length of an axis length, at most; a pixel's area at unit depth
    vec4 domainLo, domainHi, boxHalf;  // in axis coordinates; w: of a splat of size 1, radius over width
    vec4 meshScale;      // world lengths of the mesh's units; w: 1 where cells that are drawn are turned over, else 0
    vec4 meshOffset;     // its origin in the world; w: a cell's volume over its determinant
    vec4 meshFrom, meshTo;  // inclusive box in its units
    uvec4 placed;  // points along x, y, z; w: that the mesh keeps of one level
    uvec4 clipLo, clipHi;  // inclusive index box; of a mesh z: levels
} view;

layout(binding = 0) uniform samplerBuffer axisPoints;  // per axis index: position along it, cell width; MESH: per level

#ifdef MESH
layout(binding = 2) uniform usamplerBuffer meshPoints;  // six words a point: timeseries/grid/shaped_point.h

// SmallFloat::magnitude.
float magnitude(uint code, int mantissa, int least) {
    if (code >> mantissa == 0u) return float(code) * uintBitsToFloat(uint(127 + least - mantissa) << 23);
    return uintBitsToFloat((code << (23 - mantissa)) + (uint(126 + least) << 23));
}
float placeOf(uint word) {
    const float away = magnitude(word & 0x3ffffffu, 22, -13);
    return (word >> 26 & 1u) != 0u ? -away : away;
}
float slopeOf(uint code, int mantissa) {
    const float up = magnitude(code & ((32u << mantissa) - 1u), mantissa, -4);
    return code >> (mantissa + 5) != 0u ? -up : up;
}
#endif

// In axis coordinates. Its cell: a lower triangular matrix (timeseries::LowerTriangle), of upright
// grids the diagonal alone.
struct Point {
    vec3 at, diagonal, below;
    float volume;
    bool clipped;  // outside of the clip box, or it has no cell
};

#ifdef MESH
Point pointOf(uint gridIndex) {
    const int level = int(gridIndex / view.placed.w), texel = 2 * int(gridIndex % view.placed.w);
    const uvec3 first = texelFetch(meshPoints, texel).xyz, last = texelFetch(meshPoints, texel + 1).xyz;
    const vec2 ofLevel = texelFetch(axisPoints, level).xy;
    const vec3 kept = vec3(placeOf(first.x), placeOf(first.y), placeOf(first.z)), by = view.meshScale.xyz;
    const vec3 diagonal = vec3(magnitude(last.x & 0x7fffu, 8, -89), magnitude(last.y & 0xfffffffu, 21, -89),
                               magnitude(last.x >> 15 & 0x7fffu, 8, -89));
    const uint lowest = first.x >> 27 | first.y >> 27 << 5 | first.z >> 27 << 10;
    const vec3 below = diagonal.yzz * vec3(slopeOf(lowest, 9), slopeOf(last.z & 0xffffu, 10), slopeOf(last.z >> 16, 10));
    const uint turned = last.x >> 30 & 1u, widened = last.x >> 31 | last.y >> 28 << 1;
    const bool none = diagonal.x == 0.0 || float(turned) != view.meshScale.w;
    const float share = uintBitsToFloat(127u - widened << 23);  // 2^-widened
    Point p;
    p.at = by * kept + view.meshOffset.xyz + vec3(0.0, 0.0, ofLevel.x);
    p.diagonal = by * diagonal;
    p.below = by.yzz * below;
    if (ofLevel.y > 0.0) p.diagonal.z = ofLevel.y;
    p.volume = share * abs(p.diagonal.x * p.diagonal.y * p.diagonal.z) * view.meshOffset.w;
    p.clipped = none || any(lessThan(kept, view.meshFrom.xyz)) || any(greaterThan(kept, view.meshTo.xyz)) ||
                uint(level) < view.clipLo.z || uint(level) > view.clipHi.z;
    return p;
}
#else
Point pointOf(uint gridIndex) {
    const uvec3 n = view.placed.xyz, ijk = indicesOf(gridIndex, n);
    const vec2 px = texelFetch(axisPoints, int(ijk.x)).xy;
    const vec2 py = texelFetch(axisPoints, int(n.x + ijk.y)).xy;
    const vec2 pz = texelFetch(axisPoints, int(n.x + n.y + ijk.z)).xy;
    Point p;
    p.at = vec3(px.x, py.x, pz.x);
    p.diagonal = vec3(px.y, py.y, pz.y);
    p.below = vec3(0.0);
    p.volume = p.diagonal.x * p.diagonal.y * p.diagonal.z;
    p.clipped = any(lessThan(ijk, view.clipLo.xyz)) || any(greaterThan(ijk, view.clipHi.xyz));
    return p;
}
#endif

// Whether a point's place in its block of the sorted step is between these, and among so many of
// the first ranks there; subsetRank in render/points/subset.h.
bool isDrawn(uint placeInBlock, uint from, uint last, uint ranks) {
    return placeInBlock >= from && placeInBlock <= last && (placeInBlock * 20249u & 32767u) < ranks;
}

const uint kNoLayer = 255u;  // that an entry of a sorted list has whose point is clipped
