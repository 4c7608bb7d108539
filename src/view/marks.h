#pragma once
// One byte a point that says how it is drawn, beside its colour: what the selection and the handles have to
// say about it. The editor writes it, the renderer reads it.

#include <cstddef>
#include <cstdint>

namespace knead {

inline constexpr std::uint8_t mark_hidden = 0x80;
inline constexpr std::uint8_t mark_selected = 0x40;
inline constexpr std::uint8_t mark_handle = 0x3f; // 0: none; else handle_mark() of the handle it belongs to

// The bits of handle number `handle`; beyond 63 handles, looks are used again.
constexpr std::uint8_t handle_mark(std::size_t handle) {
    return static_cast<std::uint8_t>(1 + handle % 63);
}

} // namespace knead
