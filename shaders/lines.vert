#version 410 core
// A line, or a round point where both ends are one, as a rectangle on the screen: four vertices an instance.

layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 color;
layout(location = 3) in float width;

uniform mat4 to_clip;
uniform vec2 screen;  // pixels
uniform float scale;  // pixels of the screen in one of `width`
uniform float nearer; // how much nearer lines are drawn than they are, so that a surface does not swallow them
flat out vec4 line_color;
flat out vec4 ends;       // in pixels
flat out float half_width;

// Cuts the end `a` off where the line comes out of the near plane.
vec4 before_eye(vec4 a, vec4 b) {
    float da = a.z + a.w, db = b.z + b.w;
    return da < 0.0 && db > 0.0 ? mix(a, b, da / (da - db)) : a;
}

void main() {
    vec4 a = to_clip * vec4(from, 1.0), b = to_clip * vec4(to, 1.0);
    vec4 first = before_eye(a, b), second = before_eye(b, a);
    line_color = color;
    half_width = 0.5 * width * scale;
    ends = vec4((0.5 * first.xy / first.w + 0.5) * screen, (0.5 * second.xy / second.w + 0.5) * screen);
    vec2 along = ends.zw - ends.xy;
    float length = length(along);
    along = length > 1e-4 ? along / length : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    float reach = half_width + 1.0;
    bool at_end = gl_VertexID >= 2;
    vec2 corner = (at_end ? ends.zw + along * reach : ends.xy - along * reach) +
                  across * ((gl_VertexID & 1) == 0 ? reach : -reach);
    vec4 here = at_end ? second : first;
    gl_Position = vec4((2.0 * corner / screen - 1.0) * here.w, here.z - nearer * here.w, here.w);
    if (first.z + first.w < 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
