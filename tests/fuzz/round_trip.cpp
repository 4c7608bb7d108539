#include "fuzz/round_trip.h"

#include "base/error.h"
#include "base/require.h"
#include "base/whole_file.h"
#include "fuzz/target.h"
#include "io/format.h"
#include "support/scratch_folder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

namespace knead::fuzz {

namespace {

struct Saved {
    std::vector<std::byte> bytes;
    bool says_something = false; // about what the format does not hold
};

// The file after a save; nothing where the target cannot hold what is asked for.
std::optional<Saved> saved(const Format& format, const PointCloud& cloud, const PosedShape& shape) {
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder / ("saved" + std::string(format.extensions.front()));
    SilentProgress progress;
    std::vector<std::string> heard;
    try {
        heard = write_cloud(file, cloud, shape, progress);
    } catch (const Error& error) {
        require(error.trouble() == Trouble::output, "what cannot be saved is an error of output");
        require_showable(error.what(), file.string());
        require(!std::filesystem::exists(file), "a save that fails leaves nothing behind");
        return std::nullopt;
    }
    for (const std::string& words : heard) require_showable(words, "");
    return Saved{read_whole_file(file, progress), !heard.empty()};
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

double rounded_to(ScalarType type, double value) {
    if (type == ScalarType::float64) return value;
    if (type == ScalarType::float32) return static_cast<double>(static_cast<float>(value));
    return std::nearbyint(value) + 0.0; // whole numbers know no -0
}

void require_same_column(const Attribute& before, const Attribute& after) {
    require(before.name == after.name && before.type == after.type, "a column keeps its name and type");
    require(before.first == after.first, "a list keeps its lengths");
    require(before.values == after.values, "a column that no pose changes keeps its values");
}

// --- An edit: points moved, normals turned, a column added -------------------------------------------------

struct Edit {
    std::vector<float> positions;
    std::vector<float> normals;
    std::vector<float> weights; // of the column "weight"

    PosedShape shape() const { return {positions, normals, {{"weight", weights}}}; }
};

Edit edit_of(const PointCloud& cloud) {
    Edit edit{cloud.positions, read_normals(cloud), {}};
    for (std::size_t i = 0; i < edit.positions.size(); ++i) // every third point stays
        if (i / 3 % 3 != 2) edit.positions[i] += static_cast<float>(i % 5) - 1.75F;
    for (std::size_t i = 0; i + 2 < edit.normals.size(); i += 3) // about the diagonal
        std::rotate(&edit.normals[i], &edit.normals[i] + 1, &edit.normals[i] + 3);
    for (std::size_t i = 0; i < cloud.size(); ++i) edit.weights.push_back(static_cast<float>(i) / 7);
    return edit;
}

// What a coordinate of point i is to be after the edit.
double coordinate_after(const PointCloud& cloud, const Edit& edit, std::size_t axis, std::size_t i) {
    const Attribute& column = cloud.attributes[cloud.coordinate_columns[axis]];
    const double own = value_at(column, i);
    const float rest = cloud.positions[3 * i + axis];
    const float posed = edit.positions[3 * i + axis];
    if (posed == rest || !std::isfinite(rest)) return own;
    const double moved = own + (static_cast<double>(posed) - static_cast<double>(rest));
    const double rounded = rounded_to(column.type, moved);
    return rounded == own ? own : rounded;
}

double normal_after(const Attribute& column, float posed, std::size_t i) {
    const double own = value_at(column, i);
    const bool stays = !std::isfinite(posed) || posed == static_cast<float>(own);
    if (stays || !is_whole(column.type)) return stays ? own : static_cast<double>(posed);
    const double highest = std::pow(2.0, 8 * static_cast<double>(size_of(column.type)) - 1) - 1;
    return std::clamp(std::nearbyint(static_cast<double>(posed)), -highest - 1, highest);
}

// What the checks of an edit share.
struct Edited {
    const PointCloud& before;
    const Edit& edit;
    const PointCloud& after;
    const Looseness& looseness;
    bool says_something;

    // Whether a value is what it should be, or next to it where the file's values lie further apart.
    bool holds(std::size_t column, std::size_t i, double expected) const {
        const double value = value_at(after.attributes[column], i);
        if (same_bits(value, expected)) return true;
        // Numbers of a text with no types; what was computed as a float is written as the float's shortest
        // text.
        const bool is_float =
            looseness.guesses_columns && static_cast<float>(value) == static_cast<float>(expected);
        if (is_float) return true;
        if (looseness.step == nullptr) return false;
        const double step = std::max(looseness.step(before, column), looseness.step(after, column));
        if (step == 0) return false;
        const double rounding = 1e-14 * std::max(std::abs(value), std::abs(expected));
        // A normal that the file's numbers cannot hold stays as it was.
        const bool stays = same_bits(value, value_at(before.attributes[column], i));
        return stays || std::abs(value - expected) <= 0.51 * step + rounding;
    }
};

void require_moved(const Edited& edited, std::vector<bool>& changes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = edited.before.coordinate_columns[axis];
        changes[at] = true;
        require(edited.after.coordinate_columns[axis] == at, "coordinates stay where they are");
        for (std::size_t i = 0; i < edited.before.size(); ++i)
            require(edited.holds(at, i, coordinate_after(edited.before, edited.edit, axis, i)),
                    "a moved coordinate is the file's own plus the displacement");
    }
}

void require_turned(const Edited& edited, std::vector<bool>& changes) {
    const auto normals = find_normals(edited.before);
    if (!normals) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = (*normals)[axis];
        changes[at] = true;
        for (std::size_t i = 0; i < edited.before.size(); ++i) {
            const float posed = edited.edit.normals[3 * i + axis];
            require(edited.holds(at, i, normal_after(edited.before.attributes[at], posed, i)),
                    "a turned normal is what the pose says");
        }
    }
}

void require_unchanged(const Edited& edited, std::size_t column) {
    const Attribute& before = edited.before.attributes[column];
    const Attribute& after = edited.after.attributes[column];
    if (!edited.looseness.guesses_columns) return require_same_column(before, after);
    for (std::size_t i = 0; i < edited.before.size(); ++i) {
        const double value = value_at(before, i);
        // Taken for a colour, a column has no -0 any more.
        require(value == value_at(after, i) || same_bits(value, value_at(after, i)),
                "a column keeps its values");
    }
}

void require_added(const Edited& edited) {
    const std::size_t columns = edited.before.attributes.size();
    if (edited.says_something && edited.after.attributes.size() == columns) return;
    require(edited.after.attributes.size() == columns + 1, "an edit keeps the columns and adds one");
    const Attribute& added = edited.after.attributes.back();
    require(edited.looseness.guesses_columns || added.name.starts_with("weight"), "it has its name");
    require(!added.is_list(), "it is no list");
    for (std::size_t i = 0; i < edited.before.size(); ++i)
        require(static_cast<float>(value_at(added, i)) == edited.edit.weights[i], "it has its values");
}

void require_edited(const Edited& edited) {
    require(edited.after.size() == edited.before.size(), "an edit keeps the number of points");
    require_added(edited);
    std::vector<bool> changes(edited.before.attributes.size(), false);
    require_moved(edited, changes);
    require_turned(edited, changes);
    for (std::size_t column = 0; column < changes.size(); ++column)
        if (!changes[column]) require_unchanged(edited, column);
}

// --- The properties ----------------------------------------------------------------------------------------

PointCloud read_again(const Format& format, std::vector<std::byte> bytes) {
    SilentProgress progress;
    try {
        return format.read(std::move(bytes), "again" + std::string(format.extensions.front()), progress);
    } catch (const Error& error) {
        require(false, error.what());
        throw;
    }
}

void check_unedited(const Format& format, const PointCloud& cloud, std::span<const std::byte> bytes) {
    const std::vector<float> normals = read_normals(cloud);
    for (const PosedShape& shape : {PosedShape{}, PosedShape{cloud.positions, normals}}) {
        const auto same = saved(format, cloud, shape);
        require(same && std::ranges::equal(same->bytes, bytes),
                "an unedited cloud saves to the identical file");
    }
}

void check_edited(const Format& format, const PointCloud& cloud, const Looseness& looseness) {
    const Edit edit = edit_of(cloud);
    auto file = saved(format, cloud, edit.shape());
    if (!file) return;
    const PointCloud again = read_again(format, std::move(file->bytes));
    require_edited({cloud, edit, again, looseness, file->says_something});
}

void check_as_new_file(const Format& format, PointCloud cloud) {
    // Other formats change names and types to what they have.
    const bool keeps_columns = format.name == "ply" && cloud.image->format() == "ply";
    cloud.image = nullptr;
    auto file = saved(format, cloud, {});
    if (!file) return;
    const PointCloud again = read_again(format, std::move(file->bytes));
    require(again.size() == cloud.size(), "a new file has all points");
    if (!keeps_columns) return;
    require(again.attributes.size() == cloud.attributes.size(), "a new file has all columns");
    for (std::size_t a = 0; a < cloud.attributes.size(); ++a)
        require_same_column(cloud.attributes[a], again.attributes[a]);
}

} // namespace

bool check_round_trip(std::string_view name, std::span<const std::byte> bytes, const Looseness& looseness) {
    const auto formats = known_formats();
    const auto found = std::ranges::find(formats, name, &Format::name);
    require(found != formats.end(), "a target's format is one that knead knows");
    const Format& format = *found;
    const std::string shown = "fuzzed" + std::string(format.extensions.front());
    PointCloud cloud;
    try {
        SilentProgress progress;
        cloud = format.read({bytes.begin(), bytes.end()}, shown, progress);
    } catch (const Error& error) {
        require(error.trouble() == Trouble::input, "a file that is refused is an error of input");
        require_showable(error.what(), shown);
        return false;
    }
    for (const std::string& remark : cloud.remarks) require_showable(remark, "");
    check_unedited(format, cloud, bytes);
    check_edited(format, cloud, looseness);
    // In one format or another; the fuzzer goes over every way from one to another often.
    check_as_new_file(formats[bytes.size() % formats.size()], cloud);
    return true;
}

} // namespace knead::fuzz
