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

layout(binding = 1) uniform sampler2D colorMaps;    // a row a layer, linear colour
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

const int kPieces = 3;
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
// Of this value of f, linear.
vec3 colorOf(float value) {
    const int entries = int(layers.map[kind.y].z), row = int(kind.y);
    if (entries == 0) return layers.style[kind.y].rgb;
    const float at = clamp(mapAndSteep.x + value * mapAndSteep.y, 0.0, 1.0) * float(entries - 1);
    const int below = min(int(at), entries - 2);
    return mix(texelFetch(colorMaps, ivec2(below, row), 0).rgb,
               texelFetch(colorMaps, ivec2(below + 1, row), 0).rgb, at - float(below));
}
#endif

#ifdef OVER
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
    float value = low.x + low.y * m.x + m.y * (low.z + high.x * m.x) + m.z * gradient.z;
    const float change = dot(gradient, d);
    float w = whole;
    const bool crossesLeast = (kind.x & 1u) != 0u, crossesMost = (kind.x & 2u) != 0u;
    if (crossesLeast || crossesMost) {
        const float second = d.x * d.y * mixed.z + d.z * (d.x * mixed.y + d.y * mixed.x);
        const float third = d.x * d.y * d.z * high.w;
        const vec2 across = (base + depth) * vec2(dot(gradient, x), dot(gradient, y));
        const float width = max(length(across), 2.0 * kLeastChange), perWidth = 1.0 / width;
        const float leastIn = crossesLeast ? max(atAndLeast.w, -1.0) : -1.0;
        const float mostIn = crossesMost ? min(rayAndMost.w, 1.0) : 1.0;
        float weighted = 0.0, end = value - halfWay * (change - halfWay * (second - halfWay * third));
        const float middleValue = value;
        w = 0.0;
        for (int k = 1; k <= kPieces; ++k) {
            const float begin = end, way = halfWay * (float(2 * k) / float(kPieces) - 1.0);
            end = middleValue + way * (change + way * (second + way * third));
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
            weighted += 0.5 * is * (clamp(min(begin, end) - 0.5 * width, leastIn, mostIn) +
                                    clamp(max(begin, end) + 0.5 * width, leastIn, mostIn));
        }
        if (!(w > 0.0)) discard;
        value = weighted / w;
    }
#if defined(WEIGHT)
    sum = w;
#elif defined(COUNT)
    sum = 1.0;
#elif defined(WEIGHTED_COLOR)
    sum = vec4(colorOf(value) * w, w);
#else
    const float alpha = opacity(layers.style[kind.y].w * w);
    sum = vec4(lit(colorOf(value), gradient * perSizeAndRange.xyz, change, view.depths.z * longer) *
                   alpha, alpha);
#endif
}
