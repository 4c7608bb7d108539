#include "edit/session_settings.h"

#include "base/quoted.h"

#include <algorithm>

namespace knead {

namespace {

using namespace session_json;

// Whoever adds a member here has to name it in all_settings, too.
[[maybe_unused]] constexpr bool all_settings_are_named() {
    const SettingsChange change;
    const auto& [neighbors, samples, iterations, stiffness, poisson, weights, strays] = change;
    return std::tuple_size_v<decltype(std::tie(neighbors, samples, iterations, stiffness, poisson, weights,
                                               strays))> == std::tuple_size_v<decltype(all_settings)>;
}
static_assert(all_settings_are_named());

constexpr std::array<std::pair<std::string_view, InfluenceWeights>, 2> all_weights{
    {{"smooth", InfluenceWeights::smooth}, {"paper", InfluenceWeights::paper}}};
constexpr std::array<std::pair<std::string_view, Strays>, 3> all_strays{
    {{"freeze", Strays::freeze}, {"carry", Strays::carry}, {"bridge", Strays::bridge}}};

unsigned read(const Value& value, unsigned Settings::*setting) {
    const bool neighbors = setting == &Settings::neighbors;
    return static_cast<unsigned>(neighbors ? whole_number(value, 2, 64) : whole_number(value, 0, 1000));
}

std::optional<std::uint64_t> read(const Value& value, std::optional<std::uint64_t> Settings::* /*samples*/) {
    if (value.json->is_string() && *value.json == "all") return std::nullopt;
    if (!value.json->is_number_unsigned() || *value.json == 0U)
        refuse_as(value, "a whole number, 1 or more, or \"all\"");
    return whole_number(value, 1, largest_whole_number);
}

double read(const Value& value, double Settings::*setting) {
    const double result = number(value);
    if (setting == &Settings::stiffness && result <= 0) refuse_as(value, "greater than zero");
    if (setting == &Settings::poisson && (result <= -1 || result >= 0.5))
        refuse_as(value, "between -1 and 0.5, both excluded");
    return result;
}

InfluenceWeights read(const Value& value, InfluenceWeights Settings::* /*weights*/) {
    return choice(value, all_weights);
}

Strays read(const Value& value, Strays Settings::* /*strays*/) {
    return choice(value, all_strays);
}

// A bare word of --set is a text, so that nobody needs to quote quotes in a shell.
nlohmann::json value_of_argument(const std::string& text) {
    const Parsed parsed = parse_json(text);
    return parsed.trouble.empty() ? parsed.value : nlohmann::json(text);
}

std::vector<std::string_view> setting_keys() {
    std::vector<std::string_view> keys;
    for_each_setting([&](const auto& setting) { keys.push_back(setting.key); });
    return keys;
}

std::string all_keys() {
    std::string keys;
    for (const std::string_view key : setting_keys()) keys += (keys.empty() ? "" : ", ") + std::string(key);
    return keys;
}

} // namespace

SettingsChange session_json::settings_change(const Value& object,
                                             std::initializer_list<std::string_view> besides) {
    std::vector<std::string_view> keys = setting_keys();
    keys.insert(keys.begin(), besides.begin(), besides.end());
    allow_keys(object, keys);
    SettingsChange change;
    for_each_setting([&](const auto& setting) {
        if (const auto value = optional_member(object, setting.key))
            change.*setting.change = read(*value, setting.value);
    });
    return change;
}

Settings changed(Settings settings, const SettingsChange& change) {
    for_each_setting([&](const auto& setting) {
        if (const auto& wanted = change.*setting.change) settings.*setting.value = *wanted;
    });
    return settings;
}

SettingsChange merged(SettingsChange earlier, const SettingsChange& later) {
    for_each_setting([&](const auto& setting) {
        if (const auto& wanted = later.*setting.change) earlier.*setting.change = wanted;
    });
    return earlier;
}

SettingsChange parse_setting(std::string_view assignment) {
    const Place place{Trouble::usage, std::string(assignment)};
    const std::size_t equals = assignment.find('=');
    if (equals == 0 || equals == std::string_view::npos)
        throw Error(Trouble::usage, place.text, "a setting is written key=value, as in samples=2000");
    const std::string key(assignment.substr(0, equals));
    const std::vector<std::string_view> keys = setting_keys();
    if (std::ranges::find(keys, key) == keys.end())
        throw Error(Trouble::usage, place.text,
                    "there is no setting " + quoted(key) + "; there are " + all_keys());
    nlohmann::json object;
    object[key] = value_of_argument(std::string(assignment.substr(equals + 1)));
    return settings_change(Value{&object, &place});
}

} // namespace knead
