// One point of a grid -> the screen square that holds its footprint, and the footprint's coefficients.
// Axis coordinates (render/points/placed_points.h) to window offsets from the view axis, in pixels; formulas:
// render/model/footprint.h.
// After splat_points.glsl.
// Variants: QUADS (two triangles each, else point sprites), SORTED (with QUADS: of a list in order), KERNEL_POINT, CUBES (all cells are equal
// cubes: |d / a| is |d| / a, and the form in d needs no coefficients), CUT (with QUADS: long cells,
// whose slim splats end at the domain's faces), MESH (points lie one by one, their cells in any
// shape; with QUADS, but for KERNEL_POINT).

// C++ mirror: LayerBlock.
layout(std140, binding = 1) uniform Layers {
    vec4 style[8];  // constant linear colour; w: optical depth per weight
    vec4 map[8];    // position in the map = x v + y of the value v on that scale; z: by value: the map's entries, else 0; w: points that a splat stands for
} layers;

layout(binding = 1) uniform sampler2D colorMaps;       // a row a layer, linear colour

// Of a point: its grid index; its value, 0 and 1 at the ends of the narrowest map (ValueScale); its
// layer, of a sorted list kNoLayer where it is clipped; whether it is drawn at all, by its place in
// the sorted step's block of 2^15 points (GlStep): the first and the last that is, and ranks.
#ifdef QUADS
layout(location = 0) uniform uvec4 drawnAndLayer;
// Four corners a point, one point after another of what is bound.
uint corner() { return uint(gl_VertexID) & 3u; }
uint number() { return uint(gl_VertexID) >> 2; }
#ifdef SORTED
// C++ mirror: SortedPoint in render/splat/gl_depth_order.h.
struct SortedPoint {
    uint gridIndex;
    float value;
    uint layer;
};
layout(std430, binding = 0) readonly buffer List { SortedPoint list[]; };
uint gridIndex() { return list[number()].gridIndex; }
float value() { return list[number()].value; }
uint layer() { return list[number()].layer; }
bool isDrawn() { return layer() != kNoLayer; }
#else
layout(std430, binding = 0) readonly buffer GridIndices { uint gridIndices[]; };
layout(std430, binding = 1) readonly buffer Values { float values[]; };  // where a layer is coloured by them
layout(std430, binding = 2) readonly buffer PlacesInBlocks { uint placesInBlocks[]; };  // 16 bits each
uint gridIndex() { return gridIndices[number()]; }
float value() { return values[number()]; }
uint layer() { return drawnAndLayer.w; }
bool isDrawn() {
    const uint place = placesInBlocks[number() >> 1] >> 16u * (number() & 1u) & 0xffffu;
    return isDrawn(place, drawnAndLayer.x, drawnAndLayer.y, drawnAndLayer.z);
}
#endif
#else
layout(location = 0) in uint gridIndexIn;
layout(location = 1) in float valueIn;
layout(location = 2) in uint layerIn;
layout(location = 3) in uint placeInBlock;
layout(location = 4) in uvec3 drawn;
uint gridIndex() { return gridIndexIn; }
float value() { return valueIn; }
uint layer() { return layerIn; }
bool isDrawn() { return isDrawn(placeInBlock, drawn.x, drawn.y, drawn.z) && layerIn != kNoLayer; }
#endif

layout(location = 0) flat out vec4 centreAndWeight;  // window offset of the centre, W's factor, tau per W
layout(location = 1) flat out vec4 quadN;            // n.xyz of the numerator; l.x of the denominator
#if !defined(CUBES) && !defined(KERNEL_POINT)
layout(location = 2) flat out vec4 quadD;            // d.xyz of the denominator; l.y
#endif
#if defined(WEIGHTED_COLOR) || defined(OVER)
layout(location = 3) flat out vec3 color;
#endif
// Of the view, the same for all: llvmpipe reads a uniform block anew for every 16 pixels, which costs
// a tenth of all that a frame of splats does.
layout(location = 4) flat out vec4 windowAndSlopes;

#ifdef CUT
// In kernel space: the centre's ray, and its depth; what a pixel adds to the ray; the faces as seen
// from the centre, and whether one cuts the splat.
layout(location = 5) flat out vec4 kernelC;
layout(location = 6) flat out vec3 kernelX;
layout(location = 7) flat out vec3 kernelY;
layout(location = 8) flat out vec4 loFace;
layout(location = 9) flat out vec3 hiFace;

// kAcrossPlanes in render/model/footprint.h.
vec3 shareBelow(vec3 at) {
    const vec3 u = clamp(at, -1.0, 1.0), v = u * u;
    return u * (2.5868989965218416 + v * (-3.8803104512271367 + v * (4.073761886268686 +
           v * (-2.421745329506627 + v * (0.6981470154212479 + v * (-0.04600672580023147 +
           v * -0.010745391677797065))))));
}
#endif

#if defined(CUT) || defined(MESH)
// Where n - d <= 0, if that is the inside of an ellipse: along which direction it is longest, from
// where to where along it and across. Else the square of this half side.
struct Slim {
    vec2 along, lo, hi;
};
Slim slim(vec3 n, vec3 d, vec2 l, float extent) {
    Slim s = Slim(vec2(1.0, 0.0), vec2(-extent), vec2(extent));
    const vec3 m = n - d;
    const float det = m.x * m.z - 0.25 * m.y * m.y;
    if (!(m.x > 1e-3 * n.x && m.z > 1e-3 * n.z && det > 1e-4 * m.x * m.z)) return s;
    const vec2 middle = vec2(m.z * l.x - 0.5 * m.y * l.y, m.x * l.y - 0.5 * m.y * l.x) / (2.0 * det);
    const float level = 1.0 + 0.5 * dot(l, middle);
    // The eigenvectors of the form.
    const float mean = 0.5 * (m.x + m.z), apart = 0.5 * (m.x - m.z);
    const float root = sqrt(apart * apart + 0.25 * m.y * m.y);
    const float angle = root > 0.0 ? 0.5 * atan(0.5 * m.y, apart) : 0.0;  // of the shortest
    s.along = vec2(-sin(angle), cos(angle));
    const vec2 halfSides = 1.001 * sqrt(level * vec2((mean + root) / det, 1.0 / (mean + root))) + 0.01;
    const vec2 at = vec2(dot(middle, s.along), dot(middle, vec2(s.along.y, -s.along.x)));
    s.lo = at - halfSides;
    s.hi = at + halfSides;
    return s;
}
#endif

#ifdef MESH
// A lower triangular matrix; C++: timeseries::LowerTriangle.
struct Triangle {
    vec3 diagonal, below;
};
vec3 solve(Triangle l, vec3 v) {
    const float x = v.x / l.diagonal.x, y = (v.y - l.below.x * x) / l.diagonal.y;
    return vec3(x, y, (v.z - l.below.y * x - l.below.z * y) / l.diagonal.z);
}

// growthTo and grownTo in render/model/ellipsoid.h: orthogonal rows of m, and of root I beside them.
Triangle grownTo(float least, Triangle m) {
    const float squares = dot(m.diagonal, m.diagonal) + dot(m.below, m.below);
    const vec3 shares = m.diagonal * inversesqrt(squares);
    const float scaled = shares.x * shares.y * shares.z, k = 4.0 * scaled * scaled;
    float t = k;
    for (int i = 0; i < 3; ++i) t = k / ((1.0 - t) * (1.0 - t));
    const float root = sqrt(max(least * least - t * squares, 0.0)), smallest = 1e-9 * least;
    Triangle grown;
    vec3 row = vec3(m.diagonal.x, 0.0, 0.0), beside = vec3(root, 0.0, 0.0);
    grown.diagonal.x = max(sqrt(dot(row, row) + dot(beside, beside)), smallest);
    const vec3 first = row / grown.diagonal.x, besideFirst = beside / grown.diagonal.x;

    row = vec3(m.below.x, m.diagonal.y, 0.0);
    beside = vec3(0.0, root, 0.0);
    grown.below.x = dot(row, first);
    row -= grown.below.x * first;
    beside -= grown.below.x * besideFirst;
    grown.diagonal.y = max(sqrt(dot(row, row) + dot(beside, beside)), smallest);
    const vec3 second = row / grown.diagonal.y, besideSecond = beside / grown.diagonal.y;

    row = vec3(m.below.y, m.below.z, m.diagonal.z);
    beside = vec3(0.0, 0.0, root);
    grown.below.y = dot(row, first);
    row -= grown.below.y * first;
    beside -= grown.below.y * besideFirst;
    grown.below.z = dot(row, second) + dot(beside, besideSecond);
    row -= grown.below.z * second;
    beside -= grown.below.z * besideSecond;
    grown.diagonal.z = max(sqrt(dot(row, row) + dot(beside, beside)), smallest);
    return grown;
}
#endif

vec3 mapColor(uint row, float position) {
    const int last = int(layers.map[row].z) - 1;
    const float at = clamp(position, 0.0, 1.0) * float(last);
    const int below = int(at);
    const int above = min(below + 1, last);
    return mix(texelFetch(colorMaps, ivec2(below, row), 0).rgb,
               texelFetch(colorMaps, ivec2(above, row), 0).rgb, at - float(below));
}

// See sphereExtent in render/model/footprint.h; negative when the outline reaches behind the eye.
float sphereExtent(float depth, float radius, float tanTheta) {
    const float cosTheta = inversesqrt(1.0 + tanTheta * tanTheta);
    const float sinPhi = radius / depth * cosTheta;
    if (sinPhi >= 1.0) return -1.0;
    const float cosSum =
        cosTheta * sqrt(1.0 - sinPhi * sinPhi) - tanTheta * cosTheta * sinPhi;
    return cosSum > 0.0 ? sinPhi / (cosTheta * cosSum) : -1.0;
}

// Window depth as the opaque scene has it; window x and y over the guarded viewport.
void placeAt(vec2 at, float depth) {
    const float guard = view.depths.w;
    const float windowDepth = (depth * view.depths.y + view.depths.z) / depth;
    gl_Position = vec4((at + view.window.xy + guard) / (view.window.zw + 2.0 * guard) * 2.0 - 1.0,
                       windowDepth, 1.0);
}

// How far from the picture's middle a corner may stand: far outside.
float farthestCorner() {
    return 4.0 * (view.window.z + view.window.w);
}
// Of the picture, from the view axis.
vec2 middleOfPicture() {
    return 0.5 * view.window.zw - view.window.xy;
}

void place(vec2 offset, float extent, float depth) {
#ifdef QUADS
    const vec2 side = vec2(corner() & 1u, corner() >> 1) * 2.0 - 1.0;
    // Half a pixel more than the footprint. Each corner has a limit, not the side: the centre may
    // lie farther off than that.
    const vec2 middle = middleOfPicture();
    placeAt(clamp(offset + side * (extent + 0.5), middle - farthestCorner(),
                  middle + farthestCorner()), depth);
#else
    gl_PointSize = extent;
    placeAt(offset, depth);
#endif
}

void main() {
    const Point p = pointOf(gridIndex());
    const vec3 at = p.at, cell = p.diagonal;
    const vec3 inView = (view.viewFromAxes * vec4(at, 1.0)).xyz;
    const float depth = -inView.z;
    const float near = view.depths.x;
    if (!isDrawn() || p.clipped || !(depth > near)) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside the clip volume
#ifndef QUADS
        gl_PointSize = 1.0;
#endif
        return;
    }
    windowAndSlopes = vec4(view.window.xy, view.slopeAndLengths.xy);
    const vec2 focal = vec2(view.perPixelX.w, view.perPixelY.w);
    const vec2 centre = focal * inView.xy / depth;
    const vec3 X = view.perPixelX.xyz, Y = view.perPixelY.xyz;
    const vec3 C = view.rayAxis.xyz + centre.x * X + centre.y * Y;
    const float t = clamp(depth / near - 1.0, 0.0, 1.0);
    const float fade = t * t * (3.0 - 2.0 * t);
    const uint l = min(layer(), 7u);
    const float mass = p.volume * view.kernel.z * fade * layers.map[l].w;

#if defined(WEIGHTED_COLOR) || defined(OVER)
    color = layers.map[l].z > 0.0 ? mapColor(l, layers.map[l].x * value() + layers.map[l].y)
                                  : layers.style[l].rgb;
#endif
    const float depthPerWeight = layers.style[l].w;
#ifdef KERNEL_POINT
    const float side = view.kernel.w;
    centreAndWeight = vec4(centre, mass / (depth * depth * view.slopeAndLengths.w * side * side), depthPerWeight);
    quadN = vec4(0.0);
    // On whole pixels: the rasteriser snaps positions to a fraction of a pixel, on borders wrongly.
    const vec2 first = floor(centre + view.window.xy - 0.5 * (side - 1.0));
    const vec2 middle = first + 0.5 * side - view.window.xy;
#ifdef QUADS
    place(middle, 0.5 * side - 0.5, depth);
#else
    place(middle, side, depth);
#endif
#else
    const float smallest = depth * view.kernel.y;
#ifdef CUBES
    const float a = max(cell.x * view.kernel.x, smallest);
    const vec3 e = cross(C, X), f = cross(C, Y);
    const float zOverA = depth / (a * view.rayAxis.w);
    quadN = vec4(zOverA * zOverA * vec3(dot(e, e), 2.0 * dot(e, f), dot(f, f)), 0.0);
    centreAndWeight = vec4(centre, 1.5915494309189535 * mass / (a * a), depthPerWeight);
    const float widest = a;
#else
#if defined(MESH)
    const Triangle a = grownTo(smallest, Triangle(cell * view.kernel.x, p.below * view.kernel.x));
    const vec3 c = solve(a, C), x = solve(a, X), y = solve(a, Y), sides = a.diagonal;
    const float widest = sqrt(dot(a.diagonal, a.diagonal) + dot(a.below, a.below));
#else
#ifdef CUT
    const vec3 longest = view.domainLo.w * (view.domainHi.xyz - view.domainLo.xyz);
    const vec3 a = max(min(cell * view.kernel.x, longest), vec3(smallest));
#else
    const vec3 a = max(cell * view.kernel.x, vec3(smallest));
#endif
    const vec3 c = C / a, x = X / a, y = Y / a, sides = a;
    const float widest = max(a.x, max(a.y, a.z));
#endif
    const vec3 e = cross(c, x), f = cross(c, y);
    const float perC2 = 1.0 / dot(c, c);
    const vec2 linear = 2.0 * perC2 * vec2(dot(c, x), dot(c, y));
    quadN = vec4(depth * depth * perC2 * vec3(dot(e, e), 2.0 * dot(e, f), dot(f, f)), linear.x);
    quadD = vec4(perC2 * vec3(dot(x, x), 2.0 * dot(x, y), dot(y, y)), linear.y);
    // 5 / pi, and |ray| = |axis| sqrt(1 + slope^2) left to the fragment but for |axis|.
    float weight = 1.5915494309189535 * mass / (sides.x * sides.y * sides.z) * sqrt(perC2) * view.rayAxis.w;
#ifdef CUT
    vec3 lo = (min(view.domainLo.xyz, -view.boxHalf.xyz - smallest) - at) / sides;
    vec3 hi = (max(view.domainHi.xyz, view.boxHalf.xyz + smallest) - at) / sides;
#ifdef MESH  // columns: cut above and below
    lo.xy = vec2(-2.0);
    hi.xy = vec2(2.0);
#endif
    const vec3 inside = 0.5 * (shareBelow(hi) - shareBelow(lo));
    weight /= inside.x * inside.y * inside.z;
    kernelC = vec4(c, depth);
    kernelX = x;
    kernelY = y;
    loFace = vec4(lo, any(greaterThan(lo, vec3(-1.0))) || any(lessThan(hi, vec3(1.0))) ? 1.0 : 0.0);
    hiFace = hi;
#endif
    centreAndWeight = vec4(centre, weight, depthPerWeight);
#endif
    const float onUnitPlane =
        sphereExtent(depth, widest * view.slopeAndLengths.z, length(centre / focal));
    const float extent = onUnitPlane < 0.0 ? 1e9 : onUnitPlane * max(focal.x, focal.y);
#if defined(CUT) || defined(MESH)
    const Slim s = slim(quadN.xyz, quadD.xyz, linear, extent);
    const vec2 across = vec2(s.along.y, -s.along.x), off = middleOfPicture() - centre;
    const vec2 middle = vec2(dot(off, s.along), dot(off, across));
    const vec2 inSlim = clamp(mix(s.lo - 0.5, s.hi + 0.5, vec2(corner() & 1u, corner() >> 1)),
                              middle - farthestCorner(), middle + farthestCorner());
    placeAt(centre + inSlim.x * s.along + inSlim.y * across, depth);
#elif defined(QUADS)
    place(centre, extent, depth);
#else
    // A little more than the diameter: the rasteriser snaps centres to a fraction of a pixel.
    place(centre, 2.0 * extent + 0.0625, depth);
#endif
#endif
}
