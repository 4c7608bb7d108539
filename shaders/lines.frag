#version 410 core
// As in src/render/software_lines.cpp.
flat in vec4 line_color;
flat in vec4 ends;
flat in float half_width;
out vec4 pixel;

void main() {
    vec2 along = ends.zw - ends.xy, here = gl_FragCoord.xy - ends.xy;
    float t = clamp(dot(here, along) / max(dot(along, along), 1e-6), 0.0, 1.0);
    float cover = clamp(half_width + 0.5 - distance(here, t * along), 0.0, 1.0);
    if (cover == 0.0) discard;
    pixel = vec4(line_color.rgb, line_color.a * cover);
}
