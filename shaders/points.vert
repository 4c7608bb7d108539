#version 410 core
// A point as a splat. Its colour comes ready with the tint of its handle and the selection; alpha says more:
// 0 is a hidden point, anything else goes through to the pass over the screen (patterns, see compose.frag).

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
layout(location = 2) in vec3 normal;
layout(location = 3) in float width; // where size is by distance: times 2^(width · 255 / 64)

uniform mat4 to_clip;
uniform vec2 size;     // pixels: size.x + size.y / w
uniform vec2 growth;   // pixels to which a splat may grow, and how much of what it grew to it keeps beyond
uniform vec2 extremes; // smallest and largest diameter in pixels
uniform vec3 forward;  // where the camera looks
uniform vec3 key;      // towards the light, in the half space of the viewer
flat out vec4 splat_color;
#ifdef DISCS
uniform float pixel_size; // the length of a pixel at w = 1
uniform vec2 half_field;  // half the view's width and height at w = 1; 0: orthographic
uniform vec3 right, up;   // the camera's other axes
flat out vec2 splat_depth; // see points.frag
flat out vec2 splat_slope;

// How steeply the surface falls away to the right and upwards (slope_of() in src/render/splats.h).
vec2 slope_of(vec2 place) {
    vec2 across = vec2(dot(normal, right), dot(normal, up));
    float along = dot(normal, forward) + dot(half_field * place, across); // the ray to the splat
    float least = max(length(across) / STEEPEST, 1e-6);
    return across / (along > 0.0 ? -max(along, least) : max(-along, least));
}
#endif

void main() {
    gl_Position = to_clip * vec4(position, 1.0);
    float grown = size.x + size.y * exp2(width * (255.0 / 64.0)) / gl_Position.w;
    float diameter = clamp(min(grown, max(growth.x, growth.y * grown)), extremes.x, extremes.y);
    gl_PointSize = diameter;
#ifdef SHADED
    // Both sides are lit: a normal that faces away is turned round.
    float facing = dot(normal, forward);
    float light = dot(normal, key);
    light = 0.5 + (facing > 0.0 ? -0.5 : 0.5) * light;
    splat_color = vec4(color.rgb * (0.40 + 0.64 * light * light), color.a);
#else
    splat_color = color;
#endif
#ifdef DISCS
    float back = BULGE_OVER_DIAMETER * diameter * pixel_size * gl_Position.w;
    vec4 rim = to_clip * vec4(position + forward * back, 1.0);
    float middle = gl_Position.z / gl_Position.w;
    splat_depth = 0.5 * vec2(middle + 1.0, rim.z / rim.w - middle);
#ifdef SHADED
    splat_slope = slope_of(gl_Position.xy / gl_Position.w);
#else
    splat_slope = vec2(0.0);
#endif
#endif
    // Drawn at the far plane, where the depth test drops it: cheaper in software than a point outside.
    if (color.a == 0.0) gl_Position = vec4(0.0, 0.0, 1.0, 1.0);
}
