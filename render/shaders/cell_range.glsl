// What the values that a pixel's ray meets in a cell or a tetrahedron have in the range, which
// colours and light that has, and what is accumulated: put before both fragment shaders. Names and
// formulas: render/model/cell_splat.h; of light: render/model/light.h.
// Variants: WEIGHT, WEIGHTED_COLOR, OVER or COUNT: what is accumulated.

// C++ mirror: LayerBlock in render/splat/gl_splatter.cpp.
layout(std140, binding = 1) uniform Layers {
    vec4 style[8];  // constant linear colour; w: optical depth per weight
    vec4 map[8];    // z: by value: the map's entries, else 0
} layers;

layout(binding = 1) uniform sampler2D colorMaps;    // a row a layer, linear colour; then their sums
layout(binding = 2) uniform sampler2D opaqueDepth;  // what hides cells

layout(location = 0) flat in vec4 centreAndBase;
layout(location = 1) flat in vec4 range;  // least, most, per range; the widest ramp
layout(location = 2) flat in vec4 map;    // place of f = 0, per f
layout(location = 3) flat in uvec2 kind;

#if defined(WEIGHT) || defined(COUNT)
layout(location = 0) out float sum;
#else
layout(location = 0) out vec4 sum;
#endif

const int kMaxLayers = 8;
const float kLeastChange = 1e-5, kLeastStep = 1e-12, kLeastDifference = 1e-4;
const float kAmbient = 0.25, kEven = 0.625, kSpecular = 0.35, kLow = 0.25;

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

// The mean of what clamp(x, 0, 1) adds up to from 0 on, between a and b.
float sumAboveRamp(float x) {
    const float on = clamp(x, 0.0, 1.0), past = max(x - 1.0, 0.0);
    return on * on * on / 6.0 + 0.5 * past * (1.0 + past);
}
float meanAboveRamp(float a, float b) {
    if (abs(b - a) >= kLeastDifference) return (sumAboveRamp(b) - sumAboveRamp(a)) / (b - a);
    const float x = 0.5 * (a + b), on = clamp(x, 0.0, 1.0);
    return 0.5 * on * on + max(x - 1.0, 0.0);
}

bool crossesLeast() { return (kind.x & 1u) != 0u; }
bool crossesMost() { return (kind.x & 2u) != 0u; }

// Of a piece between these values, what lies in the range over a pixel of this width of values.
float shareIn(float begin, float end, float perWidth) {
    float share = 1.0;
    if (crossesLeast())
        share = meanRamp((begin - range.x) * perWidth + 0.5, (end - range.x) * perWidth + 0.5);
    if (crossesMost())
        share -= meanRamp((begin - range.y) * perWidth + 0.5, (end - range.y) * perWidth + 0.5);
    return max(share, 0.0);
}
// And of the values there the mean, of which the piece has that share.
float valueIn(float begin, float end, float width, float share) {
    const float least = crossesLeast() ? range.x : -1.0, most = crossesMost() ? range.y : 1.0;
    float sum = 0.5 * (begin + end) - least;
    if (crossesLeast())
        sum = width * meanAboveRamp((begin - least) / width + 0.5, (end - least) / width + 0.5);
    if (crossesMost()) {
        const float a = (begin - most) / width + 0.5, b = (end - most) / width + 0.5;
        sum -= width * meanAboveRamp(a, b) + (most - least) * meanRamp(a, b);
    }
    float value = least + sum / max(share, 1e-30);
    if (crossesLeast() && crossesMost())
        value = mix(0.5 * (least + most), value, clamp(2.0 * (most - least) / width - 0.5, 0.0, 1.0));
    return clamp(value, max(least, -1.0), min(most, 1.0));
}
// The values in the range that are the nearest to these.
vec2 withinRange(vec2 values) {
    return clamp(values, crossesLeast() ? max(range.x, -1.0) : -1.0,
                 crossesMost() ? min(range.y, 1.0) : 1.0);
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
    const vec2 places = clamp(map.x + vec2(a, b) * map.y, 0.0, 1.0) * (layers.map[row].z - 1.0);
    const float way = places.y - places.x;
    if (abs(way) <= 2.0) return entryAt(0.5 * (places.x + places.y), row);
    return (entryAt(places.y, kMaxLayers + row) - entryAt(places.x, kMaxLayers + row)) / way;
}
#endif

#ifdef OVER
// As in render/splat/cell_range-inl.h.
float shareFromFront(float x) { return (1.0 + x / 12.0) / (2.0 + x / 2.0 + x * x / 12.0); }
float seenTo(float front, float back, float x, float whole, float along) {
    const float values = max(abs(back - front), 1e-30), met = max(along, 1e-30);
    const float share = shareFromFront(max(x, whole * min(values / met, 1.0)));
    return front + (1.0 + min(met / values, 1.0) * (2.0 * share - 1.0)) * (back - front);
}

// What light makes of a colour, of a surface, as far as there is one, that faces the eye so much. Of a
// lamp in the world: the gradient's direction has so much of the way to it, and changes so along the
// ray, whose own direction has so much of that way.
vec3 lit(vec3 color, float facing, float certainty, float ofGradient, float change, float ofRay) {
    float towards = facing, between = facing, low = 1.0;
    if (view.lamp.w > 0.0) {
        const float onSide = change > 0.0 ? -ofGradient : ofGradient;
        towards = clamp(onSide, 0.0, 1.0);
        between = clamp((onSide + facing) * inversesqrt(max(2.0 - 2.0 * ofRay, 1e-12)), 0.0, 1.0);
        low = min(towards / kLow, 1.0);
    }
    const float diffuse = kEven + certainty * (kAmbient + (1.0 - kAmbient) * towards - kEven);
    const float specular =
        view.squares.w > 1.0 ? certainty * kSpecular * pow(between, 30.0) * low : 0.0;
    return color * diffuse + specular;
}
// Of a gradient along the axes, which is `change` along a ray, measured against a steepness.
vec3 litBy(vec3 color, vec3 g, float change, float steep, float rayLength, float ofRay) {
    const float g2 = dot(view.squares.xyz, g * g) +
                     dot(view.products.xyz, vec3(g.x * g.y, g.x * g.z, g.y * g.z));
    const float per = inversesqrt(max(g2, 1e-30));
    return lit(color, min(1.0, abs(change) * per / rayLength), 1.0 / (1.0 + steep * per),
               dot(g, view.lamp.xyz) * per, change, ofRay);
}
// From the middle of a ray's way, where the field has that value and changes so, to where, in the mean,
// light leaves what lies in the range, as if it were linear along the ray: of an optical depth x.
float inRange(float value, float change, float halfWay, float x) {
    const float share = shareFromFront(x);
    if (!crossesLeast() && !crossesMost()) return mix(-halfWay, halfWay, share);
    const float per = 1.0 / (change < 0.0 ? min(change, -1e-12) : max(change, 1e-12));
    const vec2 ends = clamp((vec2(crossesLeast() ? range.x : -2.0, crossesMost() ? range.y : 2.0) - value) * per,
                            -halfWay, halfWay);
    return mix(min(ends.x, ends.y), max(ends.x, ends.y), share);
}
#endif

// Of this pixel: how far from the centre, and how much longer its ray is than the view axis'.
vec2 offsetOfPixel() { return gl_FragCoord.xy - view.window.xy - centreAndBase.xy; }
float longerThanAxis(vec2 offset) {
    const vec2 slope = (offset + centreAndBase.xy) / vec2(view.perPixelX.w, view.perPixelY.w);
    return sqrt(1.0 + dot(slope, slope));
}
// What the direction of its ray, which is so long, has of the way to a lamp in the world.
float lampOfRay(vec2 offset, float rayLength) {
    const vec2 pixel = offset + centreAndBase.xy;
    const vec3 ray = view.rayAxis.xyz + pixel.x * view.perPixelX.xyz + pixel.y * view.perPixelY.xyz;
    return dot(ray, view.lampOfWay.xyz) / rayLength;
}
// The depth from the base at which it ends at what is opaque.
float hiddenFrom() {
    const ivec2 pixel = view.part.xy + ivec2(gl_FragCoord.xy) / view.part.z;
    const float opaque = texelFetch(opaqueDepth, pixel, 0).r;
    return opaque < 1.0 ? view.depths.x / (opaque - view.depths.y) - centreAndBase.z : 3e38;
}
