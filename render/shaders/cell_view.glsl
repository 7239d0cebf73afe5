// How a view sees cells: put before both shaders of cells and of tetrahedra. A pixel here is a ray,
// of which a picture's pixel may have several (render/model/rays_across.h).

// C++ mirror: CellViewBlock in render/splat/gl_cell_splatter.cpp.
layout(std140, binding = 0) uniform CellView {
    mat4 viewFromAxes;
    vec4 eye;        // in axis coordinates; w: near
    vec4 rayAxis;    // ray of the view axis; w: its length in units of l
    vec4 perPixelX;  // of rays, per pixel; w: pixels per unit of x / -z
    vec4 perPixelY;  // w: pixels per unit of y / -z
    vec4 window;     // window position of the view axis, size in pixels
    vec4 depths;     // view depth of a window depth w: x / (w - y); z: the ray's length in the world
    vec4 squares;    // of gradients: xx, yy, zz; w: light, 0 off, 1 soft, 2 full
    vec4 products;   // xy, xz, yz
    vec4 lamp;       // its part of gradients; w: 0 at the eye, 1 in the world
    vec4 lampOfWay;  // and of ways along the axes
    uvec4 cells;     // along x, y, z
    ivec4 part;      // the picture's pixel that the first is in; z: so many across it
} view;
