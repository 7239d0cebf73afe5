// A placard's square, -1 to 1 in x and y: its own space -> clip space.
layout(location = 0) uniform mat4 clipFromPlacard;
layout(location = 0) out vec2 at;  // [0, 1], (0, 0) the lower left corner

void main() {
    at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = clipFromPlacard * vec4(2.0 * at - 1.0, 0.0, 1.0);
}
