// A tetrahedron -> the rectangle of pixels that holds it, and what its pixels ask. Axis coordinates
// (render/points/placed_points.h), which are the world's, to window offsets from the view axis, in
// pixels; formulas: render/model/tet_splat.h.
// After cell_view.glsl and cell_vertex.glsl.

// C++ mirror: GlTet in render/splat/gl_tets.h.
struct Piece {
    vec4 corners[4];  // the first, and from there to the others; w: f
    float least, most, perRange, steep, mapPlace, mapPerValue;
    uint kind, cell;
};
layout(std430, binding = 0) readonly buffer Pieces { Piece pieces[]; };

// The corners' shares at the base, and how they change along that ray a unit of depth, and a pixel
// to the right and up a unit of depth; and the field, as f, likewise.
layout(location = 4) flat out vec4 at;
layout(location = 5) flat out vec4 ray;
layout(location = 6) flat out vec4 right;
layout(location = 7) flat out vec4 up;
layout(location = 8) flat out vec4 field;
layout(location = 9) flat out float steep;
layout(location = 10) flat out uint piece;

vec4 along(vec3 way, vec3 slopes[3]) {
    const vec3 of = vec3(dot(slopes[0], way), dot(slopes[1], way), dot(slopes[2], way));
    return vec4(-of.x - of.y - of.z, of);
}

void main() {
    piece = pieceOfVertex();
    const Piece p = pieces[piece];
    const vec3 first = p.corners[0].xyz, a = p.corners[1].xyz, b = p.corners[2].xyz, c = p.corners[3].xyz;
    const vec4 f = vec4(p.corners[0].w, p.corners[1].w, p.corners[2].w, p.corners[3].w);
    const vec3 bc = cross(b, c);
    const float turn = dot(a, bc), near = view.eye.w;
    const vec2 focal = vec2(view.perPixelX.w, view.perPixelY.w);
    putNowhere();
    if (!(abs(turn) > 0.0)) return;
    const vec3 slopes[3] = vec3[3](bc / turn, cross(c, a) / turn, cross(a, b) / turn);

    const mat3 turned = mat3(view.viewFromAxes);
    const vec3 seen0 = (view.viewFromAxes * vec4(first, 1.0)).xyz;
    const vec3 seen[4] = vec3[4](seen0, seen0 + turned * a, seen0 + turned * b, seen0 + turned * c);
    float nearest = 1e30, farthest = -1e30;
    for (int k = 0; k < 4; ++k) {
        nearest = min(nearest, -seen[k].z);
        farthest = max(farthest, -seen[k].z);
    }
    if (!(farthest > near)) return;
    vec2 centre = vec2(0.0), lo = -view.window.xy, hi = view.window.zw - view.window.xy;
    float base = 0.0;
    if (nearest > near) {
        const vec3 middle = seen0 + 0.25 * (turned * (a + b + c));
        base = -middle.z;
        centre = focal * middle.xy / base;
        at = vec4(0.25);
        vec2 least = vec2(1e30), most = vec2(-1e30);
        for (int k = 0; k < 4; ++k) {
            const vec2 offset = focal * seen[k].xy / -seen[k].z;
            least = min(least, offset);
            most = max(most, offset);
        }
        lo = max(lo, least - kMore);
        hi = min(hi, most + kMore);
    } else {
        at = along(view.eye.xyz - first, slopes) + vec4(1.0, 0.0, 0.0, 0.0);
        vec2 least = vec2(1e30), most = vec2(-1e30);
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < i; ++k) takeEdge(seen[i], seen[k], near, focal, least, most);
        const vec2 more = moreBeside(least, most);
        lo = max(lo, least - more);
        hi = min(hi, most + more);
    }
    if (any(greaterThanEqual(lo, hi))) return;
    map = vec4(p.mapPlace, p.mapPerValue, 0.0, 0.0);
    kind = uvec2(p.kind >> 4 & 3u, p.kind >> 8);
    ray = along(view.rayAxis.xyz + centre.x * view.perPixelX.xyz + centre.y * view.perPixelY.xyz, slopes);
    right = along(view.perPixelX.xyz, slopes);
    up = along(view.perPixelY.xyz, slopes);
    field = vec4(dot(f, at), dot(f, ray), dot(f, right), dot(f, up));
    const vec4 steps = max(abs(right), abs(up));
    const float flatness = flatnessOf(base * max(max(steps.x, steps.y), max(steps.z, steps.w)));
    const float longest = max(max(abs(ray.x), abs(ray.y)), max(abs(ray.z), abs(ray.w)));
    const vec4 direction = ray / longest;
    const vec2 back = flatness / (longest * dot(direction, direction)) * vec2(dot(direction, right), dot(direction, up));
    centreAndBase = vec4(centre, base, length(field.zw - field.y * back));
    range = vec4(p.least, p.most, p.perRange, widestRamp(p.least, p.most, kind.x, flatness));
    steep = p.steep;
    putAt(lo, hi);
}
