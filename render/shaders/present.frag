// Linear premultiplied light -> a display's sRGB bytes; window space.
// Variants: SCALED, of another size than the light's; ENCODE, where the framebuffer's format does not encode by itself; DEPTH, where it takes
// the opaque scene's depth; what nobody sees (render/annotate/hidden_area_pass.h) is then black and far away.
layout(binding = 0) uniform sampler2D light;
#ifdef DEPTH
layout(binding = 1) uniform sampler2D depth;
#endif
layout(location = 0) uniform ivec2 lowerLeft;
#ifdef SCALED
layout(location = 1) uniform ivec2 size;
layout(location = 2) uniform ivec2 lightSize;
#endif
layout(location = 0) out vec4 shown;

#ifdef ENCODE
// srgbFromLinear in render/image/color.h, 1.055 x^(1/2.4) - 0.055 as a polynomial in x^(1/4), interpolated
// at Chebyshev's points: to 2.2e-6, of a byte's 3.9e-3. A power costs llvmpipe several times as much.
vec3 encoded(vec3 linear) {
    const vec3 inside = mix(vec3(0.0), min(linear, 1.0), greaterThan(linear, vec3(0.0)));  // NaN is 0
    const vec3 s = sqrt(sqrt(inside));
    const vec3 curve = -0.05973901135623381 + s * (0.1419582632365757 + s * (1.3545726486376297 +
        s * (-0.8252800165996645 + s * (0.6210022840852661 + s * (-0.29424763719151525 +
        s * 0.06173430754682886)))));
    return mix(curve, 12.92 * inside, lessThanEqual(inside, vec3(0.0031308)));
}
#endif

#ifdef SCALED
// Bilinear, between the four nearest.
vec4 lightAround(vec2 at) {
    const vec2 from = floor(at - 0.5), part = at - 0.5 - from;
    const ivec2 last = lightSize - 1;
    const ivec2 lo = clamp(ivec2(from), ivec2(0), last), hi = clamp(ivec2(from) + 1, ivec2(0), last);
    return mix(mix(texelFetch(light, lo, 0), texelFetch(light, ivec2(hi.x, lo.y), 0), part.x),
               mix(texelFetch(light, ivec2(lo.x, hi.y), 0), texelFetch(light, hi, 0), part.x), part.y);
}
#endif

void main() {
#ifdef SCALED
    const vec4 premultiplied =
        lightAround((gl_FragCoord.xy - vec2(lowerLeft)) * vec2(lightSize) / vec2(size));
#else
    const ivec2 at = ivec2(gl_FragCoord.xy) - lowerLeft;
    const vec4 premultiplied = texelFetch(light, at, 0);
#endif
    vec3 linear = premultiplied.rgb / min(premultiplied.a, 1.0);
#ifdef DEPTH
    const float opaque = texelFetch(depth, at, 0).r;
    const bool hidden = opaque == 0.0;
    gl_FragDepth = hidden ? 1.0 : opaque;
    if (hidden) linear = vec3(0.0);
#endif
#ifdef ENCODE
    // A whole step: a GPU's own rounding to bytes may be off by a hundredth.
    shown = vec4(floor(255.0 * encoded(linear) + 0.5) / 255.0, 1.0);
#else
    shown = vec4(linear, 1.0);
#endif
}
