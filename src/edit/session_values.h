#pragma once
// Typed access to the JSON of one session line. Private to this room: only session_*.cpp include it.
//
// A Value knows its way from the line's root, so that whatever refuses it can name file, line and key:
// `wave.knead:7: "frames[3].scale" must be …`.

#include "base/error.h"
#include "base/types.h"

#include <nlohmann/json.hpp>

#include <array>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace knead::session_json {

// The largest whole number that every JSON reader keeps exactly.
inline constexpr std::uint64_t largest_whole_number = std::uint64_t{1} << 53;

// Where a text came from and what kind of Error it makes.
struct Place {
    Trouble trouble = Trouble::input;
    std::string text; // "FILE:LINE", or the argument
};

// A JSON text that was read, or what is wrong with it.
// The move of nlohmann::json asserts, which clang-tidy takes for throwing.
struct Parsed { // NOLINT(bugprone-exception-escape)
    nlohmann::json value;
    bool is_json = true; // false: the text is broken, or cut short
    std::string trouble; // empty when all is well; a key given twice and too deep nesting are trouble, too
};

// Reads exactly one JSON value. Time and memory are linear in the text.
Parsed parse_json(std::string_view text);

// A JSON value and the way to it. Parents are referred to and must outlive their children, as they do on the
// stack of a descending reader.
struct Value {
    const nlohmann::json* json = nullptr;
    const Place* place = nullptr;
    const Value* parent = nullptr;
    std::string_view key = {};                                     // in an object; empty in an array
    std::size_t element = std::numeric_limits<std::size_t>::max(); // in an array
};

// Throws the Error `"way.to.the.key" words`; at the root of a line, `the line words`.
[[noreturn]] void refuse(const Value& value, const std::string& words);
// … "must be WHAT, not …", showing the value.
[[noreturn]] void refuse_as(const Value& value, const std::string& what);

// Refuses whatever is not an object, and the first key that is none of these.
void allow_keys(const Value& object, std::span<const std::string_view> keys);
void allow_keys(const Value& object, std::initializer_list<std::string_view> keys);

// A key of an object; refused when it is missing, or nothing.
Value member(const Value& object, std::string_view key);
std::optional<Value> optional_member(const Value& object, std::string_view key);

// Refuses what is not a list; returns how many elements it has.
std::size_t length_of_list(const Value& list);
Value element(const Value& list, std::size_t index);

// Numbers are finite; whole numbers are written without point and exponent.
double number(const Value& value);
double number_at_least_zero(const Value& value);
std::uint64_t whole_number(const Value& value, std::uint64_t lowest, std::uint64_t highest);
Vec3d vector(const Value& value);
// As written, and of a length that can be divided by: its square neither vanishes nor overflows.
Vec3d direction(const Value& value);
Quatd quaternion(const Value& value); // [w,x,y,z]
std::string text_not_empty(const Value& value);
bool truth(const Value& value); // true or false

// One of a few words.
template<typename Choice, std::size_t n>
Choice choice(const Value& value, const std::array<std::pair<std::string_view, Choice>, n>& choices) {
    std::string allowed; // "a", "b" or "c"
    for (std::size_t i = 0; i < n; ++i) {
        const auto& [word, meaning] = choices[i];
        if (value.json->is_string() && value.json->get_ref<const std::string&>() == word) return meaning;
        if (i > 0) allowed += i + 1 == n ? " or " : ", ";
        allowed += '"' + std::string(word) + '"';
    }
    refuse_as(value, allowed);
}

} // namespace knead::session_json
