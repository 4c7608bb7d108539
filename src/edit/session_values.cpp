#include "edit/session_values.h"

#include "base/quoted.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace knead::session_json {

using nlohmann::json;

namespace {

// Sessions nest five deep; what goes much deeper is an accident or an attack.
constexpr std::size_t deepest_nesting = 32;
// Of a text shown in an error.
constexpr std::size_t longest_shown = 60;

// The beginning of a UTF-8 text, cut between characters.
std::string shortened(std::string text) {
    if (text.size() <= longest_shown) return text;
    std::size_t end = longest_shown;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    text.resize(end);
    return text + "…";
}

// Builds the value as nlohmann::json::parse would, but refuses a key given twice, of which that keeps the
// last without a word, and numbers that overflow.
class Builder final : public nlohmann::json_sax<json> {
public:
    explicit Builder(Parsed& result) : result_(result) {}

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t& /*text*/) override { return add(value); }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t& /*value*/) override { return fail("binary values have no place in a session"); }
    bool start_object(std::size_t /*size*/) override { return open(json::object()); }
    bool end_object() override { return close(); }
    bool start_array(std::size_t /*size*/) override { return open(json::array()); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        const auto [slot, is_new] =
            open_.back()->get_ref<json::object_t&>().emplace(std::move(name), nullptr);
        if (!is_new) return fail('"' + shortened(slot->first) + "\" is given twice; keep one of them");
        slot_ = &slot->second;
        return true;
    }

    bool parse_error(std::size_t position, const std::string& token, const json::exception& error) override {
        result_.is_json = false;
        constexpr int id_of_overflow = 406;
        if (error.id == id_of_overflow) return fail("the number " + shortened(token) + " is too large");
        const std::string_view words = error.what();
        const std::size_t dash = words.find(" - ");
        const std::string_view detail =
            dash == std::string_view::npos ? words : words.substr(dash + std::string_view(" - ").size());
        return fail("not JSON at byte " + std::to_string(position) + ", after '" + shortened(token) +
                    "': " + std::string(detail.substr(0, detail.find("; last read"))));
    }

private:
    json* place(json&& value) {
        if (open_.empty()) return &(result_.value = std::move(value));
        if (!open_.back()->is_array()) return &(*slot_ = std::move(value));
        auto& list = open_.back()->get_ref<json::array_t&>();
        list.push_back(std::move(value));
        return &list.back();
    }
    bool add(json&& value) {
        place(std::move(value));
        return true;
    }
    bool open(json&& container) {
        if (open_.size() == deepest_nesting) return fail("lists and objects are nested too deeply");
        open_.push_back(place(std::move(container)));
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }
    bool fail(std::string words) {
        result_.trouble = std::move(words);
        return false;
    }

    Parsed& result_;
    std::vector<json*> open_; // the lists and objects around the next value, outermost first
    json* slot_ = nullptr;    // of the last key
};

// The value as an error shows it.
std::string shown(const json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "a list of " + std::to_string(value.size());
    return shortened(value.dump(-1, ' ', false, json::error_handler_t::replace)); // arguments may be no UTF-8
}

std::string way_to(const Value& value) {
    if (value.parent == nullptr) return {};
    std::string way = way_to(*value.parent);
    if (value.key.empty()) return way + '[' + std::to_string(value.element) + ']';
    return way + (way.empty() ? "" : ".") + std::string(value.key);
}

std::string named(const Value& value) {
    return value.parent == nullptr ? "the line" : '"' + way_to(value) + '"';
}

template<std::size_t n>
std::array<double, n> numbers(const Value& value, const char* what) {
    if (!value.json->is_array() || value.json->size() != n) refuse_as(value, what);
    std::array<double, n> result{};
    for (std::size_t i = 0; i < n; ++i) result[i] = number(element(value, i));
    return result;
}

} // namespace

Parsed parse_json(std::string_view text) {
    Parsed result;
    // nlohmann::json takes a zero byte for the end of the text, and would not see what follows.
    if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
        result.is_json = false;
        result.trouble = "not JSON at byte " + std::to_string(zero + 1) + ": a zero byte";
        return result;
    }
    Builder builder(result);
    json::sax_parse(text, &builder);
    return result;
}

void refuse(const Value& value, const std::string& words) {
    throw Error(value.place->trouble, value.place->text, named(value) + ' ' + words);
}

void refuse_as(const Value& value, const std::string& what) {
    refuse(value, "must be " + what + ", not " + shown(*value.json));
}

void allow_keys(const Value& object, std::span<const std::string_view> keys) {
    if (!object.json->is_object()) refuse_as(object, "a JSON object");
    for (const auto& [key, unused] : object.json->items()) {
        if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
        std::string allowed;
        for (const std::string_view one : keys) allowed += (allowed.empty() ? "" : ", ") + std::string(one);
        refuse(object, "has an unknown key " + quoted(shortened(key)) + "; what it may have: " + allowed);
    }
}

void allow_keys(const Value& object, std::initializer_list<std::string_view> keys) {
    allow_keys(object, std::span(keys.begin(), keys.size()));
}

Value member(const Value& object, std::string_view key) {
    const std::optional<Value> found = optional_member(object, key);
    if (!found) refuse(object, "has no " + quoted(std::string(key)) + ", which it needs");
    return *found;
}

std::optional<Value> optional_member(const Value& object, std::string_view key) {
    if (!object.json->is_object()) refuse_as(object, "a JSON object");
    const auto found = object.json->find(key);
    if (found == object.json->end()) return std::nullopt;
    return Value{&*found, object.place, &object, key};
}

std::size_t length_of_list(const Value& list) {
    if (!list.json->is_array()) refuse_as(list, "a list");
    return list.json->size();
}

Value element(const Value& list, std::size_t index) {
    return {&(*list.json)[index], list.place, &list, {}, index};
}

double number(const Value& value) {
    if (!value.json->is_number()) refuse_as(value, "a number");
    const double result = value.json->get<double>();
    if (!std::isfinite(result)) refuse_as(value, "a finite number");
    return result;
}

double number_at_least_zero(const Value& value) {
    const double result = number(value);
    if (result < 0) refuse_as(value, "zero or more");
    return result;
}

bool truth(const Value& value) {
    if (!value.json->is_boolean()) refuse_as(value, "true or false");
    return value.json->get<bool>();
}

std::uint64_t whole_number(const Value& value, std::uint64_t lowest, std::uint64_t highest) {
    if (value.json->is_number_unsigned()) {
        const auto result = value.json->get<std::uint64_t>();
        if (result >= lowest && result <= highest) return result;
    }
    const std::string range = highest == largest_whole_number
                                  ? std::to_string(lowest) + " or more, at most 2^53"
                                  : std::to_string(lowest) + " to " + std::to_string(highest);
    refuse_as(value, "a whole number, " + range);
}

namespace {

// The same direction, with a length whose square is a number.
template<typename Vector>
Vector of_a_length(const Vector& vector) {
    return std::isnormal(vector.squaredNorm()) ? vector : Vector(vector / vector.cwiseAbs().maxCoeff());
}

} // namespace

Vec3d vector(const Value& value) {
    const auto [x, y, z] = numbers<3>(value, "three numbers [x,y,z]");
    return {x, y, z};
}

Quatd quaternion(const Value& value) {
    const auto [w, x, y, z] = numbers<4>(value, "a quaternion [w,x,y,z]");
    Quatd result(w, x, y, z);
    if (result.coeffs().isZero(0)) refuse(value, "is a zero quaternion, which is no rotation");
    return Quatd(of_a_length(result.coeffs()));
}

Vec3d direction(const Value& value) {
    const Vec3d result = vector(value);
    if (result.isZero(0)) refuse(value, "is zero, and points nowhere");
    return of_a_length(result);
}

std::string text_not_empty(const Value& value) {
    if (!value.json->is_string()) refuse_as(value, "a text");
    const auto& text = value.json->get_ref<const std::string&>();
    if (text.empty()) refuse(value, "must not be empty");
    return text;
}

} // namespace knead::session_json
