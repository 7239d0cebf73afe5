// One pixel of one splat's footprint: W from the pixel ray's distance to the centre in kernel space.
// Window space in, accumulated sums out; formulas: render/model/footprint.h.
// Variants: WEIGHT, WEIGHTED_COLOR, OVER or COUNT (what is accumulated), KERNEL_POINT, CUBES, CUT.

layout(location = 0) flat in vec4 centreAndWeight;
layout(location = 1) flat in vec4 quadN;
layout(location = 4) flat in vec4 windowAndSlopes;
#if !defined(CUBES) && !defined(KERNEL_POINT)
layout(location = 2) flat in vec4 quadD;
#endif
#if defined(WEIGHTED_COLOR) || defined(OVER)
layout(location = 3) flat in vec3 color;
#endif
#ifdef CUT
layout(location = 5) flat in vec4 kernelC;
layout(location = 6) flat in vec3 kernelX;
layout(location = 7) flat in vec3 kernelY;
layout(location = 8) flat in vec4 loFace;
layout(location = 9) flat in vec3 hiFace;

// kAlongRay in render/model/footprint.h.
float shareBelow(float at) {
    const float u = clamp(at, -1.0, 1.0), v = u * u;
    return u * (2.328209850438002 + v * (-2.7162830651268592 + v * (2.0377843444782133 +
           v * (-0.7309657629739267 + v * (0.07952103922902895 + v * (-0.005041042897576919 +
           v * 0.006774636853110604))))));
}

// Splat::insideShare.
float insideShare(vec2 o, float q) {
    const vec3 added = o.x * kernelX + o.y * kernelY;
    const vec3 along = kernelC.xyz + added, h = kernelC.w * added;
    const float dd = dot(along, along);
    const vec3 per = 1.0 / mix(along, vec3(1e-20), lessThan(abs(along), vec3(1e-20)));
    const vec3 one = (loFace.xyz - h) * per, other = (hiFace - h) * per;
    const vec3 least = min(one, other), most = max(one, other);
    const float from = max(max(least.x, least.y), least.z);
    const float to = max(from, min(min(most.x, most.y), most.z));
    const float nearest = -dot(h, along) / dd, perHalf = sqrt(dd / (1.0 - q));
    return 0.5 * (shareBelow((to - nearest) * perHalf) - shareBelow((from - nearest) * perHalf));
}
#endif

#if defined(WEIGHT) || defined(COUNT)
layout(location = 0) out float sum;
#else
layout(location = 0) out vec4 sum;
#endif

// 1 - e^-x; the series where the difference would cancel (its error there is below 1e-9).
float opacity(float x) {
    if (x > 0.1) return 1.0 - exp(-x);
    return x * (1.0 - x * (1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x / 720.0)))));
}

void main() {
    const vec2 at = gl_FragCoord.xy - windowAndSlopes.xy;
    const float ray2 = 1.0 + dot(at * at, windowAndSlopes.zw);
#ifdef KERNEL_POINT
    const float w = centreAndWeight.z * sqrt(ray2);
#else
    const vec2 o = at - centreAndWeight.xy;
    const vec3 squares = vec3(o.x * o.x, o.x * o.y, o.y * o.y);
#ifdef CUBES
    const float q = dot(quadN.xyz, squares) / ray2;
    if (q >= 1.0) discard;
    const float u = (1.0 - q) * (1.0 - q);
    const float w = centreAndWeight.z * u * u;
#else
    const float d = 1.0 + dot(vec2(quadN.w, quadD.w), o) + dot(quadD.xyz, squares);
    const float q = dot(quadN.xyz, squares) / d;
    if (q >= 1.0 || !(d > 1e-6)) discard;  // kLeastDenominator
    const float u = (1.0 - q) * (1.0 - q);
    float w = centreAndWeight.z * sqrt(ray2 / d) * u * u;
#ifdef CUT
    if (loFace.w > 0.0) w *= insideShare(o, q);
    if (!(w > 0.0)) discard;
#endif
#endif
#endif
#if defined(WEIGHT)
    sum = w;
#elif defined(COUNT)
    sum = 1.0;
#elif defined(WEIGHTED_COLOR)
    sum = vec4(color * w, w);
#else
    const float alpha = opacity(centreAndWeight.w * w);
    sum = vec4(color * alpha, alpha);
#endif
}
