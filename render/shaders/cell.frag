// One pixel of one piece of a cell: the length that its ray has inside the range, or how much of the
// range it crosses. Names and formulas: fragmentOn in render/model/cell_splat.h. After cell_view.glsl
// and cell_range.glsl.

layout(location = 4) flat in vec4 atAndSteep;
layout(location = 5) flat in vec4 ray;
layout(location = 6) flat in vec4 perSize;
layout(location = 7) flat in vec4 low;
layout(location = 8) flat in vec4 high;
layout(location = 9) flat in uint piece;

const int kPieces = 3;

#ifdef OVER
// C++: CellSlopes in render/splat/cell_slopes.h, of each piece and axis eight.
layout(std430, binding = 2) readonly buffer Slopes { vec4 slopes[]; };

// The gradient by which light falls there, per length in axis coordinates, `at` being a place of the
// cell.
vec3 slopesAt(vec3 at) {
    vec3 g;
    for (uint a = 0u; a < 3u; ++a) {
        const vec4 low = slopes[6u * piece + 2u * a], high = slopes[6u * piece + 2u * a + 1u];
        g[a] = low.x + dot(low.yzw, at) + dot(high.xyz, at.xxy * at.yzz) + high.w * at.x * at.y * at.z;
    }
    return g * perSize.xyz;
}
// What light makes of a colour at a place of the cell, of a ray that goes on along it so, is so long
// and has so much of the way to a lamp in the world.
vec3 lit(vec3 color, vec3 at, vec3 along, float rayLength, float ofRay) {
    if (view.squares.w == 0.0) return color;
    const vec3 g = slopesAt(at);
    return litBy(color, g, dot(g, along / perSize.xyz), atAndSteep.w, rayLength, ofRay);
}
#endif

void main() {
    const vec2 offset = offsetOfPixel();
    const float base = centreAndBase.z;
    const vec3 x = view.perPixelX.xyz * perSize.xyz;
    const vec3 y = view.perPixelY.xyz * perSize.xyz;
    const vec3 shift = offset.x * x + offset.y * y;
    const vec3 at = atAndSteep.xyz + base * shift, along = ray.xyz + shift;
    const vec3 least = vec3(kLeastStep);
    const vec3 stepAlong = mix(max(abs(along), least), -max(abs(along), least), lessThan(along, vec3(0.0)));
    const vec3 middle = -at / stepAlong, reach = abs(0.5 / stepAlong);
    const vec3 enter = middle - reach, leave = middle + reach;
    const float from = max(max(enter.x, enter.y), max(enter.z, view.eye.w - base));
    const float to = min(min(leave.x, leave.y), min(leave.z, hiddenFrom()));
    if (!(to > from)) discard;
    const float longer = longerThanAxis(offset);
    const float whole = view.rayAxis.w * (to - from) * longer;

    // The field's derivatives in the middle, and along the ray from there.
    const float depth = 0.5 * (from + to), halfWay = 0.5 * (to - from);
    const vec3 m = at + depth * along, d = along;
    const vec3 mixed = vec3(high.z + high.w * m.x, high.y + high.w * m.y, high.x + high.w * m.z);
    const vec3 gradient = vec3(low.y + high.y * m.z + mixed.z * m.y,
                               low.z + high.z * m.z + mixed.z * m.x,
                               low.w + high.z * m.y + mixed.y * m.x);
    const float value = low.x + low.y * m.x + m.y * (low.z + high.x * m.x) + m.z * gradient.z;
    const float change = dot(gradient, d);
    const float second = d.x * d.y * mixed.z + d.z * (d.x * mixed.y + d.y * mixed.x);
    const float third = d.x * d.y * d.z * high.w;
    const float first = value - halfWay * (change - halfWay * (second - halfWay * third));
    const float last = value + halfWay * (change + halfWay * (second + halfWay * third));
    float w = whole, width = 0.0;
    float mean = value, lowest = min(first, last), highest = max(first, last);
    if (crossesLeast() || crossesMost()) {
        const vec2 across = (base + depth) * vec2(dot(gradient, x - ray.w * ray.xyz), dot(gradient, y - perSize.w * ray.xyz));
        width = clamp(length(across), 2.0 * kLeastChange, range.w);
        float weighted = 0.0, end = first;
        w = 0.0;
        lowest = 2.0;  // more than f can be
        highest = -2.0;
        for (int k = 1; k <= kPieces; ++k) {
            const float begin = end, way = halfWay * (float(2 * k) / float(kPieces) - 1.0);
            end = value + way * (change + way * (second + way * third));
            const float share = shareIn(begin, end, 1.0 / width);
            const float is = share * max(whole / float(kPieces), abs(end - begin) * range.z);
            w += is;
            weighted += is * valueIn(begin, end, width, share);
            const vec2 ends = withinRange(vec2(min(begin, end), max(begin, end)) +
                                          vec2(-0.5, 0.5) * width);
            if (is > 0.0) lowest = min(lowest, ends.x);
            if (is > 0.0) highest = max(highest, ends.y);
        }
        if (!(w > 0.0)) discard;
        mean = weighted / w;
    }
    // Values that are seen, from the front.
    const float spread = max(min(mean - lowest, highest - mean), 0.0), toBack = last < first ? -spread : spread;
    const float front = mean - toBack, back = mean + toBack;
#if defined(WEIGHT)
    sum = w;
#elif defined(COUNT)
    sum = 1.0;
#elif defined(WEIGHTED_COLOR)
    sum = vec4(colorBetween(front, back) * w, w);
#else
    const float perWeight = layers.style[kind.y].w, depthOfLight = perWeight * w, alpha = opacity(depthOfLight);
    const float met = abs(last - first);
    const float seen = seenTo(front, back, depthOfLight, perWeight * max(whole, met * range.z), met);
    const float rayLength = view.depths.z * longer;
    const vec3 place = m + inRange(value, change, halfWay, depthOfLight) * d;
    sum = vec4(lit(colorBetween(front, seen), place, d, rayLength,
                   lampOfRay(offset, rayLength)) * alpha, alpha);
#endif
}
