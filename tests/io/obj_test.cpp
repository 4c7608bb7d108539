// Wavefront OBJ: its vertices as points, and all else kept.

#include "base/error.h"
#include "io/obj.h"
#include "io/through_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

namespace knead::test {
namespace {

PointCloud read_obj_text(std::string_view text) {
    return read_bytes(text, "cloud.obj");
}

std::string saved(const PointCloud& cloud, const PosedShape& shape) {
    return written(cloud, shape, "out.obj");
}

std::vector<double> column(const PointCloud& cloud, std::string_view name) {
    const auto found = find_attribute(cloud, name);
    if (!found) return {};
    std::vector<double> values;
    for (std::size_t i = 0; i < cloud.size(); ++i) values.push_back(value_at(cloud.attributes[*found], i));
    return values;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    return text.replace(text.find(from), from.size(), to);
}

// All that OBJ has, in every spelling.
const std::string everything = "# a cube's corner\n"
                               "mtllib some file.mtl\n"
                               "o thing # 1\n"
                               "v 0 0 0\n"
                               "vt 0.5 0.5\n"
                               "v\t1.50  0.0 0 # not a colour 1 1 1\n"
                               "\n"
                               "   v 0 \\\n 2e0 \\\r\n\t0\r\n"
                               "g left right\r"
                               "usemtl red\n"
                               "s off\n"
                               "v 0 0 +3. 1.0\n"
                               "vp 0.1 0.2\n"
                               "f 1/1 2/1/ 3\n"
                               "f -4 -3 \\\n"
                               "  -1\n"
                               "l 1 2/1 4\n"
                               "p 1 2 3 4\n"
                               "curv 0 1 1 2 3 # kept";

TEST(Obj, ReadsVerticesInEverySpelling) {
    const PointCloud cloud = read_obj_text(everything);
    ASSERT_EQ(cloud.size(), 4U);
    EXPECT_EQ(cloud.file_position(1), Vec3d(1.5, 0, 0));
    EXPECT_EQ(cloud.file_position(2), Vec3d(0, 2, 0));
    EXPECT_EQ(cloud.file_position(3), Vec3d(0, 0, 3));
    EXPECT_EQ(column(cloud, "weight"), (std::vector<double>{1, 1, 1, 1}));
    EXPECT_TRUE(cloud.remarks.empty());
    EXPECT_EQ(file_kind(cloud).format, "obj");
    EXPECT_EQ(cloud.image->besides_points(),
              (std::vector<std::string>{"2 faces", "1 line", "1 point element", "1 texture coordinate"}));
    EXPECT_EQ(read_bytes("\xEF\xBB\xBFv 1 2 3", "cloud.obj").file_position(0), Vec3d(1, 2, 3));
}

TEST(Obj, IsKnownByItsContent) {
    for (const char* text : {"v 1 2 3\n", "# words\n\n  o name\nv 1 2 3", "mtllib a\nv 1 2 3\n"})
        EXPECT_EQ(file_kind(read_bytes(text, "cloud.ply")).format, "obj") << text;
}

TEST(Obj, UneditedIsSavedToTheByte) {
    const PointCloud cloud = read_obj_text(everything);
    EXPECT_EQ(saved(cloud, {}), everything);
    EXPECT_EQ(saved(cloud, {cloud.positions, {}}), everything);
}

TEST(Obj, OnlyWhatMovedIsWrittenAnew) {
    const PointCloud cloud = read_obj_text(everything);
    std::vector<float> posed = cloud.positions;
    posed[3 * 1] += 0.25F;
    posed[3 * 2 + 1] -= 1;
    posed[3 * 3 + 2] += 4;
    std::string expected = replaced(everything, "1.50", "1.75");
    expected = replaced(expected, "2e0", "1");
    expected = replaced(expected, "+3.", "7");
    EXPECT_EQ(saved(cloud, {posed, {}}), expected);
}

TEST(Obj, NumbersKeepTheirPrecision) {
    // Whole metres far away: floats could not hold an edit of centimetres.
    const PointCloud far = read_obj_text("v 512840 5403000 100\nv 512940 5403100 120\n");
    EXPECT_EQ(far.attributes[0].type, ScalarType::float64);
    std::vector<float> posed = far.positions;
    posed[0] += 0.25F;
    EXPECT_EQ(saved(far, {posed, {}}), "v 512840.25 5403000 100\nv 512940 5403100 120\n");
    const PointCloud fine = read_obj_text("v 0.123456789 0 0\nv 1 1 1\n");
    EXPECT_EQ(fine.attributes[0].type, ScalarType::float64);
    EXPECT_EQ(fine.file_position(0)[0], 0.123456789);
    EXPECT_EQ(read_obj_text("v 0.1234567 0 0\nv 1 1 1.000000000\n").attributes[0].type, ScalarType::float32);
}

TEST(Obj, NumbersThatNoFloatTellsApartAreDoubles) {
    const auto type_of = [](const std::string& number) {
        const PointCloud cloud = read_bytes("v 0 0 0\nv 1 1 " + number + "\n", "cloud.obj");
        return cloud.attributes[2].type;
    };
    for (const char* number : {"0.1234567", "0.000976562", "0.0009123456", "1.2e-38", "-0", "nan", "1e999"})
        EXPECT_EQ(type_of(number), ScalarType::float32) << number;
    // Two of seven digits that are the same float; too small for a float's full precision, and too large.
    EXPECT_EQ(0.0009900005F, 0.0009900006F);
    for (const char* number : {"0.0009900005", "0.0009900006", "0.12345678", "1e-40", "1e39"})
        EXPECT_EQ(type_of(number), ScalarType::float64) << number;
    const PointCloud far = read_bytes("v 0 0 0\nv 1e39 1e200 -1e300\n", "cloud.obj");
    EXPECT_EQ(far.file_position(1), Vec3d(1e39, 1e200, -1e300));
}

TEST(Obj, KeepsAllDigitsOfWholeNumbers) {
    const std::string whole = "9007199254740993"; // 2^53 + 1
    const PointCloud cloud = read_bytes("VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE I I U\nWIDTH 1\nHEIGHT "
                                        "1\nDATA ascii\n" +
                                            whole + " -" + whole + " 18446744073709551615\n",
                                        "cloud.pcd");
    EXPECT_EQ(written(cloud, {}, "out.obj"), "v " + whole + " -" + whole + " 18446744073709551615\n");
    EXPECT_NE(written(cloud, {}, "out.off").find(whole + " -" + whole + " 18446744073709551615\n"),
              std::string::npos);
}

TEST(Obj, ColoursMayBeMissingHereAndThere) {
    const std::string text =
        "v 0 0 0\nv 0 0 1 0 0 0.5\nv 0 1 0\nv 1 0 0 nan 0.5 0.25\nv 1 1 1 2 0.1 0.2 0.3\n";
    const PointCloud cloud = read_obj_text(text);
    EXPECT_EQ(column(cloud, "blue"), (std::vector<double>{1, 0.5, 1, 0.25, static_cast<double>(0.3F)}));
    EXPECT_TRUE(std::isnan(column(cloud, "red")[3]));
    EXPECT_EQ(column(cloud, "weight"), (std::vector<double>{1, 1, 1, 1, 2}));
    ASSERT_EQ(cloud.remarks.size(), 1U);
    EXPECT_EQ(cloud.remarks[0], "2 of 5 points have no colour in the file; they are taken as white");
    std::vector<float> posed = cloud.positions;
    posed[3 * 4] = posed[3 * 3];
    posed[3 * 4] += 1;
    EXPECT_EQ(saved(cloud, {posed, {}}), replaced(text, "v 1 1 1 2", "v 2 1 1 2"));
}

TEST(Obj, FurtherNumbersAreKeptAndNotUnderstood) {
    const std::string text = "v 0 0 0 1 1\nv 0 0 1 1 2 3 4 5 6\n";
    const PointCloud cloud = read_obj_text(text);
    EXPECT_EQ(cloud.attributes.size(), 3U);
    ASSERT_EQ(cloud.remarks.size(), 1U);
    EXPECT_NE(cloud.remarks[0].find("2 vertices have 5 or more than 7 numbers"), std::string::npos);
    EXPECT_EQ(saved(cloud, {}), text);
}

// --- Normals

TEST(Obj, AsManyNormalsAsPointsBelongToThem) {
    const std::string text = "vn 0 0 1\nv 0 0 0\nvn 0 1.000 0\nv 1 0 0\nvn 1 0 0\nv 0 1 0\n";
    const PointCloud cloud = read_obj_text(text);
    EXPECT_EQ(read_normals(cloud), (std::vector<float>{0, 0, 1, 0, 1, 0, 1, 0, 0}));
    const std::vector<float> turned{0, 0, 1, 0, 1, 0, 0, 0.5F, 0.5F};
    EXPECT_EQ(saved(cloud, {{}, turned}), replaced(text, "vn 1 0 0", "vn 0 0.5 0.5"));
    EXPECT_EQ(saved(cloud, {{}, read_normals(cloud)}), text);
}

TEST(Obj, NormalsOfCornersBelongToPointsWhereTheyArePairs) {
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 5 5 5\n"; // the last is of no face
    const std::string normals = "vn 1 0 0\nvn 0 1 0\nvn 0 0 1\nvn 0 0 -1\nvn 9 9 9\n";
    const std::string faces = "f 1//4 2//3 3//2\nf 1//4 3//-4 4//1\np 1 5\n"; // the last normal is nobody's
    const PointCloud cloud = read_obj_text(points + normals + faces);
    EXPECT_TRUE(cloud.remarks.empty());
    EXPECT_EQ(read_normals(cloud), (std::vector<float>{0, 0, -1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, 0}));
    std::vector<float> turned = read_normals(cloud);
    turned[2] = -2; // of the first point, which is the fourth normal
    EXPECT_EQ(saved(cloud, {{}, turned}), points + replaced(normals, "0 0 -1", "0 0 -2") + faces);
}

// As other readers take them: nothing tells that the others are not by number.
TEST(Obj, NormalsOfNoCornerBelongToPointsByTheirNumbers) {
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    const std::string normals = "vn 1 0 0\nvn 0 1 0\nvn 0 0 1\nvn 0 0 -1\n";
    const PointCloud cloud = read_obj_text(points + normals + "f 1//1 2//2 3//3\n");
    EXPECT_EQ(read_normals(cloud), (std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1}));
}

TEST(Obj, NormalsThatAreNotPairedAreLeftWithAWord) {
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const char* rest : {"vn 0 0 1\nf 1//1 2//1 3//1\n", // shared
                             "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\nvn 0 0 2\nf 1//1 2//2 3//3\nf 1//4 2//2 3//3\n",
                             "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\nf 1//1 2//2 3\n", // one has none
                             "vn 0 0 1\nvn 0 1 0\n"}) {
        const PointCloud cloud = read_obj_text(points + rest);
        EXPECT_TRUE(read_normals(cloud).empty()) << rest;
        ASSERT_EQ(cloud.remarks.size(), 1U) << rest;
        EXPECT_NE(cloud.remarks[0].find("cannot follow the points"), std::string::npos);
        std::vector<float> posed = cloud.positions;
        posed[0] -= 1;
        EXPECT_EQ(saved(cloud, {posed, {}}), replaced(points, "v 0", "v -1") + rest);
        EXPECT_NE(joined(cloud.image->besides_points()).find("normal"), std::string::npos);
    }
}

// --- New files

TEST(Obj, HoldsPointsColoursAndNormalsOfOtherClouds) {
    PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0, 1, 2.5F, 3});
    add_attribute(cloud, "red", std::vector<std::uint8_t>{0, 255});
    add_attribute(cloud, "green", std::vector<std::uint8_t>{51, 1});
    add_attribute(cloud, "blue", std::vector<std::uint8_t>{255, 0});
    add_attribute(cloud, "nx", std::vector<float>{0, 1});
    add_attribute(cloud, "ny", std::vector<float>{0, 0});
    add_attribute(cloud, "nz", std::vector<float>{1, 0});
    add_attribute(cloud, "mass", std::vector<float>{1, 0});
    std::vector<float> posed = cloud.positions;
    posed[3] += 1;
    const std::vector<float> far{1, 2};
    std::vector<std::string> heard;
    EXPECT_EQ(written(cloud, {posed, {}, {{"far", far}}}, "out.obj", &heard),
              "v 0 0 0 0.0 0.2 1.0\nv 2 2.5 3 1.0 0.003921569 0.0\nvn 0 0 1\nvn 1 0 0\n");
    EXPECT_EQ(heard,
              (std::vector<std::string>{"out.obj: the columns 'mass' and 'far' are left out, since OBJ "
                                        "has no place for them"}));
    const PointCloud back = read_obj_text(saved(cloud, {}));
    EXPECT_EQ(back.positions, cloud.positions);
    EXPECT_EQ(read_normals(back), read_normals(cloud));
}

TEST(Obj, SaysThatItHasNoPlaceForAddedColumns) {
    const PointCloud cloud = read_obj_text(everything);
    const std::vector<float> far(4, 1.0F);
    std::vector<std::string> heard;
    EXPECT_EQ(written(cloud, {{}, {}, {{"far", far}}}, "out.obj", &heard), everything);
    ASSERT_EQ(heard.size(), 1U);
    EXPECT_NE(heard[0].find("'far' is left out"), std::string::npos);
}

TEST(Obj, SaysWhatOtherFormatsDoNotHoldOfIt) {
    std::vector<std::string> heard;
    (void)written(read_obj_text(everything), {}, "out.ply", &heard);
    EXPECT_NE(joined(heard).find("2 faces"), std::string::npos) << joined(heard);
}

// --- Refusals

TEST(Obj, RefusesWhatIsWrongByFileAndLine) {
    const std::map<std::string, std::string> words = {
        {"# nothing here\n", "cloud.obj: holds no vertices"},
        {"f 1 2 3\n", "cloud.obj: holds no vertices"},
        {"v 1 2\n", "cloud.obj:1: 'v' is a vertex of 2 numbers"},
        {"v 1 2 3\nv 1 2 \\\n\n", "cloud.obj:2: 'v' is a vertex of 2 numbers"},
        {"v 1 2 3\nv 1 2 three\n", "cloud.obj:2: 'three' is no number"},
        {"v 1 2 3.1+e2\n", "cloud.obj:1: '3.1+e2' is no number"},
        {"v 1 2 3 1 1 red\n", "cloud.obj:1: 'red' is no number"},
        {"v 1,2,3\n", "cloud.obj:1: '1,2,3' is no number"},
        {"v 1 2 3\nvn 1 2\n", "cloud.obj:2: 'vn' is a normal of 2 numbers"},
        {"v 1 2 3\n\nf 1 1 2\n", "cloud.obj:3: '2' names a point that is not in the file, which has 1"},
        {"v 1 2 3\nf 1 1 0\n", "cloud.obj:2: '0' names a point that is not in the file"},
        {"v 1 2 3\nf 1 1 -2\nv 1 2 3\n", "cloud.obj:2: '-2' names a point that is not in the file, which has "
                                         "2 (1 so far)"},
        {"v 1 2 3\nf 1/1 1 1\n", "cloud.obj:2: '1/1' names a texture coordinate"},
        {"v 1 2 3\nf 1//1 1 1\n", "cloud.obj:2: '1//1' names a normal"},
        {"v 1 2 3\nl 1 99999999999999999999\n", "cloud.obj:2: '99999999999999999999' names a point"},
        {"v 1 2 3\np one\n", "cloud.obj:2: 'one' has no number of a point"},
        {"v 1 2 3\nf 1:1 1 1\n", "cloud.obj:2: '1:1' is no corner of 'f'"},
        {"v 1 2 3\nvn 1 0 0\nf 1//1/1 1 1\n", "cloud.obj:3: '1//1/1' is no corner of 'f'"},
    };
    for (const auto& [bytes, expected] : words)
        EXPECT_EQ(refusal(bytes, "cloud.obj").substr(0, expected.size()), expected) << bytes;
    EXPECT_NE(refusal(std::string("\xFE\xFF\0v", 4), "cloud.obj").find("UTF-16"), std::string::npos);
}

TEST(Obj, KeepsCoordinatesThatAreNotFinite) {
    const std::string text = "v nan 0 0\nv 1 -inf 0\nv 0 0 0\nv 1 1 1\n";
    const PointCloud cloud = read_obj_text(text);
    EXPECT_EQ(bounds_of(cloud).finite_points, 2U);
    std::vector<float> posed = cloud.positions;
    posed[3 * 2] += 2;
    EXPECT_EQ(saved(cloud, {posed, {}}), replaced(text, "v 0 0 0", "v 2 0 0"));
}

// Without files, since there are many.
void read_whatever(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    SilentProgress progress;
    try {
        const PointCloud cloud = read_obj({bytes.begin(), bytes.end()}, "cloud.obj", progress);
        EXPECT_EQ(cloud.positions.size(), 3 * cloud.size());
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::input);
        EXPECT_TRUE(std::string_view(error.what()).starts_with("cloud.obj:")) << error.what();
    }
}

// Whatever the bytes, a file is refused with words or opened; sanitizers watch.
TEST(Obj, NeverFallsOverADamagedByte) {
    const std::string normals = "v 0 0 0\nv 1 0 0 1 1 1\nvn 1 0 0\nvn 0 1 0\nf 1//1 2//2 1//1\n";
    for (const std::string& whole : {everything, normals})
        for (std::size_t at = 0; at < whole.size(); ++at) {
            read_whatever(whole.substr(0, at));
            for (const char damage : {'\0', '\n', '9', '-', '\\', '#', '/', 'v', '\xFF'}) {
                std::string bytes = whole;
                bytes[at] = damage;
                read_whatever(bytes);
            }
        }
}

} // namespace
} // namespace knead::test
