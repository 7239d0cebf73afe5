// Flat shapes: picture pixels (top left origin, y down) -> clip space.
// C++ mirror of the vertex: FlatVertex in render/annotate/flat_mesh.h.
layout(location = 0) uniform vec2 pictureSize;
layout(location = 0) in vec3 at;
layout(location = 1) in vec4 color;
layout(location = 2) in vec2 texel;
layout(location = 3) in vec2 edge;
layout(location = 0) out vec4 shade;
layout(location = 1) out vec2 glyph;
layout(location = 2) out vec2 distance;

void main() {
    shade = color;
    glyph = texel;
    distance = edge;
    const vec2 up = vec2(at.x, pictureSize.y - at.y);
    gl_Position = vec4(up / pictureSize * 2.0 - 1.0, at.z, 1.0);
}
