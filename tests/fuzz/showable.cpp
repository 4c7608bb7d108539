#include "base/require.h"
#include "fuzz/target.h"

#include <algorithm>

namespace knead::fuzz {

void require_showable(std::string_view words, std::string_view place) {
    const auto is_control = [](unsigned char letter) { return letter < 0x20 || letter == 0x7F; };
    constexpr std::size_t longest = 1000;
    require(!words.empty(), "a message has words");
    require(words.size() < longest, "a message is not a page of text");
    require(words.starts_with(place), "a message names its place");
    require(std::none_of(words.begin(), words.end(), is_control), "a message has no control characters");
}

} // namespace knead::fuzz
