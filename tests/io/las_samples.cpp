#include "io/las_samples.h"

namespace knead::test {

namespace {

// By hand from the specification's tables, not from the code that is tested.
constexpr std::array<std::size_t, 11> format_sizes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
constexpr std::array<std::size_t, 11> type_sizes = {0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};

std::size_t values_of(const ExtraBytes& extra) {
    return extra.type == 0 ? 0 : (extra.type - 1U) / 10 + 1;
}

std::size_t size_of_one(const ExtraBytes& extra) {
    return type_sizes.at((extra.type - 1U) % 10 + 1);
}

std::size_t size_of(const ExtraBytes& extra) {
    return extra.type == 0 ? extra.undocumented : values_of(extra) * size_of_one(extra);
}

std::string text(std::string_view words, std::size_t size) {
    std::string padded(words);
    padded.resize(size, '\0');
    return padded;
}

template<typename T>
void add(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string record(std::string_view user, std::uint16_t id, const std::string& content, bool extended) {
    std::string bytes;
    add<std::uint16_t>(bytes, 0);
    bytes += text(user, 16);
    add(bytes, id);
    if (extended)
        add<std::uint64_t>(bytes, content.size());
    else
        add(bytes, static_cast<std::uint16_t>(content.size()));
    return bytes + text("made by a test", 32) + content;
}

std::string descriptor(const ExtraBytes& extra) {
    std::string bytes(192, '\0');
    bytes[2] = static_cast<char>(extra.type);
    bytes[3] = static_cast<char>(extra.type == 0 ? extra.undocumented : extra.scale != 0 ? 24 : 0);
    bytes.replace(4, 32, text(extra.name, 32));
    for (std::size_t i = 0; i < 3; ++i) {
        put(bytes, 112 + 8 * i, extra.scale);
        put(bytes, 136 + 8 * i, extra.offset);
    }
    return bytes;
}

std::string records(const LasKind& kind) {
    std::string bytes;
    for (std::size_t i = 0; i < kind.records; ++i)
        bytes +=
            record("LASF_Projection", static_cast<std::uint16_t>(34735 + i), std::string(i * 8, 'p'), false);
    if (kind.extra.empty()) return bytes;
    std::string content;
    for (const ExtraBytes& extra : kind.extra) content += descriptor(extra);
    return bytes + record("LASF_Spec", 4, content, false);
}

std::size_t header_size(const LasKind& kind) {
    return kind.minor == 4 ? 375 : kind.minor == 3 ? 235 : 227;
}

std::string point(const LasKind& kind, int i) {
    std::string bytes;
    for (const int number : {100 + 7 * i, -50 + i, 3 * i * i}) add<std::int32_t>(bytes, number);
    add(bytes, static_cast<std::uint16_t>(1000 + i));
    const bool wide = kind.format >= 6;
    bytes += static_cast<char>(wide ? 0x21 : 0x11);  // return 1 of 2
    if (wide) bytes += '\x41';                       // synthetic, scan direction
    bytes += static_cast<char>(wide ? i : i | 0x20); // classification (and synthetic)
    while (bytes.size() < format_sizes.at(kind.format))
        bytes += static_cast<char>(bytes.size() == 19 ? 0 : 3 * bytes.size() % 50);
    for (const ExtraBytes& extra : kind.extra) {
        if (extra.type == 0) bytes += std::string(extra.undocumented, 'u');
        for (std::size_t value = 1; value <= values_of(extra); ++value) {
            const int number = i * static_cast<int>(value);
            const unsigned type = (extra.type - 1U) % 10 + 1;
            std::string one;
            if (type == 9)
                add(one, static_cast<float>(number));
            else if (type == 10)
                add(one, static_cast<double>(number));
            else
                add(one, static_cast<std::int64_t>(number));
            bytes += one.substr(0, size_of_one(extra));
        }
    }
    return bytes + std::string(kind.undescribed, 'v');
}

} // namespace

std::vector<LasKind> all_las_kinds() {
    std::vector<LasKind> kinds;
    const std::vector<ExtraBytes> every_type = [] {
        std::vector<ExtraBytes> all;
        for (unsigned type = 1; type <= 10; ++type)
            all.push_back({"extra " + std::to_string(type), static_cast<std::uint8_t>(type)});
        all.push_back({"scaled", 6, 0.5, 10});
        all.push_back({"secret", 0, 0, 0, 3});
        all.push_back({"pair", 13});
        all.push_back({"normal", 29});
        return all;
    }();
    for (unsigned format = 0; format <= 10; ++format) {
        const unsigned first = format <= 1 ? 0 : format <= 3 ? 2 : format <= 5 ? 3 : 4;
        for (unsigned minor = first; minor <= 4; ++minor) {
            LasKind kind;
            kind.minor = minor;
            kind.format = format;
            kinds.push_back(kind);
            kind.records = 3;
            kind.padding = 2;
            kind.extended = minor == 4 ? 2 : 0;
            kind.undescribed = 1;
            kinds.push_back(kind);
            kind.extra = every_type;
            kinds.push_back(kind);
        }
    }
    return kinds;
}

std::string name_of(const LasKind& kind) {
    return "LAS 1." + std::to_string(kind.minor) + ", format " + std::to_string(kind.format) +
           (kind.records > 0 ? ", records" : "") + (kind.extra.empty() ? "" : ", extra bytes");
}

std::size_t las_length(const LasKind& kind) {
    std::size_t length = format_sizes.at(kind.format) + kind.undescribed;
    for (const ExtraBytes& extra : kind.extra) length += size_of(extra);
    return length;
}

std::size_t las_points_begin(const LasKind& kind) {
    return header_size(kind) + records(kind).size() + kind.padding;
}

std::string las_sample(const LasKind& kind) {
    std::string bytes = text("LASF", header_size(kind));
    bytes.replace(26, 32, text("a test", 32));
    bytes[24] = 1;
    bytes[25] = static_cast<char>(kind.minor);
    put(bytes, 94, static_cast<std::uint16_t>(header_size(kind)));
    put(bytes, 96, static_cast<std::uint32_t>(las_points_begin(kind)));
    put(bytes, 100, static_cast<std::uint32_t>(kind.records + (kind.extra.empty() ? 0 : 1)));
    bytes[104] = static_cast<char>(kind.format);
    put(bytes, 105, static_cast<std::uint16_t>(las_length(kind)));
    if (kind.format <= 5) put(bytes, 107, static_cast<std::uint32_t>(kind.points));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        put(bytes, 131 + 8 * axis, kind.scale[axis]);
        put(bytes, 155 + 8 * axis, kind.offset[axis]);
        put(bytes, 179 + 16 * axis, 1e6 + static_cast<double>(axis)); // bounds that nobody measured
        put(bytes, 187 + 16 * axis, -1e6);
    }
    std::string points;
    for (std::size_t i = 0; i < kind.points; ++i) points += point(kind, static_cast<int>(i));
    if (kind.minor == 4) {
        put(bytes, 247, static_cast<std::uint64_t>(kind.points));
        put(bytes, 243, static_cast<std::uint32_t>(kind.extended));
        if (kind.extended > 0)
            put(bytes, 235, static_cast<std::uint64_t>(las_points_begin(kind) + points.size()));
    }
    bytes += records(kind) + std::string(kind.padding, 'x') + points;
    for (std::size_t i = 0; i < kind.extended; ++i)
        bytes += record("knead", 7, std::string(11 * i, 'e'), true);
    return bytes;
}

} // namespace knead::test
