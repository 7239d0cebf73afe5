// Accumulated sums -> linear premultiplied colour over the opaque scene. Window space.
// The CPU's version is resolvePixel in render/cpu_splatter.h.

layout(std140, binding = 1) uniform Layers {
    vec4 style[8];  // constant linear colour; w: optical depth per weight
    vec4 map[8];    // z: > 0 when by value
} layers;
layout(location = 0) uniform int layerCount;  // -1: the single plane is Over
layout(binding = 0) uniform sampler2D planes[8];
layout(binding = 8) uniform sampler2D opaque;

layout(location = 0) out vec4 light;

// (1 - e^-t) / t, 1 at 0.
float meanTransmission(float t) {
    if (t > 0.1) return (1.0 - exp(-t)) / t;
    return 1.0 - t * (1.0 / 2.0 - t * (1.0 / 6.0 - t * (1.0 / 24.0 - t * (1.0 / 120.0 - t / 720.0))));
}

void main() {
    const ivec2 at = ivec2(gl_FragCoord.xy);
    const vec4 behind = texelFetch(opaque, at, 0);
    if (layerCount < 0) {
        const vec4 over = texelFetch(planes[0], at, 0);
        light = over + (1.0 - over.a) * behind;
        return;
    }
    vec3 glow = vec3(0.0);
    float depth = 0.0;
    for (int k = 0; k < layerCount; ++k) {
        const vec4 sum = texelFetch(planes[k], at, 0);
        const float perWeight = layers.style[k].w;
        const bool byValue = layers.map[k].z > 0.0;
        const float tau = perWeight * (byValue ? sum.a : sum.r);
        depth += tau;
        glow += byValue ? perWeight * sum.rgb : tau * layers.style[k].rgb;
    }
    const float mean = meanTransmission(depth);
    light = vec4(glow * mean, depth * mean) + (1.0 - depth * mean) * behind;
}
