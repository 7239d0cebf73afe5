// Accumulated sums -> linear premultiplied colour, blended over the opaque scene. Window space.
// The CPU's version is resolvePixel in render/reference/cpu_splatter.h.
// Variants: OVER (one plane, already composited), or LAYERS n: one plane each. Their number is known
// when compiling, as samplers chosen at run time are slow.

layout(std140, binding = 1) uniform Layers {
    vec4 style[8];  // constant linear colour; w: optical depth per weight
    vec4 map[8];    // z: > 0 when by value
} layers;
#ifdef OVER
layout(binding = 0) uniform sampler2D over;
#elif LAYERS > 0
layout(binding = 0) uniform sampler2D planes[LAYERS];
#endif

layout(location = 0) out vec4 light;

// (1 - e^-t) / t, 1 at 0.
float meanTransmission(float t) {
    if (t > 0.1) return (1.0 - exp(-t)) / t;
    return 1.0 - t * (1.0 / 2.0 - t * (1.0 / 6.0 - t * (1.0 / 24.0 - t * (1.0 / 120.0 - t / 720.0))));
}

void main() {
    const ivec2 at = ivec2(gl_FragCoord.xy);
#ifdef OVER
    light = texelFetch(over, at, 0);
#else
    vec3 glow = vec3(0.0);
    float depth = 0.0;
#if LAYERS > 0
    for (int k = 0; k < LAYERS; ++k) {
        const vec4 sum = texelFetch(planes[k], at, 0);
        const float perWeight = layers.style[k].w;
        const bool byValue = layers.map[k].z > 0.0;
        const float tau = perWeight * (byValue ? sum.a : sum.r);
        depth += tau;
        glow += byValue ? perWeight * sum.rgb : tau * layers.style[k].rgb;
    }
#endif
    if (depth <= 0.0) discard;
    const float mean = meanTransmission(depth);
    light = vec4(glow * mean, depth * mean);
#endif
}
