// The mean of a pixel's rays. Window space of a picture whose pixels have so many rays.

layout(binding = 0) uniform sampler2D rays;
layout(location = 0) uniform ivec3 part;  // the pixel that the first are of; so many across each

layout(location = 0) out vec4 mean;

void main() {
    const ivec2 first = (ivec2(gl_FragCoord.xy) - part.xy) * part.z;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < part.z; ++y)
        for (int x = 0; x < part.z; ++x) sum += texelFetch(rays, first + ivec2(x, y), 0);
    mean = sum / float(part.z * part.z);
}
