// Coverage of a line's soft edge or of a glyph, times the colour (linear, premultiplied).
layout(binding = 0) uniform sampler2D atlas;  // glyph coverage
layout(location = 1) uniform float leastCoverage;  // what is covered less is not drawn
layout(location = 0) in vec4 shade;
layout(location = 1) in vec2 glyph;
layout(location = 2) in vec2 distance;
layout(location = 0) out vec4 light;

void main() {
    float coverage = clamp(distance.y + 0.5 - abs(distance.x), 0.0, 1.0);
    if (glyph.x >= 0.0) {
        const float value = texelFetch(atlas, ivec2(glyph), 0).r;
        // textCoverage in render/annotate/font.cpp: dark text is filled more, as it looks thinner.
        const float luminance = clamp(dot(shade.rgb, vec3(0.2126, 0.7152, 0.0722)), 0.0, 1.0);
        coverage *= pow(value, mix(0.45, 1.0, sqrt(luminance)));
    }
    if (coverage <= leastCoverage) discard;
    light = shade * coverage;
}
