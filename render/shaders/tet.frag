// One pixel of a tetrahedron: the length that its ray has inside the range, or how much of the range
// it crosses. Names and formulas: fragmentOn in render/model/tet_splat.h. After cell_view.glsl and
// cell_range.glsl.

layout(location = 4) flat in vec4 at;
layout(location = 5) flat in vec4 ray;
layout(location = 6) flat in vec4 right;
layout(location = 7) flat in vec4 up;
layout(location = 8) flat in vec4 field;
layout(location = 9) flat in float steep;
layout(location = 10) flat in uint piece;

#ifdef OVER
// C++: GlTetSlopes in render/splat/gl_tets.h.
layout(std430, binding = 2) readonly buffer Slopes { vec4 slopes[]; };

// What light makes of a colour where the corners have these shares.
vec3 lit(vec3 color, vec4 shares, vec2 offset, float rayLength) {
    if (view.squares.w == 0.0) return color;
    const vec3 g = vec3(dot(slopes[3u * piece], shares), dot(slopes[3u * piece + 1u], shares),
                        dot(slopes[3u * piece + 2u], shares));
    const vec2 pixel = offset + centreAndBase.xy;
    const vec3 way = view.rayAxis.xyz + pixel.x * view.perPixelX.xyz + pixel.y * view.perPixelY.xyz;
    return litBy(color, g, dot(g, way), steep, rayLength, lampOfRay(offset, rayLength));
}
#endif

void main() {
    const vec2 offset = offsetOfPixel();
    const float base = centreAndBase.z;
    const vec4 shift = offset.x * right + offset.y * up;
    const vec4 along = ray + shift;
    const vec4 least = max(abs(along), vec4(kLeastStep));
    const bvec4 enters = greaterThanEqual(along, vec4(0.0));
    const vec4 where = -(at + base * shift) / mix(-least, least, enters);
    const vec4 enter = mix(vec4(-3e38), where, enters), leave = mix(where, vec4(3e38), enters);
    const float from = max(max(max(enter.x, enter.y), max(enter.z, enter.w)), view.eye.w - base);
    const float to = min(min(min(leave.x, leave.y), min(leave.z, leave.w)), hiddenFrom());
    if (!(to > from)) discard;
    const float longer = longerThanAxis(offset);
    const float whole = view.rayAxis.w * (to - from) * longer;

    const float moved = offset.x * field.z + offset.y * field.w;
    const float value = field.x + base * moved, change = field.y + moved;
    const float first = value + from * change, last = value + to * change;
    const float met = abs(last - first), most = max(whole, met * range.z);
    float w = whole, front = first, back = last;
    if (crossesLeast() || crossesMost()) {
        const float width = clamp((base + 0.5 * (from + to)) * centreAndBase.w, 2.0 * kLeastChange, range.w);
        const float share = shareIn(first, last, 1.0 / width);
        w = share * most;
        if (!(w > 0.0)) discard;
        const vec2 ends = withinRange(vec2(min(first, last), max(first, last)) + vec2(-0.5, 0.5) * width);
        const float mean = valueIn(first, last, width, share);
        const float spread = max(min(mean - ends.x, ends.y - mean), 0.0), toBack = change > 0.0 ? spread : -spread;
        front = mean - toBack;
        back = mean + toBack;
    }
#if defined(WEIGHT)
    sum = w;
#elif defined(COUNT)
    sum = 1.0;
#elif defined(WEIGHTED_COLOR)
    sum = vec4(colorBetween(front, back) * w, w);
#else
    const float perWeight = layers.style[kind.y].w, depthOfLight = perWeight * w, alpha = opacity(depthOfLight);
    const vec3 color = colorBetween(front, seenTo(front, back, depthOfLight, perWeight * most, met));
    const float halfWay = 0.5 * (to - from), depth = 0.5 * (from + to);
    const float place = depth + inRange(value + depth * change, change, halfWay, depthOfLight);
    sum = vec4(lit(color, at + base * shift + place * along, offset, view.depths.z * longer) * alpha, alpha);
#endif
}
