// One piece of a cell -> the rectangle of pixels that holds it, and what its pixels ask. Axis
// coordinates (render/points/placed_points.h) to window offsets from the view axis, in pixels;
// formulas: render/model/cell_splat.h.
// After cell_view.glsl, cell_vertex.glsl, grid_indices.glsl and cell_piece.glsl.

layout(std430, binding = 0) readonly buffer Pieces { Piece pieces[]; };
layout(binding = 0) uniform samplerBuffer axisSides;  // per axis and cell: middle, size

layout(location = 4) flat out vec4 atAndSteep;
layout(location = 5) flat out vec4 ray;      // w: what a pixel's step to the right takes back of it
layout(location = 6) flat out vec4 perSize;  // w: and up
layout(location = 7) flat out vec4 low;
layout(location = 8) flat out vec4 high;
layout(location = 9) flat out uint piece;

void main() {
    piece = pieceOfVertex();
    const Piece p = pieces[piece];
    const uvec3 n = view.cells.xyz, cell = indicesOf(p.cell, n);
    const vec2 x = texelFetch(axisSides, int(cell.x)).xy;
    const vec2 y = texelFetch(axisSides, int(n.x + cell.y)).xy;
    const vec2 z = texelFetch(axisSides, int(n.x + n.y + cell.z)).xy;
    vec3 middle = vec3(x.x, y.x, z.x), size = vec3(x.y, y.y, z.y);
    const uint octant = p.kind & 15u;
    if (octant != kWholeCell) {
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
    putNowhere();
    if (!(depth + deep > near)) return;  // every corner there: nothing

    vec2 centre = vec2(0.0), lo = -view.window.xy, hi = view.window.zw - view.window.xy;
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
    } else {
        vec2 least = vec2(1e30), most = vec2(-1e30);
        for (int c = 0; c < 8; ++c)
            for (int a = 0; a < 3; ++a) {
                if ((c >> a & 1) != 0) continue;
                const vec3 side = vec3(c & 1, c >> 1 & 1, c >> 2) * 2.0 - 1.0;
                const vec3 v = seen + side.x * edge[0] + side.y * edge[1] + side.z * edge[2];
                takeEdge(v, v + 2.0 * edge[a], near, focal, least, most);
            }
        const vec2 more = moreBeside(least, most);
        lo = max(lo, least - more);
        hi = min(hi, most + more);
    }
    if (any(greaterThanEqual(lo, hi))) return;
    centreAndBase = vec4(centre, base, 0.0);
    map = vec4(p.mapPlace, p.mapPerValue, 0.0, 0.0);
    kind = uvec2(p.kind >> 4 & 3u, p.kind >> 8);
    atAndSteep = vec4(at, p.steep);
    const vec3 along = view.rayAxis.xyz + centre.x * view.perPixelX.xyz + centre.y * view.perPixelY.xyz;
    const vec3 right = view.perPixelX.xyz / size, up = view.perPixelY.xyz / size;
    ray = vec4(along / size, 0.0);
    const vec3 steps = max(abs(right), abs(up));
    const float flatness = flatnessOf(base * max(steps.x, max(steps.y, steps.z)));
    const float longest = max(abs(ray.x), max(abs(ray.y), abs(ray.z)));
    const vec3 direction = ray.xyz / longest;
    const vec2 back = flatness / (longest * dot(direction, direction)) * vec2(dot(direction, right), dot(direction, up));
    ray.w = back.x;
    perSize = vec4(1.0 / size, back.y);
    range = vec4(p.least, p.most, p.perRange, widestRamp(p.least, p.most, kind.x, flatness));
    low = p.low;
    high = p.high;
    putAt(lo, hi);
}
