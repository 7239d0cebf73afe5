// A placard's light, linear and opaque. Variant: BOARD, where it bears a picture.
layout(location = 0) in vec2 at;
layout(location = 0) out vec4 light;
#ifdef BOARD
layout(binding = 0) uniform sampler2D board;  // sRGB, decoded by GL
#else
layout(location = 1) uniform vec3 color;
#endif

void main() {
#ifdef BOARD
    light = vec4(texture(board, at).rgb, 1.0);
#else
    light = vec4(color, 1.0);
#endif
}
