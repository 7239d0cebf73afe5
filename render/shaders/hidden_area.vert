// The pixels that nobody sees, at the near plane. Clip space.
layout(location = 0) in vec2 at;

void main() { gl_Position = vec4(at, 0.0, 1.0); }
