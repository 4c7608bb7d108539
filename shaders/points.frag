#version 410 core
// A splat that is wide enough is a disc in the surface that bulges a little: src/render/splats.h tells how.
flat in vec4 splat_color;
#ifdef DISCS
flat in vec2 splat_depth; // at the middle, and how much more the bulge makes it at the rim
flat in vec2 splat_slope; // to the right and upwards
#endif
out vec4 pixel;

void main() {
#ifdef DISCS
    vec2 from_middle = 2.0 * gl_PointCoord - 1.0;
    float fall = dot(splat_slope, vec2(from_middle.x, -from_middle.y));
    float squared = dot(from_middle, from_middle) + 0.5 * fall * fall;
    if (squared > 1.0) discard;
    gl_FragDepth = splat_depth.x + splat_depth.y * (squared + TILT_OVER_BULGE * fall);
#endif
    pixel = splat_color;
}
