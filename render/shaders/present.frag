// Linear premultiplied light -> a display's sRGB bytes; window space.
// Variants: ENCODE, where the framebuffer's format does not encode by itself; DEPTH, where it takes
// the opaque scene's depth; what nobody sees (render/hidden_area_pass.h) is then black and far away.
layout(binding = 0) uniform sampler2D light;
#ifdef DEPTH
layout(binding = 1) uniform sampler2D depth;
#endif
layout(location = 0) uniform ivec2 lowerLeft;
layout(location = 0) out vec4 shown;

#ifdef ENCODE
// srgbFromLinear in render/color.h.
float encoded(float linear) {
    const float inside = linear > 0.0 ? min(linear, 1.0) : 0.0;  // NaN is 0
    return inside <= 0.0031308 ? 12.92 * inside : 1.055 * pow(inside, 1.0 / 2.4) - 0.055;
}
#endif

void main() {
    const ivec2 at = ivec2(gl_FragCoord.xy) - lowerLeft;
    const vec4 premultiplied = texelFetch(light, at, 0);
    vec3 linear = premultiplied.rgb / min(premultiplied.a, 1.0);
#ifdef DEPTH
    const float opaque = texelFetch(depth, at, 0).r;
    const bool hidden = opaque == 0.0;
    gl_FragDepth = hidden ? 1.0 : opaque;
    if (hidden) linear = vec3(0.0);
#endif
#ifdef ENCODE
    shown = vec4(encoded(linear.r), encoded(linear.g), encoded(linear.b), 1.0);
#else
    shown = vec4(linear, 1.0);
#endif
}
