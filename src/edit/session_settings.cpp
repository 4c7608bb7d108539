#include "edit/session_settings.h"
#include "base/quoted.h"

#include <algorithm>

namespace knead {

namespace {

using namespace session_json;

constexpr std::array<std::string_view, 7> setting_keys{"neighbors", "samples", "iterations", "stiffness",
                                                       "poisson",   "weights", "strays"};
constexpr std::array<std::pair<std::string_view, InfluenceWeights>, 2> all_weights{
    {{"smooth", InfluenceWeights::smooth}, {"paper", InfluenceWeights::paper}}};
constexpr std::array<std::pair<std::string_view, Strays>, 3> all_strays{
    {{"freeze", Strays::freeze}, {"carry", Strays::carry}, {"bridge", Strays::bridge}}};

std::optional<std::uint64_t> read_samples(const Value& value) {
    if (value.json->is_string() && *value.json == "all") return std::nullopt;
    if (!value.json->is_number_unsigned() || *value.json == 0U)
        refuse_as(value, "a whole number, 1 or more, or \"all\"");
    return whole_number(value, 1, largest_whole_number);
}

double read_stiffness(const Value& value) {
    const double result = number(value);
    if (result <= 0) refuse_as(value, "greater than zero");
    return result;
}

double read_poisson(const Value& value) {
    const double result = number(value);
    if (result <= -1 || result >= 0.5) refuse_as(value, "between -1 and 0.5, both excluded");
    return result;
}

// A bare word of --set is a text, so that nobody needs to quote quotes in a shell.
nlohmann::json value_of_argument(const std::string& text) {
    const Parsed parsed = parse_json(text);
    return parsed.trouble.empty() ? parsed.value : nlohmann::json(text);
}

std::string all_keys() {
    std::string keys;
    for (const std::string_view key : setting_keys) keys += (keys.empty() ? "" : ", ") + std::string(key);
    return keys;
}

} // namespace

SettingsChange session_json::settings_change(const Value& object,
                                             std::initializer_list<std::string_view> besides) {
    std::vector<std::string_view> keys(besides);
    keys.insert(keys.end(), setting_keys.begin(), setting_keys.end());
    allow_keys(object, keys);
    SettingsChange change;
    if (const auto value = optional_member(object, "neighbors"))
        change.neighbors = static_cast<unsigned>(whole_number(*value, 2, 64));
    if (const auto value = optional_member(object, "samples")) change.samples = read_samples(*value);
    if (const auto value = optional_member(object, "iterations"))
        change.iterations = static_cast<unsigned>(whole_number(*value, 0, 1000));
    if (const auto value = optional_member(object, "stiffness")) change.stiffness = read_stiffness(*value);
    if (const auto value = optional_member(object, "poisson")) change.poisson = read_poisson(*value);
    if (const auto value = optional_member(object, "weights")) change.weights = choice(*value, all_weights);
    if (const auto value = optional_member(object, "strays")) change.strays = choice(*value, all_strays);
    return change;
}

Settings changed(Settings settings, const SettingsChange& change) {
    settings.neighbors = change.neighbors.value_or(settings.neighbors);
    if (change.samples) settings.samples = *change.samples;
    settings.iterations = change.iterations.value_or(settings.iterations);
    settings.stiffness = change.stiffness.value_or(settings.stiffness);
    settings.poisson = change.poisson.value_or(settings.poisson);
    settings.weights = change.weights.value_or(settings.weights);
    settings.strays = change.strays.value_or(settings.strays);
    return settings;
}

SettingsChange merged(SettingsChange earlier, const SettingsChange& later) {
    if (later.neighbors) earlier.neighbors = later.neighbors;
    if (later.samples) earlier.samples = later.samples;
    if (later.iterations) earlier.iterations = later.iterations;
    if (later.stiffness) earlier.stiffness = later.stiffness;
    if (later.poisson) earlier.poisson = later.poisson;
    if (later.weights) earlier.weights = later.weights;
    if (later.strays) earlier.strays = later.strays;
    return earlier;
}

SettingsChange parse_setting(std::string_view assignment) {
    const Place place{Trouble::usage, std::string(assignment)};
    const std::size_t equals = assignment.find('=');
    if (equals == 0 || equals == std::string_view::npos)
        throw Error(Trouble::usage, place.text, "a setting is written key=value, as in samples=2000");
    const std::string key(assignment.substr(0, equals));
    if (std::find(setting_keys.begin(), setting_keys.end(), key) == setting_keys.end())
        throw Error(Trouble::usage, place.text,
                    "there is no setting " + quoted(key) + "; there are " + all_keys());
    nlohmann::json object;
    object[key] = value_of_argument(std::string(assignment.substr(equals + 1)));
    return settings_change(Value{&object, &place});
}

} // namespace knead
