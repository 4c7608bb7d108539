#include "io/las_dimensions.h"

#include "base/error.h"
#include "base/require.h"
#include "io/free_names.h"
#include "io/scalar_bytes.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace knead {

namespace {

constexpr std::array<std::size_t, 11> point_sizes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

// Appends scalars one behind the other.
class Layout {
public:
    void scalar(const char* name, ScalarType type) {
        dimensions.push_back({name, type, at_, 0, 0, false, {}});
        at_ += size_of(type);
    }

    // Bits of the byte here, from the lowest on.
    void bits(const char* name, unsigned count) {
        dimensions.push_back({name, ScalarType::uint8, at_, shift_, count, false, {}});
        shift_ += count;
        if (shift_ == 8) {
            shift_ = 0;
            ++at_;
        }
    }

    std::size_t size() const { return at_; }

    std::vector<LasDimension> dimensions;

private:
    std::size_t at_ = 0;
    unsigned shift_ = 0;
};

// Bytes 14 to 20 of formats 0 to 5.
void add_legacy_middle(Layout& layout) {
    layout.bits("return_number", 3);
    layout.bits("number_of_returns", 3);
    layout.bits("scan_direction", 1);
    layout.bits("edge_of_flight_line", 1);
    layout.bits("classification", 5);
    for (const char* const flag : {"synthetic", "key_point", "withheld"}) layout.bits(flag, 1);
    layout.scalar("scan_angle_rank", ScalarType::int8);
    layout.scalar("user_data", ScalarType::uint8);
    layout.scalar("point_source_id", ScalarType::uint16);
}

// Bytes 14 to 22 of formats 6 to 10.
void add_middle(Layout& layout) {
    layout.bits("return_number", 4);
    layout.bits("number_of_returns", 4);
    for (const char* const flag : {"synthetic", "key_point", "withheld", "overlap"}) layout.bits(flag, 1);
    layout.bits("scanner_channel", 2);
    layout.bits("scan_direction", 1);
    layout.bits("edge_of_flight_line", 1);
    layout.scalar("classification", ScalarType::uint8);
    layout.scalar("user_data", ScalarType::uint8);
    layout.scalar("scan_angle", ScalarType::int16); // in 0.006 degrees
    layout.scalar("point_source_id", ScalarType::uint16);
}

void add_waveform(Layout& layout) {
    layout.scalar("waveform_index", ScalarType::uint8);
    layout.scalar("waveform_offset", ScalarType::uint64);
    layout.scalar("waveform_size", ScalarType::uint32);
    for (const char* const name : {"waveform_location", "waveform_dx", "waveform_dy", "waveform_dz"})
        layout.scalar(name, ScalarType::float32);
}

// --- Extra bytes -------------------------------------------------------------------------------------------

constexpr std::array<ScalarType, 10> extra_types = {
    ScalarType::uint8, ScalarType::int8,   ScalarType::uint16, ScalarType::int16,   ScalarType::uint32,
    ScalarType::int32, ScalarType::uint64, ScalarType::int64,  ScalarType::float32, ScalarType::float64};

// An entry of the description: 0 … 3 values of a type, or bytes of no known meaning.
struct Descriptor {
    std::size_t values = 0;
    ScalarType type = ScalarType::uint8;
    std::size_t size = 0; // of all together, in bytes
    std::string name;
    std::array<std::optional<LasAxis>, 3> axes; // one a value, where it is scaled
};

Descriptor descriptor_at(std::span<const std::byte> bytes, std::size_t at, const std::string& shown) {
    const auto code = load_little<std::uint8_t>(bytes, at + 2);
    const auto options = load_little<std::uint8_t>(bytes, at + 3);
    Descriptor descriptor;
    const std::string_view name(reinterpret_cast<const char*>(bytes.data()) + at + 4, 32);
    descriptor.name = name.substr(0, name.find('\0'));
    // Such a name could not be shown, and broke the lines of other formats.
    const auto is_control = [](unsigned char letter) { return letter < 0x20 || letter == 0x7F; };
    std::ranges::replace_if(descriptor.name, is_control, '_');
    if (code == 0) { // the options are the number of bytes
        descriptor.size = options;
        return descriptor;
    }
    if (code > 30)
        throw Error(Trouble::input, shown + ": byte " + std::to_string(at + 2),
                    "extra bytes are of type " + std::to_string(code) +
                        ", but LAS has types 0 to 30; correct the description or leave it out");
    descriptor.values = (code - 1U) / 10 + 1;
    descriptor.type = extra_types.at((code - 1U) % 10);
    descriptor.size = descriptor.values * size_of(descriptor.type);
    constexpr unsigned scale_bit = 8, offset_bit = 16;
    if ((options & (scale_bit | offset_bit)) == 0) return descriptor;
    for (std::size_t i = 0; i < descriptor.values; ++i) {
        LasAxis axis;
        if ((options & scale_bit) != 0) axis.scale = load_little<double>(bytes, at + 112 + 8 * i);
        if ((options & offset_bit) != 0) axis.offset = load_little<double>(bytes, at + 136 + 8 * i);
        // Some writers set the bits and leave zeros; an identity needs no other type.
        if (axis.scale == 0) axis.scale = 1;
        if (axis.scale != 1 || axis.offset != 0) descriptor.axes[i] = axis;
    }
    return descriptor;
}

// "normal" of three values is what find_normals() looks for.
std::string name_of_value(const Descriptor& descriptor, std::size_t number, std::size_t value) {
    if (descriptor.name.empty()) return "extra_" + std::to_string(number);
    if (descriptor.values == 1) return descriptor.name;
    const bool normals = descriptor.name == "normal" || descriptor.name == "normals" ||
                         descriptor.name == "Normal" || descriptor.name == "Normals";
    if (normals && descriptor.values == 3) return std::string("normal_") + "xyz"[value];
    return descriptor.name + "_" + std::to_string(value);
}

} // namespace

std::size_t las_point_size(unsigned format) {
    return point_sizes.at(format);
}

std::vector<LasDimension> las_dimensions(unsigned format) {
    Layout layout;
    for (const char* const axis : {"x", "y", "z"}) layout.scalar(axis, ScalarType::int32);
    for (LasDimension& axis : layout.dimensions) axis.scaled = true;
    layout.scalar("intensity", ScalarType::uint16);
    const bool legacy = format <= 5;
    if (legacy)
        add_legacy_middle(layout);
    else
        add_middle(layout);
    if (format != 0 && format != 2) layout.scalar("gps_time", ScalarType::float64);
    if (format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10)
        for (const char* const colour : {"red", "green", "blue"}) layout.scalar(colour, ScalarType::uint16);
    if (format == 8 || format == 10) layout.scalar("nir", ScalarType::uint16);
    if (format == 4 || format == 5 || format == 9 || format == 10) add_waveform(layout);
    require(layout.size() == las_point_size(format), "the dimensions of a point fill it");
    return std::move(layout.dimensions);
}

std::uint8_t las_type_code(ScalarType type) {
    const auto found = std::find(extra_types.begin(), extra_types.end(), type);
    return static_cast<std::uint8_t>(found - extra_types.begin() + 1);
}

std::vector<LasDimension> dimensions_of(std::span<const std::byte> bytes, LasHeader& header,
                                        const std::string& shown) {
    std::vector<LasDimension> dimensions = las_dimensions(header.point_format);
    for (std::size_t axis = 0; axis < 3; ++axis) dimensions[axis].axis = header.axes[axis];
    std::size_t at = las_point_size(header.point_format);
    FreeNames names;
    for (const LasDimension& dimension : dimensions) (void)names.take_exactly(dimension.name);
    std::size_t number = 0;
    for (const LasRecord& record : header.records) {
        if (!record.describes_extra_bytes) continue;
        for (std::size_t d = 0; d + las_descriptor_size <= record.size; d += las_descriptor_size) {
            const Descriptor descriptor = descriptor_at(bytes, record.begin + d, shown);
            if (descriptor.size > header.point_length - at)
                throw Error(Trouble::input, shown + ": byte " + std::to_string(record.begin + d),
                            "the extra bytes described here reach beyond the end of a point of " +
                                std::to_string(header.point_length) +
                                " bytes; correct the description or the points' length");
            for (std::size_t value = 0; value < descriptor.values; ++value) {
                const auto& axis = descriptor.axes[value];
                dimensions.push_back({names.take(name_of_value(descriptor, number, value)), descriptor.type,
                                      at + value * size_of(descriptor.type), 0, 0, axis.has_value(),
                                      axis.value_or(LasAxis{})});
            }
            ++number;
            at += descriptor.size;
        }
    }
    header.undescribed = header.point_length - at;
    return dimensions;
}

} // namespace knead
