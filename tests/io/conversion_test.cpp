// Every format into every other: what arrives is right, and what does not arrive is told.

#include "io/format.h"
#include "io/through_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace knead::test {
namespace {

constexpr std::size_t points = 6;

template<typename T>
void add_column(PointCloud& cloud, const char* name, ScalarType type, T (*value)(std::size_t i)) {
    Attribute column{name, type, {}, {}, ScalarType::uint8};
    for (std::size_t i = 0; i < points; ++i) {
        const T one = value(i);
        const auto bytes = std::as_bytes(std::span(&one, 1));
        column.values.insert(column.values.end(), bytes.begin(), bytes.end());
    }
    cloud.attributes.push_back(std::move(column));
}

// A cloud from nowhere at UTM coordinates, with what scans have.
PointCloud scan() {
    PointCloud cloud;
    add_column<double>(cloud, "x", ScalarType::float64,
                       [](std::size_t i) { return 431234.5625 + 2.0 * static_cast<double>(i); });
    add_column<double>(cloud, "y", ScalarType::float64,
                       [](std::size_t i) { return 5403123.123456 - static_cast<double>(i * i); });
    add_column<double>(cloud, "z", ScalarType::float64,
                       [](std::size_t i) { return 812.25 + 0.001 * static_cast<double>(i); });
    for (const char* name : {"nx", "ny", "nz"})
        add_column<float>(cloud, name, ScalarType::float32,
                          [](std::size_t i) { return i % 2 == 0 ? 0.6F : -0.48F; });
    for (const char* name : {"red", "green", "blue"})
        add_column<std::uint8_t>(cloud, name, ScalarType::uint8,
                                 [](std::size_t i) { return static_cast<std::uint8_t>(40 * i + 3); });
    add_column<float>(cloud, "intensity", ScalarType::float32,
                      [](std::size_t i) { return 0.125F * static_cast<float>(i); });
    add_column<std::int32_t>(cloud, "label", ScalarType::int32,
                             [](std::size_t i) { return static_cast<std::int32_t>(i) - 2; });
    cloud.coordinate_columns = {0, 1, 2};
    set_positions_from_columns(cloud);
    return cloud;
}

// The columns that may be this one, under whatever name a format has for it.
std::vector<const Attribute*> found_again(const PointCloud& cloud, const std::string& name) {
    std::vector<const Attribute*> columns;
    const std::size_t axis = std::string_view("xyz").find(name.back());
    if (const auto normals = find_normals(cloud); normals && name.size() == 2 && name[0] == 'n')
        columns.push_back(&cloud.attributes[(*normals)[axis]]);
    // LAS has an intensity of its own, which fractions do not fit.
    for (const std::string& candidate : {name, name + "_2"})
        if (const auto column = find_attribute(cloud, candidate))
            columns.push_back(&cloud.attributes[*column]);
    return columns;
}

bool equals(const Attribute& before, const Attribute& after) {
    for (std::size_t i = 0; i < points; ++i) {
        const double was = value_at(before, i), is = value_at(after, i);
        const bool widened = before.type == ScalarType::uint8 && is == 256 * was; // colours in LAS
        // Tables hold the shortest text of a float, which is another double; OBJ and OFF read it as a float.
        const bool has_float = before.type == ScalarType::float32 || after.type == ScalarType::float32;
        const bool printed = has_float && static_cast<float>(is) == static_cast<float>(was);
        // Colours in OBJ, and deep ones in OFF.
        const double brightest = before.type == ScalarType::uint8 ? 255 : 65535;
        const bool fraction = is_whole(before.type) && after.type == ScalarType::float32 &&
                              std::abs(is * brightest - was) < 1e-2;
        if (is != was && !widened && !printed && !fraction) return false;
    }
    return true;
}

// All that `from` has is in `to`, or `words` tell of it.
void expect_kept(const PointCloud& from, const PointCloud& to, const std::string& words) {
    for (std::size_t a = 0; a < from.attributes.size(); ++a) {
        const Attribute& attribute = from.attributes[a];
        if (std::ranges::find(from.coordinate_columns, a) != from.coordinate_columns.end()) continue;
        const auto columns = found_again(to, attribute.name);
        const bool told = words.find(attribute.name) != std::string::npos;
        EXPECT_TRUE(told || std::ranges::any_of(
                                columns, [&](const Attribute* column) { return equals(attribute, *column); }))
            << attribute.name << " is lost silently; told: " << words;
    }
}

TEST(Conversion, keeps_points_and_attributes_or_tells_of_them) {
    const PointCloud cloud = scan();
    for (const Format& format : known_formats()) {
        SCOPED_TRACE(format.name);
        std::vector<std::string> heard;
        const std::string name = "out" + std::string(format.extensions.front());
        const std::string bytes = written(cloud, {}, name, &heard);
        for (const std::string& sentence : heard) EXPECT_TRUE(sentence.starts_with(name + ": ")) << sentence;
        const PointCloud back = read_bytes(bytes, name);
        EXPECT_EQ(file_kind(back).format, format.name);
        ASSERT_EQ(back.size(), points);
        for (std::size_t i = 0; i < points; ++i)
            EXPECT_LE((back.file_position(i) - cloud.file_position(i)).cwiseAbs().maxCoeff(), 1e-8) << i;
        expect_kept(cloud, back, joined(heard));
        EXPECT_EQ(written(back, {}, name), bytes);
    }
}

TEST(Conversion, of_no_points_reads_back_or_is_refused_at_once) {
    for (const Format& format : known_formats()) {
        SCOPED_TRACE(format.name);
        const std::string name = "out" + std::string(format.extensions.front());
        PointCloud cloud = make_cloud({});
        for (const char* colour : {"red", "green", "blue"})
            add_attribute(cloud, colour, std::span<const std::uint8_t>());
        if (format.name == "obj") {
            EXPECT_NE(refusal_to_write(cloud, {}, name).find("the cloud has no points, and OBJ"),
                      std::string::npos);
            continue;
        }
        std::vector<std::string> heard;
        const PointCloud back = read_bytes(written(cloud, {}, name, &heard), name);
        EXPECT_EQ(back.size(), 0U);
        EXPECT_TRUE(find_attribute(back, "red") || !heard.empty()) << joined(heard);
    }
}

TEST(Conversion, goes_from_every_format_to_every_other_in_a_pose) {
    for (const Format& from : known_formats())
        for (const Format& to : known_formats()) {
            SCOPED_TRACE(std::string(from.name) + " to " + std::string(to.name));
            const std::string first = "a" + std::string(from.extensions.front());
            const std::string second = "b" + std::string(to.extensions.front());
            const PointCloud cloud = read_bytes(written(scan(), {}, first), first);
            std::vector<float> posed = cloud.positions;
            posed[3] += 0.5F;
            std::vector<std::string> heard;
            const PointCloud back = read_bytes(written(cloud, {posed, {}}, second, &heard), second);
            const double far = static_cast<double>(posed[3]) - static_cast<double>(cloud.positions[3]);
            EXPECT_NEAR(back.file_position(1).x(), cloud.file_position(1).x() + far, 1e-7);
            for (const std::size_t i : {0, 2, 3, 4, 5})
                EXPECT_LE((back.file_position(i) - cloud.file_position(i)).cwiseAbs().maxCoeff(), 1e-8);
            expect_kept(cloud, back, joined(heard));
        }
}

// Whole coordinates are what a pose leaves only as fractions: a new file has room for these, and for what the
// old type cannot hold.
TEST(Conversion, of_whole_coordinates_keeps_the_fractions_of_a_pose) {
    PointCloud cloud;
    for (const char* axis : {"x", "y", "z"})
        add_column<std::int8_t>(cloud, axis, ScalarType::int8,
                                [](std::size_t i) { return static_cast<std::int8_t>(20 * i); });
    cloud.coordinate_columns = {0, 1, 2};
    set_positions_from_columns(cloud);
    std::vector<float> posed = cloud.positions;
    posed[3] += 0.25F;
    posed[15] += 100.5F; // beyond 127
    const auto type_in_ply = [&](const std::vector<float>& positions) {
        const PointCloud back = read_bytes(written(cloud, {positions, {}}, "out.ply"), "out.ply");
        return back.attributes[0].type;
    };
    EXPECT_EQ(type_in_ply(posed), ScalarType::float32);
    EXPECT_EQ(type_in_ply(cloud.positions), ScalarType::int8) << "nothing moved";
    for (const Format& format : known_formats()) {
        SCOPED_TRACE(format.name);
        const std::string name = "out" + std::string(format.extensions.front());
        const PointCloud back = read_bytes(written(cloud, {posed, {}}, name), name);
        ASSERT_EQ(back.size(), points);
        for (std::size_t i = 0; i < points; ++i)
            for (Eigen::Index axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(back.file_position(i)[axis],
                            static_cast<double>(posed[3 * i + static_cast<std::size_t>(axis)]) +
                                cloud.origin[axis],
                            1e-6);
    }
}

} // namespace
} // namespace knead::test
