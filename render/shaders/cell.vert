// One piece of a cell -> the rectangle of pixels that holds it, and what its pixels ask. Axis
// coordinates (render/points/placed_points.h) to window offsets from the view axis, in pixels;
// formulas: render/model/cell_splat.h. Two triangles a piece.
// Variants: ORDERED (pieces come in the order of a list).

// C++ mirror: CellViewBlock in render/splat/gl_cell_splatter.cpp.
layout(std140, binding = 0) uniform CellView {
    mat4 viewFromAxes;
    vec4 eye;        // in axis coordinates; w: near
    vec4 rayAxis;    // ray of the view axis; w: its length in units of l
    vec4 perPixelX;  // of rays, per pixel; w: pixels per unit of x / -z
    vec4 perPixelY;  // w: pixels per unit of y / -z
    vec4 window;     // window position of the view axis, size in pixels
    vec4 depths;     // view depth of a window depth w: x / (w - y); z: the ray's length in the world
    vec4 squares;    // of gradients: xx, yy, zz; w: light, 0 off, 1 soft, 2 full
    vec4 products;   // xy, xz, yz
    uvec4 cells;     // along x, y, z
} view;

// C++ mirror: GlCell in render/splat/gl_cells.h.
struct Piece {
    uint cell, kind;
    float least, most, perRange, mapPlace, mapPerValue, steep;
    vec4 low, high;  // f
};
layout(std430, binding = 0) readonly buffer Pieces { Piece pieces[]; };
#ifdef ORDERED
layout(std430, binding = 1) readonly buffer Places { uint places[]; };
#endif
layout(binding = 0) uniform samplerBuffer axisSides;  // per axis and cell: middle, size
layout(location = 0) uniform uint first;             // to draw

layout(location = 0) flat out vec4 centreAndBase;  // window offset of the centre; base depth; tau's layer
layout(location = 1) flat out vec4 atAndLeast;
layout(location = 2) flat out vec4 rayAndMost;
layout(location = 3) flat out vec4 perSizeAndRange;
layout(location = 4) flat out vec4 low;
layout(location = 5) flat out vec4 high;
layout(location = 6) flat out vec4 mapAndSteep;  // place of f = 0, per f; steepness
layout(location = 7) flat out uvec2 kind;        // bit 0, 1: crosses least, most; layer

// As cellSplatAt has it: more than arithmetic loses.
const float kMore = 0.01;

void main() {
    const uint number = first + uint(gl_VertexID) / 6u;
#ifdef ORDERED
    const Piece p = pieces[places[number]];
#else
    const Piece p = pieces[number];
#endif
    const uvec3 n = view.cells.xyz;
    const uint row = p.cell / n.x, slice = row / n.y;
    const vec2 x = texelFetch(axisSides, int(p.cell - row * n.x)).xy;
    const vec2 y = texelFetch(axisSides, int(n.x + row - slice * n.y)).xy;
    const vec2 z = texelFetch(axisSides, int(n.x + n.y + slice)).xy;
    vec3 middle = vec3(x.x, y.x, z.x), size = vec3(x.y, y.y, z.y);
    const uint octant = p.kind & 15u;
    if (octant < 8u) {
        size *= 0.5;
        middle += size * (vec3(octant & 1u, octant >> 1 & 1u, octant >> 2) - 0.5);
    }
    const vec3 seen = (view.viewFromAxes * vec4(middle, 1.0)).xyz;
    const vec3 edge[3] = vec3[3](0.5 * size.x * view.viewFromAxes[0].xyz,
                                 0.5 * size.y * view.viewFromAxes[1].xyz,
                                 0.5 * size.z * view.viewFromAxes[2].xyz);
    const float depth = -seen.z, deep = abs(edge[0].z) + abs(edge[1].z) + abs(edge[2].z);
    const float near = view.eye.w;
    const vec2 focal = vec2(view.perPixelX.w, view.perPixelY.w);
    const vec2 picture = view.window.zw;
    gl_Position = vec4(-2.0, -2.0, 0.0, 1.0);
    if (!(depth + deep > near)) return;  // every corner there: nothing

    vec2 centre = vec2(0.0), lo = -view.window.xy, hi = picture - view.window.xy;
    float base = 0.0;
    vec3 at = (view.eye.xyz - middle) / size;
    if (depth - deep > near) {
        base = depth;
        at = vec3(0.0);
        centre = focal * seen.xy / depth;
        vec2 least = vec2(1e30), most = vec2(-1e30);
        for (int c = 0; c < 8; ++c) {
            const vec3 side = vec3(c & 1, c >> 1 & 1, c >> 2) * 2.0 - 1.0;
            const vec3 v = seen + side.x * edge[0] + side.y * edge[1] + side.z * edge[2];
            const vec2 offset = focal * v.xy / -v.z;
            least = min(least, offset);
            most = max(most, offset);
        }
        lo = max(lo, least - kMore);
        hi = min(hi, most + kMore);
        if (any(greaterThanEqual(lo, hi))) return;
    }
    centreAndBase = vec4(centre, base, 0.0);
    atAndLeast = vec4(at, p.least);
    const vec3 ray = view.rayAxis.xyz + centre.x * view.perPixelX.xyz + centre.y * view.perPixelY.xyz;
    rayAndMost = vec4(ray / size, p.most);
    perSizeAndRange = vec4(1.0 / size, p.perRange);
    low = p.low;
    high = p.high;
    mapAndSteep = vec4(p.mapPlace, p.mapPerValue, p.steep, 0.0);
    kind = uvec2(p.kind >> 4 & 3u, p.kind >> 8);
    const uint k = uint(gl_VertexID) % 6u, corner = k < 3u ? k : k - 2u;  // 0 1 2, 1 2 3
    const vec2 place = mix(lo, hi, vec2(corner & 1u, corner >> 1)) + view.window.xy;
    gl_Position = vec4(place / picture * 2.0 - 1.0, 0.0, 1.0);
}
