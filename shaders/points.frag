#version 410 core
flat in vec4 splat_color;
#ifdef CURVED
flat in vec2 splat_depth; // at the middle, and how much more at the rim
#endif
out vec4 pixel;

void main() {
#ifdef ROUND
    vec2 from_middle = 2.0 * gl_PointCoord - 1.0;
    float squared = dot(from_middle, from_middle);
    if (squared > 1.0) discard;
#endif
#ifdef CURVED
    gl_FragDepth = splat_depth.x + splat_depth.y * squared;
#endif
    pixel = splat_color;
}
