#include "base/control_characters.h"

#include <cstddef>

namespace knead {

std::string without_controls(std::string_view text, std::string_view kept) {
    std::string shown;
    shown.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
        const bool is_c1 = byte == 0xC2 && next >= 0x80 && next < 0xA0;
        const bool is_ascii_control =
            (byte < 0x20 || byte == 0x7F) && kept.find(text[i]) == std::string_view::npos;
        shown += is_c1 || is_ascii_control ? '?' : text[i];
        if (is_c1) ++i;
    }
    return shown;
}

} // namespace knead
