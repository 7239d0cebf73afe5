// One pixel of one piece of a cell: the length that its ray has inside the range, or how much of the
// range it crosses. Names and formulas: fragmentOn in render/model/cell_splat.h; of light:
// render/model/light.h.
// Variants: WEIGHT, WEIGHTED_COLOR, OVER or COUNT: what is accumulated.

layout(std140, binding = 0) uniform CellView {
    mat4 viewFromAxes;
    vec4 eye;
    vec4 rayAxis;
    vec4 perPixelX;
    vec4 perPixelY;
    vec4 window;
    vec4 depths;
    vec4 squares;
    vec4 products;
    uvec4 cells;
} view;

// C++ mirror: LayerBlock in render/splat/gl_splatter.cpp.
layout(std140, binding = 1) uniform Layers {
    vec4 style[8];  // constant linear colour; w: optical depth per weight
    vec4 map[8];    // z: by value: the map's entries, else 0
} layers;

layout(binding = 1) uniform sampler2D colorMaps;    // a row a layer, linear colour; then their sums
layout(binding = 2) uniform sampler2D opaqueDepth;  // what hides cells

layout(location = 0) flat in vec4 centreAndBase;
layout(location = 1) flat in vec4 atAndLeast;
layout(location = 2) flat in vec4 rayAndMost;
layout(location = 3) flat in vec4 perSizeAndRange;
layout(location = 4) flat in vec4 low;
layout(location = 5) flat in vec4 high;
layout(location = 6) flat in vec4 mapAndSteep;
layout(location = 7) flat in uvec2 kind;

#if defined(WEIGHT) || defined(COUNT)
layout(location = 0) out float sum;
#else
layout(location = 0) out vec4 sum;
#endif

const int kPieces = 3, kMaxLayers = 8;
const float kLeastChange = 1e-5, kLeastStep = 1e-12;
const float kAmbient = 0.25, kEven = 0.625, kSpecular = 0.35;

// 1 - e^-x; the series where the difference would cancel (its error there is below 1e-9).
float opacity(float x) {
    if (x > 0.1) return 1.0 - exp(-x);
    return x * (1.0 - x * (1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x / 720.0)))));
}

// The mean of clamp(x, 0, 1) between a and b.
float meanRamp(float a, float b) {
    const float ca = clamp(a, 0.0, 1.0), cb = clamp(b, 0.0, 1.0), between = b - a;
    if (abs(between) < kLeastStep) return 0.5 * (ca + cb);
    return ((cb - ca) * (cb + ca) * 0.5 + (max(b, 1.0) - max(a, 1.0))) / between;
}

#if defined(WEIGHTED_COLOR) || defined(OVER)
// Of a place among a row's entries: a layer's map, linear, or from kMaxLayers on its sums.
vec3 entryAt(float place, int row) {
    const int below = min(int(place), int(layers.map[kind.y].z) - 2);
    return mix(texelFetch(colorMaps, ivec2(below, row), 0).rgb,
               texelFetch(colorMaps, ivec2(below + 1, row), 0).rgb, place - float(below));
}
// The mean of the colours of all values of f between these.
vec3 colorBetween(float a, float b) {
    const int row = int(kind.y);
    if (layers.map[row].z == 0.0) return layers.style[row].rgb;
    const vec2 places = clamp(mapAndSteep.x + vec2(a, b) * mapAndSteep.y, 0.0, 1.0) * (layers.map[row].z - 1.0);
    const float way = places.y - places.x;
    if (abs(way) <= 2.0) return entryAt(0.5 * (places.x + places.y), row);
    return (entryAt(places.y, kMaxLayers + row) - entryAt(places.x, kMaxLayers + row)) / way;
}
#endif

#ifdef OVER
// As in render/splat/cell_range-inl.h.
float seenTo(float front, float back, float x, float along, float width) {
    const float hiding = along / max(along + width, 1e-30);
    const float share = (1.0 + x / 12.0) / (2.0 + x / 2.0 + x * x / 12.0);
    return front + (1.0 + hiding * (2.0 * share - 1.0)) * (back - front);
}

// What light makes of a colour, where the field has this gradient per length in axis coordinates
// and changes so along the ray, which is so long.
vec3 lit(vec3 color, vec3 g, float change, float rayLength) {
    if (view.squares.w == 0.0) return color;
    const float g2 = dot(view.squares.xyz, g * g) +
                     dot(view.products.xyz, vec3(g.x * g.y, g.x * g.z, g.y * g.z));
    const float per = inversesqrt(max(g2, 1e-30));
    const float certainty = 1.0 / (1.0 + mapAndSteep.z * per);
    const float facing = min(1.0, abs(change) * per / rayLength);
    const float diffuse = kEven + certainty * (kAmbient + (1.0 - kAmbient) * facing - kEven);
    const float specular =
        view.squares.w > 1.0 ? certainty * kSpecular * pow(facing, 30.0) : 0.0;
    return color * diffuse + specular;
}
#endif

void main() {
    const vec2 offset = gl_FragCoord.xy - view.window.xy - centreAndBase.xy;
    const float base = centreAndBase.z;
    const vec3 x = view.perPixelX.xyz * perSizeAndRange.xyz;
    const vec3 y = view.perPixelY.xyz * perSizeAndRange.xyz;
    const vec3 shift = offset.x * x + offset.y * y;
    const vec3 at = atAndLeast.xyz + base * shift, along = rayAndMost.xyz + shift;
    const vec3 least = vec3(kLeastStep);
    const vec3 stepAlong = mix(max(abs(along), least), -max(abs(along), least), lessThan(along, vec3(0.0)));
    const vec3 middle = -at / stepAlong, reach = abs(0.5 / stepAlong);
    const vec3 enter = middle - reach, leave = middle + reach;
    const float opaque = texelFetch(opaqueDepth, ivec2(gl_FragCoord.xy), 0).r;
    const float hidden = opaque < 1.0 ? view.depths.x / (opaque - view.depths.y) - base : 3e38;
    const float from = max(max(enter.x, enter.y), max(enter.z, view.eye.w - base));
    const float to = min(min(leave.x, leave.y), min(leave.z, hidden));
    if (!(to > from)) discard;
    const vec2 slope = (offset + centreAndBase.xy) / vec2(view.perPixelX.w, view.perPixelY.w);
    const float longer = sqrt(1.0 + dot(slope, slope));
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
    const bool crossesLeast = (kind.x & 1u) != 0u, crossesMost = (kind.x & 2u) != 0u;
    if (crossesLeast || crossesMost) {
        const vec2 across = (base + depth) * vec2(dot(gradient, x), dot(gradient, y));
        width = max(length(across), 2.0 * kLeastChange);
        const float perWidth = 1.0 / width;
        const float leastIn = crossesLeast ? max(atAndLeast.w, -1.0) : -1.0;
        const float mostIn = crossesMost ? min(rayAndMost.w, 1.0) : 1.0;
        float weighted = 0.0, end = first;
        w = 0.0;
        lowest = 2.0;  // more than f can be
        highest = -2.0;
        for (int k = 1; k <= kPieces; ++k) {
            const float begin = end, way = halfWay * (float(2 * k) / float(kPieces) - 1.0);
            end = value + way * (change + way * (second + way * third));
            float share = 1.0;
            if (crossesLeast)
                share = meanRamp((begin - atAndLeast.w) * perWidth + 0.5,
                                 (end - atAndLeast.w) * perWidth + 0.5);
            if (crossesMost)
                share -= meanRamp((begin - rayAndMost.w) * perWidth + 0.5,
                                  (end - rayAndMost.w) * perWidth + 0.5);
            const float is = max(share, 0.0) *
                             max(whole / float(kPieces), abs(end - begin) * perSizeAndRange.w);
            w += is;
            const float lower = clamp(min(begin, end) - 0.5 * width, leastIn, mostIn);
            const float upper = clamp(max(begin, end) + 0.5 * width, leastIn, mostIn);
            weighted += 0.5 * is * (lower + upper);
            if (is > 0.0) lowest = min(lowest, lower);
            if (is > 0.0) highest = max(highest, upper);
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
    const float depthOfLight = layers.style[kind.y].w * w, alpha = opacity(depthOfLight);
    const float seen = seenTo(front, back, depthOfLight, abs(last - first), width);
    sum = vec4(lit(colorBetween(front, seen), gradient * perSizeAndRange.xyz, change, view.depths.z * longer) *
                   alpha, alpha);
#endif
}
