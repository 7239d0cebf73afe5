// The places along the axes of the point or cell `index` of a grid that has so many along each, x
// fastest. C++: indicesOf in timeseries/grid/grid.h.
uvec3 indicesOf(uint index, uvec3 size) {
    const uint row = index / size.x, slice = row / size.y;
    return uvec3(index - row * size.x, row - slice * size.y, slice);
}
