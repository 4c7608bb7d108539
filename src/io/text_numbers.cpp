#include "io/text_numbers.h"

#include "base/error.h"
#include "base/require.h"
#include "io/scalar_bytes.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace knead {

namespace {

// Numbers as programs write them beyond the standard: a plus sign, and what old Windows libraries print.
template<typename Real>
bool parse_odd_real(std::string_view word, Real& value) {
    const bool has_plus = word.starts_with('+');
    if (has_plus) word.remove_prefix(1);
    if (word.empty() || (has_plus && word.starts_with('-'))) return false;
    const auto [end, trouble] = fast_float::from_chars(word.data(), word.data() + word.size(), value);
    // Out of range leaves an infinity or a zero, the nearest that there is.
    if (trouble != std::errc::invalid_argument && end == word.data() + word.size()) return true;
    const bool negative = word.starts_with('-');
    if (negative) word.remove_prefix(1);
    if (word.starts_with("1.#INF"))
        value = negative ? -std::numeric_limits<Real>::infinity() : std::numeric_limits<Real>::infinity();
    else if (word.starts_with("1.#IND") || word.starts_with("1.#QNAN") || word.starts_with("1.#SNAN") ||
             word == "nan(ind)" || word == "nan(snan)")
        value = std::numeric_limits<Real>::quiet_NaN();
    else
        return false;
    return true;
}

// Parses the word at text.at and moves behind it; false, and no move, where it is no number of this type.
template<typename Real>
bool parse_real(TextCursor& text, std::byte* to) {
    Real value{};
    const auto [end, trouble] = fast_float::from_chars(text.at, text.end, value);
    if (trouble == std::errc{} && (end == text.end || is_blank(*end) || is_line_end(*end))) {
        text.at = end;
    } else {
        const char* const stop = word_end(text);
        if (!parse_odd_real({text.at, stop}, value)) return false;
        text.at = stop;
    }
    std::memcpy(to, &value, sizeof value);
    return true;
}

template<typename Integer>
bool parse_integer(TextCursor& text, std::byte* to) {
    const char* const stop = word_end(text);
    Integer value{};
    const auto [end, trouble] = std::from_chars(text.at, stop, value);
    if (trouble != std::errc{} || end != stop) {
        // Some programs write whole numbers as "255.0".
        double real = 0;
        if (!parse_odd_real({text.at, stop}, real) || real != std::floor(real) ||
            real < static_cast<double>(std::numeric_limits<Integer>::min()) ||
            real >= std::ldexp(1.0, std::numeric_limits<Integer>::digits))
            return false;
        value = static_cast<Integer>(real);
    }
    text.at = stop;
    std::memcpy(to, &value, sizeof value);
    return true;
}

} // namespace

bool parse_scalar(TextCursor& text, ScalarType type, std::byte* to) {
    switch (type) {
    case ScalarType::int8:
        return parse_integer<std::int8_t>(text, to);
    case ScalarType::uint8:
        return parse_integer<std::uint8_t>(text, to);
    case ScalarType::int16:
        return parse_integer<std::int16_t>(text, to);
    case ScalarType::uint16:
        return parse_integer<std::uint16_t>(text, to);
    case ScalarType::int32:
        return parse_integer<std::int32_t>(text, to);
    case ScalarType::uint32:
        return parse_integer<std::uint32_t>(text, to);
    case ScalarType::int64:
        return parse_integer<std::int64_t>(text, to);
    case ScalarType::uint64:
        return parse_integer<std::uint64_t>(text, to);
    case ScalarType::float32:
        return parse_real<float>(text, to);
    case ScalarType::float64:
        return parse_real<double>(text, to);
    }
    return false;
}

bool parse_word(std::string_view word, ScalarType type, std::byte* to) {
    TextCursor text{word.data(), word.data() + word.size()};
    return parse_scalar(text, type, to) && text.at == text.end;
}

std::size_t print_scalar(double value, ScalarType type, std::span<char> to) {
    std::array<std::byte, 8> stored{};
    store_scalar(value, type, stored.data());
    return print_stored(stored.data(), type, to);
}

std::size_t print_stored(const std::byte* from, ScalarType type, std::span<char> to) {
    const auto print = [to](auto typed) {
        const auto [end, trouble] = std::to_chars(to.data(), to.data() + to.size(), typed);
        require(trouble == std::errc{}, "a number fits its buffer");
        return static_cast<std::size_t>(end - to.data());
    };
    const auto load = [from](auto typed) {
        std::memcpy(&typed, from, sizeof typed);
        return typed;
    };
    if (type == ScalarType::float64) return print(load(double{}));
    if (type == ScalarType::float32) return print(load(float{}));
    if (type == ScalarType::uint64) return print(load(std::uint64_t{}));
    return print(load_integer(from, type, false));
}

void append_number(std::string& text, double value, ScalarType type) {
    std::array<char, 64> buffer{};
    text.append(buffer.data(), print_scalar(value, type, buffer));
}

std::size_t line_of(std::span<const std::byte> bytes, std::size_t at) {
    std::size_t line = 1;
    for (std::size_t i = 0; i < at; ++i) {
        const bool lone_return = bytes[i] == std::byte{'\r'} && bytes[i + 1] != std::byte{'\n'};
        if (bytes[i] == std::byte{'\n'} || lone_return) ++line;
    }
    return line;
}

void fail_at(std::span<const std::byte> bytes, std::size_t at, const std::string& shown,
             const std::string& words) {
    const std::size_t line = bytes.empty() ? 1 : line_of(bytes, std::min(at, bytes.size() - 1));
    throw Error(Trouble::input, shown + ":" + std::to_string(line), words);
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string shown = "'";
    for (const char letter : text.substr(0, longest)) shown += letter >= ' ' && letter <= '~' ? letter : '?';
    return shown + (text.size() > longest ? "…'" : "'");
}

} // namespace knead
