// A plane of coarse pixels in the pixels of the picture: between the middles of coarse ones, what
// lies around them. Window space. The program's version is in render/frame/enlarge.h.

layout(binding = 0) uniform sampler2D coarse;
layout(location = 0) uniform ivec4 known;  // lower left corner and size: beyond, there is nothing
layout(location = 1) uniform int across;

layout(location = 0) out vec4 sum;

vec4 at(ivec2 pixel) {
    const ivec2 inside = pixel - known.xy;
    const bool isIn = all(greaterThanEqual(inside, ivec2(0))) && all(lessThan(inside, known.zw));
    return isIn ? texelFetch(coarse, pixel, 0) : vec4(0.0);
}

void main() {
    const vec2 place = gl_FragCoord.xy / float(across) - 0.5;
    const ivec2 first = ivec2(floor(place));
    const vec2 share = place - vec2(first);
    const vec4 below = mix(at(first), at(first + ivec2(1, 0)), share.x);
    const vec4 above = mix(at(first + ivec2(0, 1)), at(first + ivec2(1, 1)), share.x);
    sum = mix(below, above, share.y);
}
