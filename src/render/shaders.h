#pragma once
// Private to this room: the texts of shaders/, built in.

namespace knead::embedded {

extern const char* const points_vert;
extern const char* const points_frag;
extern const char* const screen_vert;
extern const char* const compose_frag;
extern const char* const lines_vert;
extern const char* const lines_frag;

} // namespace knead::embedded
