#version 410 core
// The passes over the screen. With BACKGROUND, the background; then over it the points: eye-dome lighting, with
// RELIEF light as well, with PATTERNS the patterns of handles and selection. What is not needed is not compiled
// in: a software renderer takes its time for every line.
//
// Eye-dome lighting: Christian Boucheny, "Visualisation scientifique de grands volumes de données: pour une
// approche perceptive", thesis, Université Joseph Fourier, Grenoble 2009. A pixel is darkened by how far it
// lies behind its neighbours. Here the difference of depths is told in pixels at the depth of the pixel, which
// makes it a slope: neither zooming nor the size of the cloud changes the picture.
//
// src/render/software_screen.cpp computes the same where OpenGL runs in software.

uniform sampler2D colors;
uniform sampler2D depths;
uniform vec3 depth_scale; // difference of depths (0 … 1) to pixels: x / (y + z · depth)
uniform ivec2 taps;       // distances of the near and the far neighbours, in pixels
uniform float grain;      // half the usual diameter of a splat, in pixels
uniform float strength;   // 0: none
uniform vec3 key;         // towards the light, in the camera's axes
uniform vec3 top, bottom; // background
uniform ivec2 last;       // pixel of the screen
uniform float height;     // of the screen, pixels
uniform float pattern;    // pixels in a unit of the patterns
out vec4 result;

float dither(vec2 at) { // Jimenez 2014, interleaved gradient noise: no bands in the dark
    return (fract(52.9829189 * fract(dot(at, vec2(0.06711056, 0.00583715)))) - 0.5) / 255.0;
}

vec3 background() {
    return mix(bottom, top, gl_FragCoord.y / height) + dither(gl_FragCoord.xy);
}

#ifdef BACKGROUND

void main() { result = vec4(background(), 1.0); }

#else

float depth_at(ivec2 at) { return texelFetch(depths, clamp(at, ivec2(0), last), 0).r; }

// The depths of four others, in pixels nearer than the pixel itself, one pixel of the way to them: a slope.
vec4 slopes_to(float depth, float scale, ivec2 at, ivec2 a, ivec2 b, float way) {
    vec4 others = vec4(depth_at(at + a), depth_at(at - a), depth_at(at + b), depth_at(at - b));
    return (depth - others) * (scale / way);
}

// The part of a slope beyond a threshold, at most 3.
vec4 beyond(vec4 slope, float threshold) {
    return clamp(slope - clamp(slope, -threshold, threshold), -3.0, 3.0);
}

// Of the slopes to either side the flatter one: the other may lead over an edge.
float flatter(float there, float back) { return abs(there) < abs(back) ? there : -back; }

// Stripes and dots, told from the bits in alpha (tinting.h), as a brightness.
float pattern_at(vec2 at, int bits) {
    vec2 p = at / pattern;
    float stripe = step(0.5, fract((p.x + p.y) / 9.0));
    vec2 from_dot = fract(vec2(p.x + p.y, p.x - p.y) / 9.0) - 0.5;
    float dot_ = step(dot(from_dot, from_dot), 0.075);
    float lit = 1.0;
    lit *= (bits & 2) != 0 ? mix(0.58, 1.0, stripe) : 1.0;
    lit *= (bits & 4) != 0 ? mix(1.0, 0.55, dot_) : 1.0;
    return lit;
}

// What is selected is hatched in a light colour instead, which no cloud's own colours can be taken for.
vec3 hatched(vec3 color, vec2 at) {
    vec2 p = at / pattern;
    return mix(color, vec3(1.0, 0.95, 0.78), 0.72 * step(0.7, fract((p.x - p.y) / 7.0)));
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 color = texelFetch(colors, at, 0);
    if (color.a == 0.0) discard; // the background is there
    float depth = texelFetch(depths, at, 0).r;
    float scale = depth_scale.x / (depth_scale.y + depth_scale.z * depth);
    vec4 close = slopes_to(depth, scale, at, ivec2(taps.x, 0), ivec2(0, taps.x), float(taps.x));
    vec4 far = slopes_to(depth, scale, at, ivec2(taps.y, taps.y), ivec2(taps.y, -taps.y), 1.41421 * float(taps.y));

    // A plane that is seen at a slant lies behind on one side as far as it lies before on the other: only what is
    // hollow is dark, and what stands out a little lighter. Steps from splat to splat, which are flat, do not count.
    vec4 close_steps = beyond(close, grain / float(taps.x)), far_steps = beyond(far, 0.5 * grain / float(taps.y));
    vec2 hollow_close = max(close_steps.xz + close_steps.yw, -0.5), hollow_far = max(far_steps.xz + far_steps.yw, -0.6);
    float dark = 0.16 * (hollow_close.x + hollow_close.y) + 0.26 * (hollow_far.x + hollow_far.y);
    float shade = exp2(-strength * dark);

#ifdef RELIEF
    // Without normals the far slopes tell how the surface lies to the light.
    vec2 slant = vec2(flatter(far.x, far.y), flatter(far.z, far.w));
    slant = clamp(slant, -3.0, 3.0);
    vec3 normal = vec3(-0.70711 * vec2(slant.x + slant.y, slant.x - slant.y), 1.0);
    float light = 0.5 + 0.5 * dot(normal, key) * inversesqrt(dot(normal, normal));
    shade *= 0.40 + 0.64 * light * light;
#endif
#ifdef PATTERNS
    int bits = int(color.a * 255.0 + 0.5);
    if ((bits & 8) != 0)
        color.rgb = hatched(color.rgb, gl_FragCoord.xy);
    else
        shade *= pattern_at(gl_FragCoord.xy, bits);
#endif
    result = vec4(color.rgb * shade, 1.0);
}

#endif
