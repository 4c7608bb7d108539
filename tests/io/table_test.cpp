#include "base/error.h"
#include "cloud/colors.h"
#include "io/through_files.h"
#include "support/scans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace knead::test {
namespace {

std::string names_of(const PointCloud& cloud) {
    std::string names;
    for (const Attribute& attribute : cloud.attributes) names += (names.empty() ? "" : " ") + attribute.name;
    return names;
}

// The columns that a table of these bytes has.
std::string columns_of(const std::string& bytes, const std::string& name = "cloud.txt") {
    return names_of(read_bytes(bytes, name));
}

std::string refusal_of(const std::string& bytes) {
    return refusal(bytes, "cloud.txt");
}

#define EXPECT_REFUSED(bytes, words)                                                                         \
    EXPECT_NE(refusal_of(bytes).find(words), std::string::npos) << refusal_of(bytes)

// All points moved by the same; those that are not finite never move.
std::vector<float> moved(const PointCloud& cloud, const Vec3d& by) {
    std::vector<float> posed = cloud.positions;
    for (std::size_t i = 0; i < posed.size(); ++i)
        if (is_finite(cloud, i / 3)) posed[i] += static_cast<float>(by[static_cast<int>(i % 3)]);
    return posed;
}

std::string joined_rows(const std::vector<std::string>& rows, const std::string& end) {
    std::string text;
    for (const std::string& row : rows) text += row + end;
    return text;
}

// Tables of the points (1, 2, 3), (4, 5.5, -6e1) and what surrounds them in files.
std::vector<std::string> sample_tables() {
    std::vector<std::string> tables;
    const std::string mark = "\xEF\xBB\xBF";
    for (const char* end : {"\n", "\r\n", "\r"})
        for (const std::vector<std::string>& rows :
             std::vector<std::vector<std::string>>{{"1 2 3", "4 5.5 -6e1"},
                                                   {"1\t2\t3", "4\t5.5\t-6e1"},
                                                   {"  1   2 3  ", "", "4\t 5.5 -6e1\t"},
                                                   {"1,2,3", "4,5.5,-6e1"},
                                                   {"1, 2, 3,", "4 ,5.5 , -6e1"},
                                                   {"1;2;3", "4;5,5;-6e1"},
                                                   {"1,0;2,0;3,0", "4,0;5,5;-6e1"},
                                                   {"1;2;3 # so, and", "4;5.5;-6e1"},
                                                   {"1,0\t2,0\t3,0", "4,0\t5,5\t-6e1"},
                                                   {"X\tY\tZ", "1 2 3", "4 5,5 -6e1"},
                                                   {"// x, y, z", "2", "1,0 2,0 3,0", "4,0 5,5 -6e1"},
                                                   {"x,y,z", "1,2,3", "4,5.5,-6e1"},
                                                   {"\"X\";\"Y\";\"Z\"", "1;2;3", "4;5.5;-6e1"},
                                                   {"X Y Z", "1 2 3", "4 5.5 -6e1"},
                                                   {"//X Y Z", "1 2 3", "4 5.5 -6e1"},
                                                   {"# a scan", "# of two points", "1 2 3 # the first",
                                                    "// between", "4 5.5 -6e1 // the last", "#"},
                                                   {"2", "1 2 3", "4 5.5 -6e1"},
                                                   {"1", "1 2 3", "1", "4 5.5 -6e1"},
                                                   {"//X,Y,Z", "2", "1,2,3", "4,5.5,-6e1"},
                                                   {"\"1\",\"2\",\"3\"", "\"4\",\"5.5\",\"-6e1\""},
                                                   {"+1 2.0 3.", "4e0 +5.50 -60"}}) {
            const std::string table = joined_rows(rows, end);
            tables.push_back(table);
            if (end != std::string_view("\n")) continue;
            tables.push_back(mark + table);
            tables.push_back(table.substr(0, table.size() - 1));
        }
    return tables;
}

TEST(Table, ReadsTheSamePointsHoweverTheyAreWritten) {
    for (const std::string& table : sample_tables())
        for (const char* name : {"cloud.txt", "cloud.xyz", "cloud.asc", "cloud.csv", "cloud.pts", "cloud"}) {
            SCOPED_TRACE(name + (":\n" + table));
            const PointCloud cloud = read_bytes(table, name);
            ASSERT_EQ(cloud.size(), 2U);
            EXPECT_EQ(names_of(cloud), "x y z");
            EXPECT_EQ(cloud.file_position(0), Vec3d(1, 2, 3));
            EXPECT_EQ(cloud.file_position(1), Vec3d(4, 5.5, -60));
            EXPECT_TRUE(cloud.remarks.empty());
        }
}

TEST(Table, SavesTheIdenticalFileWhereNothingMoved) {
    for (const std::string& table : sample_tables()) {
        const PointCloud cloud = read_bytes(table, "cloud.txt");
        EXPECT_EQ(written(cloud, {}, "out.txt"), table);
        EXPECT_EQ(written(cloud, {cloud.positions, {}}, "out.asc"), table);
    }
}

TEST(Table, ChangesNothingButTheNumbersThatMoved) {
    for (const std::string& table : sample_tables()) {
        SCOPED_TRACE(table);
        const PointCloud cloud = read_bytes(table, "cloud.txt");
        std::vector<float> posed = cloud.positions;
        posed[1] += 0.25F;
        const std::string saved = written(cloud, {posed, {}}, "out.txt");
        const PointCloud back = read_bytes(saved, "cloud.txt");
        EXPECT_EQ(back.file_position(0), Vec3d(1, 2.25, 3));
        EXPECT_EQ(back.file_position(1), Vec3d(4, 5.5, -60));
        // Put in again what was there, and it is the file.
        const std::string number = table.find("2,0") != std::string::npos   ? "2,0"
                                   : table.find("2.0") != std::string::npos ? "2.0"
                                                                            : "2";
        std::string undone = saved;
        const std::size_t at = std::min(undone.find("2.25"), undone.find("2,25"));
        ASSERT_NE(at, std::string::npos);
        EXPECT_EQ(undone.replace(at, 4, number), table);
    }
}

TEST(Table, AddsColumnsBehindTheOthers) {
    const std::vector<float> far{0.5F, -2};
    for (const std::string& table : sample_tables()) {
        SCOPED_TRACE(table);
        const PointCloud cloud = read_bytes(table, "cloud.txt");
        std::vector<std::string> heard;
        const std::string saved = written(cloud, {{}, {}, {{"far", far}}}, "out.txt", &heard);
        const PointCloud back = read_bytes(saved, "cloud.txt");
        ASSERT_EQ(back.attributes.size(), 4U);
        EXPECT_EQ(back.positions, cloud.positions);
        const bool named = table.find_first_of("xX") != std::string::npos;
        EXPECT_EQ(back.attributes[3].name, named ? "far" : "column_4");
        EXPECT_EQ(heard.empty(), named) << joined(heard);
        for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(value_at(back.attributes[3], i), far[i]);
    }
    EXPECT_EQ(written(read_bytes("x,y,z\n1 2 3\n4\t5 6\n", "a.csv"), {{}, {}, {{"far", far}}}, "a.csv"),
              "x,y,z,far\n1 2 3 0.5\n4\t5 6 -2\n");
    EXPECT_EQ(
        written(read_bytes("\"X\",\"Y\",\"Z\"\n1,2,3\n4,5,6\n", "a.csv"), {{}, {}, {{"far", far}}}, "a.csv"),
        "\"X\",\"Y\",\"Z\",\"far\"\n1,2,3,0.5\n4,5,6,-2\n");
}

TEST(Table, KeepsCoordinatesFarFromTheOriginInFull) {
    const std::string bytes =
        "665187.522077 5648349.895035 241.767693\n665188.522077 5648350.895035 242.767693\n";
    const PointCloud cloud = read_bytes(bytes, "cloud.xyz");
    EXPECT_EQ(cloud.file_position(0), Vec3d(665187.522077, 5648349.895035, 241.767693));
    std::vector<float> posed = cloud.positions;
    posed[1] += 0.5F;
    const double own = 5648349.895035;
    const double value = own + (static_cast<double>(posed[1]) - static_cast<double>(cloud.positions[1]));
    const std::string saved = written(cloud, {posed, {}}, "cloud.xyz");
    EXPECT_EQ(read_bytes(saved, "cloud.xyz").file_position(0)[1], value);
    EXPECT_TRUE(saved.starts_with("665187.522077 5648350.395035 241.767693\n")) << saved;
    EXPECT_EQ(saved.substr(saved.find('\n')), bytes.substr(bytes.find('\n')));
}

TEST(Table, KnowsUnnamedColumnsByTheirValues) {
    EXPECT_EQ(columns_of("1 2 3 255 0 7\n4 5 6 1 2 3\n"), "x y z red green blue");
    EXPECT_EQ(columns_of("1 2 3 0 0 -1\n4 5 6 0.6 0.8 0\n"), "x y z nx ny nz");
    EXPECT_EQ(columns_of("1 2 3 0 0 1\n4 5 6 1 0 0\n"), "x y z nx ny nz");
    EXPECT_EQ(columns_of("1 2 3 -700 255 0 7\n"), "x y z intensity red green blue");
    EXPECT_EQ(columns_of("1 2 3 70 255 0 7\n1 2 4 70 255 0 7\n"), "x y z intensity red green blue");
    EXPECT_EQ(columns_of("1 2 3 70 255 0 255\n"), "x y z red green blue alpha");
    EXPECT_EQ(columns_of("1 2 3 1 0 0 9 9 9\n"), "x y z nx ny nz red green blue");
    EXPECT_EQ(columns_of("1 2 3 9 9 9 1 0 0\n"), "x y z red green blue nx ny nz");
    EXPECT_EQ(columns_of("1 2 3 0 0 1 10 20 30 0.5\n"), "x y z nx ny nz red green blue column_10")
        << "a level floor's normals are no colours";
    EXPECT_EQ(columns_of("1 2 3 0 0 1 5\n"), "x y z nx ny nz column_7");
    EXPECT_EQ(columns_of("1 2 3 0.5 0.5 7\n"), "x y z column_4 column_5 column_6");
    EXPECT_EQ(columns_of("1 2 3 25\n"), "x y z column_4");
    EXPECT_EQ(columns_of("1 2 3 25\n", "cloud.pts"), "x y z intensity");
    EXPECT_EQ(columns_of("1 2 3 4 5\n"), "x y z column_4 column_5");
    const PointCloud colors = read_bytes("1 2 3 255.0 0.0 7.0\n", "cloud.txt");
    EXPECT_EQ(colors.attributes[3].type, ScalarType::uint8);
    EXPECT_EQ(colors.attributes[0].type, ScalarType::float64);
    EXPECT_EQ(value_at(colors.attributes[3], 0), 255);
    const PointCloud pure =
        read_bytes("//X Y Z Rf Gf Bf\n1 2 3 1.0 0.0 1.0\n1 2 4 1.0 1.0 1.0\n", "cloud.txt");
    EXPECT_NE(pure.attributes[3].type, ScalarType::uint8) << "fractions: of bytes it would be next to black";
    EXPECT_EQ(brightest_value(pure, {3, 4, 5}), 1);
}

TEST(Table, KnowsNamedColumnsByTheirNames) {
    EXPECT_EQ(columns_of("Z,Y,X,R,G,B,Intensity,\"GPS time\"\n3,2,1,4,5,6,7,8\n"),
              "z y x red green blue intensity GPS_time");
    EXPECT_EQ(read_bytes("Z,Y,X\n3,2,1\n", "a.csv").file_position(0), Vec3d(1, 2, 3));
    EXPECT_EQ(columns_of("//X Y Z Rf Gf Bf Nx Ny Nz\n1 2 3 .5 1 0 0 0 1\n"), "x y z red green blue nx ny nz");
    EXPECT_EQ(columns_of("\"Points:0\",\"Points:1\",\"Points:2\",\"Normals:0\"\n1,2,3,4\n"), "x y z nx");
    EXPECT_EQ(columns_of("x,y,z,4,nan\n1,2,3,4,5\n"), "x y z 4 nan") << "names may look like numbers";
    EXPECT_EQ(columns_of("x y z r g b Red\n1 2 3 4 5 6 7\n"), "x y z red green blue Red");
    EXPECT_EQ(columns_of("x,y,z,a,b,c\n1,2,3,4,5,6\n"), "x y z a b c") << "no colours, but angles";
    EXPECT_EQ(columns_of("1.#IND 2 3 4\n"), "x y z column_4") << "no remark begins within a word";
    EXPECT_EQ(columns_of("1 2 1.#QNAN//4\n"), "x y z");
    EXPECT_EQ(columns_of("# x y z\n1 2 3 4\n"), "x y z column_4") << "a remark that names too few is one";
    const PointCloud deep = read_bytes("x y z r g b\n1 2 3 65535 256 0\n", "a.txt");
    EXPECT_EQ(deep.attributes[3].type, ScalarType::uint16);
    const PointCloud fraction = read_bytes("x y z r g b\n1 2 3 .5 1 0\n", "a.txt");
    EXPECT_EQ(fraction.attributes[3].type, ScalarType::float64);
}

TEST(Table, TurnsNormals) {
    const PointCloud cloud = read_bytes("1 2 3 0 0 1\n4 5 6 0.0 1 0\n", "cloud.xyz");
    const std::vector<float> normals{0.6F, 0, 0.8F, 0, 1, 0};
    EXPECT_EQ(written(cloud, {{}, normals}, "out.xyz"), "1 2 3 0.6 0 0.8\n4 5 6 0.0 1 0\n");
}

TEST(Table, KeepsPointsThatAreNotFinite) {
    const std::string bytes = "1 2 3\nnan NaN -inf\n1e999 2 3\n4 5 6\n";
    const PointCloud cloud = read_bytes(bytes, "cloud.xyz");
    EXPECT_EQ(cloud.size(), 4U);
    EXPECT_FALSE(is_finite(cloud, 1));
    EXPECT_FALSE(is_finite(cloud, 2));
    EXPECT_EQ(cloud.remarks.size(), 1U);
    EXPECT_EQ(written(cloud, {moved(cloud, {1, 1, 1}), {}}, "out.xyz"),
              "2 3 4\nnan NaN -inf\n1e999 2 3\n5 6 7\n");
}

TEST(Table, ReadsFilesOfNoPointsAndOfOne) {
    for (const char* bytes : {"x,y,z\n", "x y z", "0\n", "# nothing\n0\n"}) {
        const PointCloud none = read_bytes(bytes, "cloud.csv");
        EXPECT_EQ(none.size(), 0U);
        EXPECT_EQ(written(none, {none.positions, {}}, "out.csv"), bytes);
    }
    const PointCloud one = read_bytes("1 2 3", "cloud.pts");
    EXPECT_EQ(written(one, {moved(one, {1, 0, 0}), {}}, "out.pts"), "2 2 3");
}

TEST(Table, OfNoPointsHasTheColumnsThatItNames) {
    for (const char* bytes :
         {"x;y;z;q\n", "# x y z q\n0\n", "// x,y,z,q\n0 # points\n", "#x\ty\tz\tq\r\n0\r\n"}) {
        const PointCloud none = read_bytes(bytes, "cloud.csv");
        ASSERT_EQ(names_of(none), "x y z q") << bytes;
        EXPECT_EQ(written(none, {}, "out.csv"), bytes);
        const std::string more = written(none, {{}, {}, {{"weight", {}}}}, "out.csv");
        EXPECT_EQ(names_of(read_bytes(more, "cloud.csv")), "x y z q weight") << more;
    }
}

TEST(Table, RefusesWhatIsNone) {
    EXPECT_REFUSED("-+e093e\n", "cloud.txt:1: '-+e093e' is neither a row of numbers nor");
    EXPECT_REFUSED("\n\n# only a remark\n", "ends before any row of numbers");
    EXPECT_REFUSED("\xEF\xBB\xBF", "ends before any row of numbers");
    EXPECT_REFUSED("1 2\n3 4\n", "cloud.txt:1: has 2 numbers in its first row; a point needs x, y and z");
    EXPECT_REFUSED("A point cloud\n1 2 3\n", "cloud.txt:1: 'A point cloud' is neither");
    EXPECT_REFUSED("x y z\nx y z\n1 2 3\n", "cloud.txt:2: 'x y z' is neither");
    EXPECT_REFUSED("X,Y,X\n\n0, 0, 0\n", "cloud.txt:1: names the column 'X' twice");
    EXPECT_REFUSED("a,b,c\n0, 0, 0\n", "cloud.txt:1: 'a,b,c' is neither");
    EXPECT_REFUSED("x,y,z\n0,0,0,0\n", "cloud.txt:1: names 3 columns, but the first row has 4 numbers");
    EXPECT_REFUSED("\"x\",\"y\",\"z\n1,2,3\n", "cloud.txt:1: has a quote that is not closed");
    EXPECT_REFUSED("x y z\n1 2 ?\n", "cloud.txt:2: has '?' among its numbers");
    EXPECT_REFUSED(std::string("1\0 2 3", 6), "cloud.txt:1");
}

TEST(Table, RefusesRowsThatAreWrong) {
    EXPECT_REFUSED("1 2 3 4 5 6\n1 2 3 4 5\n", "cloud.txt:2: has 5 numbers, but there are 6 columns");
    EXPECT_REFUSED("1 2 3\n\r\n1 2\r\n", "cloud.txt:3: has 2 numbers, but there are 3 columns");
    EXPECT_REFUSED("1 2 3\n1 2 3 4\n", "cloud.txt:2: has more numbers than there are columns, from '4' on");
    EXPECT_REFUSED("1,2,3\n1,,3\n", "cloud.txt:2: has no number in column y, but ',3'");
    EXPECT_REFUSED("X,Y,Z\n1,2,3\n1,2,three\n", "cloud.txt:3: has 'three' in column 'Z', which is no number");
    EXPECT_REFUSED("1 2 3\n1 2 3x\n", "has '3x' in column z");
    EXPECT_REFUSED("1 2.5 3\n1,5 2 3\n", "decimal commas are understood where no number has a decimal point");
    EXPECT_REFUSED("1,5 2 3\n1.5 2 3\n", "has '1.5' in column x, which is no number");
    EXPECT_REFUSED("1, 2 3\n4, 5 6\n", "has '2 3' among its numbers");
    EXPECT_REFUSED("1;2,5;3\n1;2.5;3\n", "has '2.5' in column y");
    EXPECT_REFUSED("\"1\",2,3\n\"1,2,3\n", "cloud.txt:2: has '1' in column x");
    EXPECT_REFUSED("1 2 3\n4\n", "cloud.txt:2: has 1 number,");
    EXPECT_REFUSED("1 2 3\n1 2 0x10\n", "has '0x10'");
}

TEST(Table, BelievesCountsOnlyWhereTheyAreRight) {
    EXPECT_REFUSED("3\n1 2 3\n4 5 6\n", "ends after 2 rows, though 3 are promised");
    EXPECT_REFUSED("18446744073709551615\n1 2 3\n", "ends after 1 rows");
    EXPECT_REFUSED("99999999999999999999\n1 2 3\n", "cloud.txt:1: has 1 number,");
    EXPECT_REFUSED("2\n1 2 3\n1\n4 5 6\n", "cloud.txt:3: has 1 number,");
    EXPECT_REFUSED("1\n1 2 3\n18446744073709551615\n4 5 6\n", "cloud.txt:3: has 1 number,");
    const std::string more = "1\n1 2 3\n4 5 6\n";
    const PointCloud cloud = read_bytes(more, "cloud.pts");
    EXPECT_EQ(cloud.size(), 2U);
    ASSERT_EQ(cloud.remarks.size(), 1U);
    EXPECT_NE(cloud.remarks[0].find("more rows than the 1 points"), std::string::npos);
    EXPECT_EQ(written(cloud, {}, "out.pts"), more);
}

TEST(Table, AsksForMemoryInProportion) {
    // One long row and many empty lines: neither may multiply the other.
    std::string bytes;
    for (int i = 0; i < 9999; ++i) bytes += "1 ";
    bytes += "1\n" + std::string(1'000'000, '\n');
    EXPECT_EQ(read_bytes(bytes, "cloud.txt").size(), 1U);
    EXPECT_REFUSED("1 " + bytes, "more than 10000 columns");
    // More line ends of one kind than of the other.
    std::string mixed = "1 2 3\n";
    for (int i = 0; i < 1000; ++i) mixed += "1 2 3\r";
    EXPECT_EQ(read_bytes(mixed, "cloud.txt").size(), 1001U);
}

TEST(Table, WritesACloudFromElsewhereByTheCustomsOfTheExtension) {
    PointCloud cloud = make_cloud(std::vector<float>{0, 0.1F, -1e-7F, 1, 2, 3});
    EXPECT_EQ(written(cloud, {}, "out.xyz"), "0 0.1 -1e-07\n1 2 3\n");
    EXPECT_EQ(written(cloud, {}, "out.csv"), "x,y,z\n0,0.1,-1e-07\n1,2,3\n");
    EXPECT_EQ(written(cloud, {}, "out.pts"), "2\n0 0.1 -1e-07\n1 2 3\n");
    for (const char* name : {"red", "green", "blue"})
        add_attribute(cloud, name, std::vector<std::uint8_t>{1, 255});
    EXPECT_EQ(written(cloud, {}, "out.txt"), "0 0.1 -1e-07 1 1 1\n1 2 3 255 255 255\n");
    add_attribute(cloud, "intensity", std::vector<float>{0.5F, 7});
    EXPECT_EQ(written(cloud, {}, "out.asc"),
              "//x y z red green blue intensity\n0 0.1 -1e-07 1 1 1 0.5\n1 2 3 255 255 255 7\n");
    EXPECT_EQ(written(cloud, {}, "out.pts"), "2\n0 0.1 -1e-07 0.5 1 1 1\n1 2 3 7 255 255 255\n");
    std::vector<std::string> heard;
    cloud.attributes.push_back(
        {"pair", ScalarType::int16, std::vector<std::byte>(8, std::byte{1}), {0, 2, 4}});
    cloud.attributes.push_back({"a,b", ScalarType::uint64, std::vector<std::byte>(16, std::byte{255}), {}});
    cloud.attributes.push_back(
        {"links", ScalarType::int16, std::vector<std::byte>(2, std::byte{1}), {0, 0, 1}});
    EXPECT_EQ(written(cloud, {}, "out.csv", &heard), "x,y,z,red,green,blue,intensity,pair_1,pair_2,a_b\n"
                                                     "0,0.1,-1e-07,1,1,1,0.5,257,257,18446744073709551615\n"
                                                     "1,2,3,255,255,255,7,257,257,18446744073709551615\n");
    EXPECT_EQ(heard.size(), 2U) << joined(heard);
    heard.clear();
    (void)written(cloud, {}, "out.pts", &heard);
    EXPECT_NE(joined(heard).find("the columns 'pair', 'a_b' and 'links' are left out, since PTS has only"),
              std::string::npos)
        << joined(heard);
    const std::vector<float> far{5, 6};
    EXPECT_EQ(written(make_cloud(std::vector<float>{1, 2, 3, 4, 5, 6}), {{}, {}, {{"far", far}}}, "out.xyz"),
              "//x y z far\n1 2 3 5\n4 5 6 6\n");
    EXPECT_EQ(written(make_cloud({}), {}, "out.pts"), "0\n");
}

TEST(Table, ReadsBackWhatItWrote) {
    PointCloud cloud = make_cloud(std::vector<float>{0.1F, 1e-30F, 3e30F, -1, 2, 3, 7, 8, 9});
    for (const char* name : {"red", "green", "blue"})
        add_attribute(cloud, name, std::vector<std::uint8_t>{1, 255, 6});
    for (const char* name : {"nx", "ny", "nz"}) add_attribute(cloud, name, std::vector<float>{0.6F, 0, 1});
    add_attribute(cloud, "stretch", std::vector<float>{0.1F, NAN, 1});
    for (const char* name : {"out.xyz", "out.txt", "out.csv", "out.asc"}) {
        SCOPED_TRACE(name);
        const PointCloud back = read_bytes(written(cloud, {}, name), name);
        EXPECT_EQ(names_of(back), names_of(cloud));
        for (std::size_t a = 0; a < cloud.attributes.size(); ++a)
            for (std::size_t i = 0; i < cloud.size(); ++i) {
                const auto is = static_cast<float>(value_at(back.attributes[a], i));
                const auto was = static_cast<float>(value_at(cloud.attributes[a], i));
                EXPECT_TRUE(is == was || (std::isnan(is) && std::isnan(was))) << cloud.attributes[a].name;
            }
    }
}

// A cloud of two points with columns behind x y z.
struct Column {
    const char* name;
    std::vector<float> values;
};
PointCloud cloud_with(const std::vector<Column>& columns) {
    PointCloud cloud = make_cloud(std::vector<float>{1, 2, 3, 4, 5, 6});
    for (const Column& column : columns) add_attribute(cloud, column.name, column.values);
    return cloud;
}

TEST(Table, NamesColumnsWhereTheirNumbersWouldNotTellTheSameNames) {
    const std::vector<Column> unknown[] = {
        {{"nx", {0, 0}}, {"ny", {0, 0}}, {"nz", {0, 0}}},          // no normals: 0 … 255, as colours are
        {{"nx", {0, 1}}, {"ny", {0, 0}}, {"nz", {2, 0}}},          // none of length 1
        {{"red", {0, 1}}, {"green", {1, 0}}, {"blue", {0, 0}}},    // may be normals
        {{"ny", {0, 1}}, {"nx", {1, 0}}, {"nz", {0, 0}}},          // in another order
        {{"nx", {0.6F, 1}}, {"ny", {0.8F, 0}}},                    // two
        {{"red", {0.5F, 1}}, {"green", {1, 0}}, {"blue", {0, 0}}}, // fractions
        {{"intensity", {7, 8}}},                                   // alone
        {{"column_5", {7, 8}}},                                    // in the fourth place
        {{"p", {1, 2}}, {"q", {1, 2}}, {"u", {1, 2}}, {"v", {300, 2}}}}; // of anybody
    const std::vector<Column> known[] = {
        {},
        {{"nx", {0, 1}}, {"ny", {0, 0}}, {"nz", {1, 0}}},
        {{"red", {9, 255}}, {"green", {1, 0}}, {"blue", {0, 0}}},
        {{"red", {9, 255}}, {"green", {1, 0}}, {"blue", {0, 0}}, {"alpha", {255, 255}}},
        {{"red", {9, 9}},
         {"green", {9, 9}},
         {"blue", {9, 9}},
         {"nx", {1, 1}},
         {"ny", {0, 0}},
         {"nz", {0, 0}}},
        {{"column_4", {7, 8}}}};
    for (const char* name : {"out.xyz", "out.txt", "out.asc", "out.csv"})
        for (const bool is_known : {false, true})
            for (const std::vector<Column>& columns : is_known
                                                          ? std::span(known).first(std::size(known))
                                                          : std::span<const std::vector<Column>>(unknown)) {
                const PointCloud cloud = cloud_with(columns);
                SCOPED_TRACE(name + (": " + names_of(cloud)));
                const std::string bytes = written(cloud, {}, name);
                const bool named = bytes.find_first_of("xn") != std::string::npos;
                EXPECT_EQ(named, !is_known || name == std::string("out.csv")) << bytes;
                EXPECT_EQ(columns_of(bytes, name), names_of(cloud));
            }
    std::vector<std::string> heard;
    (void)written(cloud_with(unknown[2]), {}, "out.pts", &heard);
    EXPECT_NE(joined(heard).find("PTS names no columns"), std::string::npos) << joined(heard);
}

TEST(Table, GivesListsColumnsOfTheirOwn) {
    PointCloud cloud = cloud_with({{"pair_1", {7, 8}}});
    cloud.attributes.push_back({"pair", ScalarType::int64, std::vector<std::byte>(32), {0, 2, 4}});
    const std::int64_t odd = (std::int64_t{1} << 60) + 1; // more digits than a double has
    std::memcpy(cloud.attributes.back().values.data(), &odd, sizeof odd);
    cloud.attributes.push_back({"none", ScalarType::uint8, {}, {0, 0, 0}});
    std::vector<std::string> heard;
    const std::string bytes = written(cloud, {}, "out.csv", &heard);
    EXPECT_EQ(bytes, "x,y,z,pair_1,pair_1_2,pair_2\n1,2,3,7,1152921504606846977,0\n4,5,6,8,0,0\n");
    EXPECT_EQ(heard,
              (std::vector<std::string>{"out.csv: the lists 'none' are left out, since they are empty"}));
    EXPECT_EQ(columns_of(bytes), "x y z pair_1 pair_1_2 pair_2");
}

TEST(Table, WritesNoMoreColumnsThanItReads) {
    PointCloud cloud = make_cloud(std::vector<float>{1, 2, 3});
    for (int i = 0; i < 9999; ++i)
        add_attribute(cloud, "c" + std::to_string(i), std::vector<std::uint8_t>{1});
    std::rotate(cloud.attributes.begin(), cloud.attributes.begin() + 3, cloud.attributes.end());
    cloud.coordinate_columns = {9999, 10000, 10001};
    for (const char* name : {"out.txt", "out.csv", "out.pcd"}) {
        std::vector<std::string> heard;
        const PointCloud back = read_bytes(written(cloud, {}, name, &heard), name);
        EXPECT_EQ(back.attributes.size(), 10'000U) << name;
        EXPECT_EQ(back.file_position(0), Vec3d(1, 2, 3)) << name;
        EXPECT_NE(joined(heard).find("the columns 'c9997' and 'c9998' are left out"), std::string::npos)
            << joined(heard);
        const std::vector<float> far{5};
        EXPECT_NE(refusal_to_write(back, {{}, {}, {{"far", far}}}, name).find("columns cannot be added"),
                  std::string::npos);
    }
}

// Names that all become the same word: each gets a number, and in no time.
TEST(Table, TakesManyNamesThatAreOneWord) {
    std::string names = "x,y,z", row = "1,2,3";
    for (unsigned i = 0; i < 9997; ++i) {
        names += ",\"a";
        for (unsigned bit = 0; bit < 14; ++bit) names += (i >> bit & 1U) != 0 ? ' ' : '\t';
        names += "b\"";
        row += ",4";
    }
    const PointCloud cloud = read_bytes(names + "\n" + row + "\n", "cloud.csv");
    ASSERT_EQ(cloud.attributes.size(), 10'000U);
    EXPECT_EQ(cloud.attributes[3].name, "a______________b");
    EXPECT_EQ(cloud.attributes.back().name, "a______________b_9997");
}

TEST(Table, KeepsAllDigitsOfWhatDoesNotTurn) {
    const PointCloud cloud = read_bytes("1 2 3 0.123456789 0.98765432 0.1\n4 5 6 0 1 0\n", "cloud.txt");
    const std::vector<float> normals{0.123456789F, 0.98765432F, 0.1F, 1, 0, 0};
    EXPECT_EQ(written(cloud, {{}, normals}, "out.xyz"), "1 2 3 0.123456789 0.98765432 0.1\n4 5 6 1 0 0\n");
}

TEST(Table, OfAnotherKindIsWrittenAnew) {
    const PointCloud cloud = read_bytes("x;y;z\n1;2;3\n", "cloud.csv");
    EXPECT_EQ(written(cloud, {}, "out.csv"), "x;y;z\n1;2;3\n");
    EXPECT_EQ(written(cloud, {}, "out.xyz"), "1 2 3\n");
    EXPECT_EQ(written(cloud, {}, "out.pts"), "1\n1 2 3\n");
}

TEST(Table, MovesRealFiles) {
    for (const char* name :
         {"plain/bunnyData.pts", "plain/points_agisoft.xyz", "odd/trimesh_points_cloudcompare.xyz",
          "odd/pdal_site_56_8.pts", "odd/pdal_quoted.txt"}) {
        SCOPED_TRACE(name);
        KNEAD_SAMPLE_OR_SKIP(path, name);
        SilentProgress progress;
        const PointCloud cloud = read_cloud(path, progress);
        std::vector<float> posed = cloud.positions;
        for (std::size_t i = 0; i < posed.size(); i += 3) posed[i] += 1;
        const std::string as_it_was = path.filename().string();
        EXPECT_EQ(written(cloud, {cloud.positions, {}}, as_it_was), read_text(path));
        const PointCloud back = read_bytes(written(cloud, {posed, {}}, as_it_was), as_it_was);
        for (std::size_t i = 0; i < cloud.size(); ++i)
            EXPECT_NEAR((back.file_position(i) - cloud.file_position(i) - Vec3d(1, 0, 0)).norm(), 0, 1e-5);
        for (std::size_t a = 3; a < cloud.attributes.size(); ++a)
            EXPECT_EQ(back.attributes[a].values, cloud.attributes[a].values);
    }
}

} // namespace
} // namespace knead::test
