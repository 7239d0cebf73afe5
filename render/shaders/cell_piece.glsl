// A cell of an upright grid, or an octant of one, with one range. C++ mirror: GlCell in
// render/splat/gl_cells.h.
struct Piece {
    uint cell, kind;
    float least, most, perRange, mapPlace, mapPerValue, steep;
    vec4 low, high;  // f
};
const uint kWholeCell = 8u;  // of kind's bits 0 to 3, which else say which octant
