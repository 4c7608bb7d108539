// A cloud saved without some of its points is the file that a cloud of only the others would have become.

#include "base/error.h"
#include "cloud/cloud_part.h"
#include "io/format.h"
#include "io/through_files.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace knead::test {
namespace {

constexpr std::size_t points = 12;

// A text PLY of the points that stay: coordinates, normals, a colour, a number of 2 bytes, a list, and two
// faces.
std::string text_of(const std::vector<std::uint8_t>& left_out) {
    std::string rows;
    for (std::size_t i = 0; i < points; ++i) {
        if (left_out[i] != 0) continue;
        const std::string n = std::to_string(i);
        rows += n + " " + std::to_string(i * i) + ".5 -" + n + (i % 2 == 0 ? " 1 0 0 " : " 0 0 1 ") + n +
                "0 7 " + n + " -3" + n + " " + std::to_string(i % 3);
        for (std::size_t k = 0; k < i % 3; ++k) rows += " 4" + std::to_string(k);
        rows += "\n";
    }
    const auto stay = std::ranges::count(left_out, std::uint8_t{0});
    std::string header = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(stay) + "\n";
    for (const char* const name : {"x", "y", "z", "nx", "ny", "nz"})
        header += "property float " + std::string(name) + "\n";
    for (const char* const name : {"red", "green", "blue"})
        header += "property uchar " + std::string(name) + "\n";
    return header +
           "property short deep\nproperty list uchar short many\nelement face 2\n"
           "property list uchar int vertex_indices\nend_header\n" +
           rows + "3 0 1 2\n3 1 2 3\n";
}

// All of them moved, by amounts that floats hold.
std::vector<float> moved(const PointCloud& cloud) {
    std::vector<float> positions = cloud.positions;
    for (std::size_t i = 0; i < cloud.size(); ++i) positions[3 * i + 2] += 0.25F;
    return positions;
}

// What write_part() makes of it, in a file of this name; `heard` becomes what it says.
std::string written_part(const PointCloud& cloud, const PosedShape& shape,
                         std::span<const std::uint8_t> left_out, const std::string& name,
                         std::vector<std::string>& heard) {
    const ScratchFolder folder;
    SilentProgress progress;
    heard = write_part(folder / name, cloud, shape, left_out, progress);
    return read_text(folder / name);
}

TEST(Part, is_the_file_of_a_cloud_of_the_other_points_in_every_format) {
    std::vector<std::uint8_t> left_out(points, 0);
    for (const std::size_t i : {0U, 4U, 5U, 11U}) left_out[i] = 1;
    const PointCloud cloud = read_bytes(text_of(std::vector<std::uint8_t>(points, 0)));
    PointCloud others = read_bytes(text_of(left_out));
    ASSERT_EQ(others.size(), points - 4);
    others.image.reset();
    const std::vector<float> posed = moved(cloud), posed_others = moved(others);
    const std::vector<float> normals = read_normals(cloud), normals_of_others = read_normals(others);
    std::vector<float> far(points), far_others;
    for (std::size_t i = 0; i < points; ++i) far[i] = static_cast<float>(i) / 8;
    for (std::size_t i = 0; i < points; ++i)
        if (left_out[i] == 0) far_others.push_back(far[i]);
    for (const Format& format : known_formats()) {
        SCOPED_TRACE(format.name);
        const std::string name = "part" + std::string(format.extensions.front());
        std::vector<std::string> heard, heard_of_others;
        const std::string part = written_part(cloud, {posed, normals, {{"far", far}}}, left_out, name, heard);
        EXPECT_EQ(part, written(others, {posed_others, normals_of_others, {{"far", far_others}}}, name,
                                &heard_of_others));
        // And nothing is silent about the faces.
        ASSERT_EQ(heard.size(), heard_of_others.size() + 1);
        EXPECT_TRUE(std::equal(heard_of_others.begin(), heard_of_others.end(), heard.begin()));
        EXPECT_TRUE(heard.back().starts_with(name + ": ")) << heard.back();
        EXPECT_NE(heard.back().find("face"), std::string::npos) << heard.back();
    }
}

TEST(Part, turns_the_splats_that_stay) {
    PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0, 1, 0, 0, 2, 0, 0});
    for (const char* const name : {"scale_0", "rot_0", "rot_1", "rot_2", "rot_3"}) {
        const float value = std::string_view(name) == "rot_0" ? 1 : 0;
        add_attribute(cloud, name, std::vector<float>(3, value));
    }
    const std::vector<float> turns = {1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}; // the last about x by half a turn
    std::vector<std::string> heard;
    const PointCloud part = read_bytes(
        written_part(cloud, {{}, {}, {}, turns}, std::vector<std::uint8_t>{0, 1, 0}, "part.ply", heard));
    ASSERT_EQ(part.size(), 2U);
    const auto rot = [&](const char* name, std::size_t i) {
        return value_at(part.attributes[*find_attribute(part, name)], i);
    };
    EXPECT_EQ(rot("rot_0", 0), 1);
    EXPECT_EQ(std::abs(rot("rot_1", 1)), 1);
    EXPECT_EQ(rot("rot_0", 1), 0);
    EXPECT_TRUE(heard.empty()) << joined(heard);
}

TEST(Part, of_nothing_is_refused_and_leaves_what_was_there) {
    const ScratchFolder folder;
    write_text(folder / "kept.ply", "as it was");
    SilentProgress progress;
    const PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0, 1, 0, 0});
    try {
        (void)write_part(folder / "kept.ply", cloud, {}, std::vector<std::uint8_t>{1, 1}, progress);
        FAIL() << "nothing was refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::output);
        EXPECT_NE(std::string(error.what()).find("no points"), std::string::npos) << error.what();
    }
    EXPECT_EQ(read_text(folder / "kept.ply"), "as it was");
}

TEST(Part, keeps_the_lists_of_the_points_that_stay) {
    const PointCloud cloud = read_bytes(text_of(std::vector<std::uint8_t>(points, 0)));
    std::vector<std::uint8_t> left_out(points, 1);
    left_out[2] = left_out[8] = 0; // with lists of two each
    const PointCloud part = part_of(cloud, left_out);
    const Attribute& many = part.attributes[*find_attribute(part, "many")];
    EXPECT_EQ(many.first, (std::vector<std::uint64_t>{0, 2, 4}));
    for (const std::size_t at : {0U, 1U, 2U, 3U}) EXPECT_EQ(value_at(many, at), 40 + at % 2);
    EXPECT_EQ(part.file_position(1), cloud.file_position(8));
    EXPECT_EQ(part.image, nullptr);
}

} // namespace
} // namespace knead::test
