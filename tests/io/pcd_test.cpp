#include "base/error.h"
#include "io/lzf.h"
#include "io/pcd.h"
#include "io/scalar_bytes.h"
#include "io/through_files.h"
#include "support/scans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace knead::test {
namespace {

constexpr std::size_t sample_points = 6;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

struct SampleKind {
    PcdEncoding encoding = PcdEncoding::ascii;
    ScalarType coordinates = ScalarType::float32;
    bool is_wide = false;        // fields of other types and counts, padding, colours and normals
    bool has_nothing = false;    // point 4 was not seen
    std::string line_end = "\n"; // of the header, and of the rows of a text
};

std::vector<SampleKind> all_sample_kinds() {
    std::vector<SampleKind> kinds;
    for (const PcdEncoding encoding :
         {PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::binary_compressed}) {
        for (const ScalarType type :
             {ScalarType::int16, ScalarType::uint8, ScalarType::int64, ScalarType::float64})
            kinds.push_back({encoding, type, true, false, "\n"});
        for (const bool wide : {false, true})
            for (const bool nothing : {false, true})
                for (const char* end : {"\n", "\r\n"})
                    kinds.push_back({encoding, ScalarType::float32, wide, nothing, end});
    }
    return kinds;
}

std::string name_of(const SampleKind& kind) {
    return std::string(knead::name_of(kind.encoding)) + " " + std::string(knead::name_of(kind.coordinates)) +
           (kind.is_wide ? " wide" : "") + (kind.has_nothing ? " with NaN" : "") +
           (kind.line_end == "\n" ? " LF" : " CRLF");
}

struct SampleField {
    std::string name;
    ScalarType type;
    unsigned count;
    double (*value)(std::size_t point, unsigned k);
};

double color_of(std::size_t point) {
    return static_cast<double>((7 * point) << 16U | (8 * point) << 8U | 9U);
}

std::vector<SampleField> fields_of(const SampleKind& kind) {
    const ScalarType real = ScalarType::float32;
    const auto zero = [](std::size_t, unsigned) { return 0.0; };
    const auto one = [](std::size_t, unsigned) { return 1.0; };
    std::vector<SampleField> fields = {
        {"x", kind.coordinates, 1, [](std::size_t i, unsigned) { return 10.0 + static_cast<double>(i); }},
        {"y", kind.coordinates, 1, [](std::size_t i, unsigned) { return 20.0 - static_cast<double>(i); }}};
    const SampleField z{"z", kind.coordinates, 1,
                        [](std::size_t i, unsigned) { return 30.0 + static_cast<double>(i % 2); }};
    if (kind.is_wide) {
        fields.push_back({"_", ScalarType::uint8, 3, [](std::size_t, unsigned k) { return 200.0 + k; }});
        fields.push_back({"histogram", ScalarType::uint16, 3,
                          [](std::size_t i, unsigned k) { return static_cast<double>(100 * i + k); }});
        fields.push_back(z);
        fields.push_back({"rgba", ScalarType::uint32, 1,
                          [](std::size_t i, unsigned) { return 0x80000000 + color_of(i); }});
        fields.push_back({"normal_x", real, 1, zero});
        fields.push_back({"normal_y", real, 1, zero});
        fields.push_back({"normal_z", real, 1, one});
        fields.push_back({"_", real, 1, zero});
        fields.push_back({"time", ScalarType::uint64, 1,
                          [](std::size_t i, unsigned) { return 1e15 + static_cast<double>(i); }});
    } else {
        fields.push_back(z);
    }
    return fields;
}

void append_value(std::string& text, const SampleKind& kind, ScalarType type, double value) {
    if (kind.encoding == PcdEncoding::ascii) {
        text += std::isnan(value) ? "nan " : std::to_string(static_cast<std::int64_t>(value)) + " ";
        return;
    }
    std::array<std::byte, 8>
        bytes{}; // of this machine, which is little endian like every other that runs tests
    store_scalar(value, type, bytes.data());
    text.append(reinterpret_cast<const char*>(bytes.data()), size_of(type));
}

void append_point(std::string& text, const SampleKind& kind, const SampleField& field, std::size_t i) {
    const bool missing =
        kind.has_nothing && i == 4 && (field.name == "x" || field.name == "y" || field.name == "z");
    for (unsigned k = 0; k < field.count; ++k)
        append_value(text, kind, field.type, missing ? no_number : field.value(i, k));
}

std::string body_of(const SampleKind& kind) {
    std::string body;
    if (kind.encoding == PcdEncoding::binary_compressed) {
        for (const SampleField& field : fields_of(kind))
            for (std::size_t i = 0; i < sample_points; ++i) append_point(body, kind, field, i);
        const auto packed = pack_lzf(std::as_bytes(std::span(body)));
        std::string lengths;
        append_value(lengths, kind, ScalarType::uint32, static_cast<double>(packed.size()));
        append_value(lengths, kind, ScalarType::uint32, static_cast<double>(body.size()));
        return lengths.append(reinterpret_cast<const char*>(packed.data()), packed.size());
    }
    for (std::size_t i = 0; i < sample_points; ++i) {
        for (const SampleField& field : fields_of(kind)) append_point(body, kind, field, i);
        if (kind.encoding == PcdEncoding::ascii) body += kind.line_end;
    }
    return body;
}

// Points (10 + i, 20 - i, 30 + i % 2), three by two.
std::string sample(const SampleKind& kind) {
    const std::string& end = kind.line_end;
    std::string names = "FIELDS", sizes = "SIZE", letters = "TYPE", counts = "COUNT";
    for (const SampleField& field : fields_of(kind)) {
        names += " " + field.name;
        sizes += " " + std::to_string(size_of(field.type));
        letters += " " + std::string(pcd_letter_of(field.type));
        counts += " " + std::to_string(field.count);
    }
    return "# .PCD v0.7 - Point Cloud Data file format" + end + "# made by a test" + end + "VERSION 0.7" +
           end + names + end + sizes + end + letters + end + counts + end + "WIDTH 3" + end + "HEIGHT 2" +
           end + "VIEWPOINT 1 2 3 1 0 0 0" + end + "POINTS 6" + end + "DATA " +
           std::string(knead::name_of(kind.encoding)) + end + body_of(kind);
}

// A text of these lines behind the first of them.
std::string text(const std::string& fields_to_points, const std::string& rows) {
    return "VERSION .7\n" + fields_to_points + "\nDATA ascii\n" + rows;
}

std::string points_text(const std::string& points, const std::string& rows) {
    return text("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + points + "\nHEIGHT 1\nPOINTS " +
                    points,
                rows);
}

PointCloud read(const std::string& bytes) {
    return read_bytes(bytes, "cloud.pcd");
}

std::string refusal_of(const std::string& bytes) {
    return refusal(bytes, "cloud.pcd");
}

#define EXPECT_REFUSED(bytes, words)                                                                         \
    EXPECT_NE(refusal_of(bytes).find(words), std::string::npos) << refusal_of(bytes)

TEST(Pcd, ReadsTheSamePointsFromEveryKindOfFile) {
    for (const SampleKind& kind : all_sample_kinds()) {
        SCOPED_TRACE(name_of(kind));
        const PointCloud cloud = read(sample(kind));
        ASSERT_EQ(cloud.size(), sample_points);
        EXPECT_EQ(file_kind(cloud).format, "pcd");
        EXPECT_EQ(file_kind(cloud).encoding, knead::name_of(kind.encoding));
        for (std::size_t i = 0; i < sample_points; ++i) {
            const auto at = static_cast<double>(i);
            EXPECT_EQ(is_finite(cloud, i), !(kind.has_nothing && i == 4));
            if (is_finite(cloud, i)) {
                EXPECT_EQ(cloud.file_position(i), Vec3d(10 + at, 20 - at, static_cast<double>(30 + i % 2)));
            }
        }
        EXPECT_EQ(cloud.attributes[0].type, kind.coordinates);
        EXPECT_EQ(cloud.remarks.size(), kind.has_nothing ? 1U : 0U);
    }
}

TEST(Pcd, ReadsFieldsOfAllTypesAndCounts) {
    for (const SampleKind& kind : all_sample_kinds()) {
        if (!kind.is_wide) continue;
        SCOPED_TRACE(name_of(kind));
        const PointCloud cloud = read(sample(kind));
        std::string names;
        for (const Attribute& attribute : cloud.attributes) names += attribute.name + " ";
        EXPECT_EQ(names, "x y histogram z red green blue alpha nx ny nz time ");
        const Attribute& histogram = cloud.attributes[2];
        EXPECT_EQ(histogram.type, ScalarType::uint16);
        EXPECT_EQ(histogram.first, (std::vector<std::uint64_t>{0, 3, 6, 9, 12, 15, 18}));
        const Attribute& time = cloud.attributes[11];
        EXPECT_EQ(time.type, ScalarType::uint64);
        for (std::size_t i = 0; i < sample_points; ++i) {
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_EQ(value_at(histogram, 3 * i + k), static_cast<double>(100 * i + k));
            EXPECT_EQ(value_at(cloud.attributes[4], i), 7 * static_cast<double>(i));
            EXPECT_EQ(value_at(cloud.attributes[5], i), 8 * static_cast<double>(i));
            EXPECT_EQ(value_at(cloud.attributes[6], i), 9);
            EXPECT_EQ(value_at(cloud.attributes[7], i), 128);
            EXPECT_EQ(value_at(time, i), 1e15 + static_cast<double>(i));
        }
        EXPECT_TRUE(find_normals(cloud).has_value());
    }
}

TEST(Pcd, SavesTheIdenticalFileWhereNothingMoved) {
    for (const SampleKind& kind : all_sample_kinds()) {
        SCOPED_TRACE(name_of(kind));
        const std::string bytes = sample(kind);
        const PointCloud cloud = read(bytes);
        EXPECT_EQ(written(cloud, {}, "out.pcd"), bytes);
        EXPECT_EQ(written(cloud, {cloud.positions, read_normals(cloud)}, "out.pcd"), bytes);
        const std::string more = bytes + "\x07 more"; // kept, whatever it is
        EXPECT_EQ(written(read(more), {}, "out.pcd"), more);
    }
}

TEST(Pcd, ChangesNothingButTheNumbersThatMoved) {
    for (const SampleKind& kind : all_sample_kinds()) {
        SCOPED_TRACE(name_of(kind));
        const std::string bytes = sample(kind) + "\n\n";
        const PointCloud cloud = read(bytes);
        std::vector<float> posed = cloud.positions;
        posed[3 * 1] += 2;     // x of point 1: 11 → 13
        posed[3 * 5 + 2] -= 1; // z of point 5: 31 → 30
        std::vector<float> normals = read_normals(cloud);
        if (!normals.empty()) std::swap(normals[0], normals[2]); // of point 0: (0, 0, 1) → (1, 0, 0)
        const std::string saved = written(cloud, {posed, normals}, "out.pcd");
        const PointCloud back = read(saved);
        EXPECT_EQ(back.file_position(1), Vec3d(13, 19, 31));
        EXPECT_EQ(back.file_position(5), Vec3d(15, 15, 30));
        EXPECT_EQ(read_normals(back), normals);
        ASSERT_EQ(back.attributes.size(), cloud.attributes.size());
        for (const char* name : {"histogram", "red", "alpha", "time", "y"})
            if (const auto column = find_attribute(cloud, name)) {
                EXPECT_EQ(back.attributes[*column].values, cloud.attributes[*column].values) << name;
            }
        // And back again: what was between the numbers is there, too.
        EXPECT_EQ(written(back, {cloud.positions, read_normals(cloud)}, "out.pcd").size(), bytes.size());
        if (kind.encoding != PcdEncoding::binary_compressed) {
            EXPECT_EQ(written(back, {cloud.positions, read_normals(cloud)}, "out.pcd"), bytes);
        }
        EXPECT_EQ(saved.substr(0, saved.find("DATA")), bytes.substr(0, bytes.find("DATA")));
    }
}

TEST(Pcd, KeepsPointsThatWereNotSeen) {
    for (const SampleKind& kind : all_sample_kinds()) {
        if (!kind.has_nothing) continue;
        SCOPED_TRACE(name_of(kind));
        const PointCloud cloud = read(sample(kind));
        std::vector<float> posed = cloud.positions;
        for (float& value : posed) value += 1;
        const PointCloud back = read(written(cloud, {posed, {}}, "out.pcd"));
        EXPECT_EQ(back.file_position(3), Vec3d(14, 18, 32));
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t size = size_of(kind.coordinates);
            const Attribute& was = cloud.attributes[cloud.coordinate_columns[c]];
            const Attribute& is = back.attributes[back.coordinate_columns[c]];
            EXPECT_EQ(std::memcmp(was.values.data() + 4 * size, is.values.data() + 4 * size, size), 0);
        }
    }
}

TEST(Pcd, AddsColumnsBehindThoseOfEveryKindOfFile) {
    const std::vector<float> far{0, 0.5F, 1, -2, 1e-20F, 6};
    for (const SampleKind& kind : all_sample_kinds()) {
        SCOPED_TRACE(name_of(kind));
        const PointCloud cloud = read(sample(kind));
        const PointCloud back = read(written(cloud, {{}, {}, {{"far", far}, {"x", far}}}, "out.pcd"));
        ASSERT_EQ(back.attributes.size(), cloud.attributes.size() + 2);
        for (std::size_t a = 0; a < cloud.attributes.size(); ++a) {
            EXPECT_EQ(back.attributes[a].name, cloud.attributes[a].name);
            EXPECT_EQ(back.attributes[a].values, cloud.attributes[a].values);
        }
        for (const char* name : {"far", "x_2"}) {
            const Attribute& added = back.attributes[find_attribute(back, name).value()];
            EXPECT_EQ(added.type, ScalarType::float32);
            EXPECT_EQ(std::memcmp(added.values.data(), far.data(), 4 * far.size()), 0);
        }
    }
}

TEST(Pcd, AddsColumnsWhateverTheOrderOfTheHeader) {
    const std::vector<float> far{7};
    const PointCloud cloud =
        read(text("COUNT 1 1 1\nTYPE F F F\nSIZE 4 4 4\nFIELDS x y z\nPOINTS 1", "1 2 3\n"));
    EXPECT_EQ(written(cloud, {{}, {}, {{"far", far}}}, "out.pcd"),
              text("COUNT 1 1 1 1\nTYPE F F F F\nSIZE 4 4 4 4\nFIELDS x y z far\nPOINTS 1", "1 2 3 7\n"));
}

TEST(Pcd, UnderstandsOldAndShortHeaders) {
    EXPECT_EQ(read("COLUMNS x y z\nPOINTS 1\nDATA ascii\n1 2 3").file_position(0), Vec3d(1, 2, 3));
    EXPECT_EQ(read("VERSION .5\nFIELDS x y z\nWIDTH 2\nDATA ascii\n1 2 3\n4 5 6\n").size(), 2U);
    EXPECT_EQ(
        read("# a\n\n  VERSION 0.6\nTYPE F F F\nFIELDS x y z\nWIDTH 0\nHEIGHT 0\nPOINTS 1\nDATA ascii\n1 2 3")
            .size(),
        1U);
    EXPECT_EQ(read("FIELDS x y z\rPOINTS 1\rDATA ascii\r1 2 3\r").size(), 1U);
}

TEST(Pcd, ReadsFilesOfNoPointsAndOfOne) {
    for (const char* encoding : {"ascii", "binary", "binary_compressed"}) {
        const std::string bytes = "FIELDS x y z\nPOINTS 0\nDATA " + std::string(encoding) + "\n";
        const PointCloud none = read(bytes);
        EXPECT_EQ(none.size(), 0U);
        EXPECT_EQ(written(none, {none.positions, {}}, "out.pcd"), bytes);
    }
    const PointCloud one = read(points_text("1", "1 2 3"));
    std::vector<float> posed = one.positions;
    posed[0] += 0.5F;
    EXPECT_EQ(written(one, {posed, {}}, "out.pcd"), points_text("1", "1.5 2 3"));
}

TEST(Pcd, PackedColorsOfEitherTypeAreColumnsAndOnlyOnce) {
    const std::string real =
        text("FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nPOINTS 1", "1 2 3 4.2108e+06\n");
    const PointCloud cloud = read(real);
    float packed = 4.2108e+06F;
    std::uint32_t bits = 0;
    std::memcpy(&bits, &packed, 4);
    ASSERT_EQ(cloud.attributes.size(), 6U) << "no alpha";
    EXPECT_EQ(value_at(cloud.attributes[3], 0), bits >> 16U & 255U);
    EXPECT_EQ(value_at(cloud.attributes[4], 0), bits >> 8U & 255U);
    EXPECT_EQ(value_at(cloud.attributes[5], 0), bits & 255U);
    EXPECT_EQ(written(cloud, {}, "out.pcd"), real);
    const PointCloud both = read(text("FIELDS x y z red rgb\nPOINTS 1", "1 2 3 4 5"));
    EXPECT_EQ(both.attributes.back().name, "rgb");
    EXPECT_EQ(both.attributes.size(), 5U);
}

TEST(Pcd, RefusesHeadersThatAreWrong) {
    EXPECT_REFUSED("\xEF\xBB\xBF" + points_text("1", "1 2 3"), "cloud.pcd");
    EXPECT_REFUSED("\xEF\xBB\xBF# .PCD v0.7\n" + points_text("1", "1 2 3"), "behind a byte-order mark");
    EXPECT_REFUSED("VERSION 0.8\nFIELDS x y z\nPOINTS 0\nDATA ascii\n", "cloud.pcd:1: PCD version '0.8'");
    EXPECT_REFUSED("VERSION .7\nFIELDS x y z\nPOINTS 0\n", "no DATA line");
    EXPECT_REFUSED("VERSION .7\nPOINTS 0\nDATA ascii\n", "no FIELDS line");
    EXPECT_REFUSED("VERSION .7\nFIELDS x y z\nDATA ascii\n", "neither POINTS nor WIDTH");
    EXPECT_REFUSED("VERSION .7\nFIELDS x y z\nFIELDS x y z\nDATA ascii\n", "cloud.pcd:3: a second FIELDS");
    EXPECT_REFUSED("VERSION .7\nFIELDS\nDATA ascii\n", "cloud.pcd:2: a FIELDS line");
    EXPECT_REFUSED("VERSION .7\nFIELDS x y z\nPOINTS 0\nDATA zip\n", "this one says 'zip'");
    EXPECT_REFUSED("VERSION .7\nFIELDS x y z\nCOLOR 1\n", "unknown header line 'COLOR'");
    EXPECT_REFUSED(text("FIELDS x y\nPOINTS 0", ""), "no field z");
    EXPECT_REFUSED(text("FIELDS x y z x\nPOINTS 0", ""), "two fields are called 'x'");
    EXPECT_REFUSED(text("FIELDS x y z\nCOUNT 1 1 2\nPOINTS 0", ""), "z has COUNT 2");
    EXPECT_REFUSED(text("FIELDS x y z w\nCOUNT 1 1 1 0\nPOINTS 0", ""), "COUNT 0");
    EXPECT_REFUSED(text("FIELDS x y z\nSIZE 4 4\nPOINTS 0", ""), "2 words in its SIZE line");
    EXPECT_REFUSED(text("FIELDS x y z\nSIZE 4 4 3\nPOINTS 0", ""), "SIZE '3'");
    EXPECT_REFUSED(text("FIELDS x y z\nSIZE 4 4 2\nTYPE F F F\nPOINTS 0", ""), "SIZE '2'");
    EXPECT_REFUSED(text("FIELDS x y z\nTYPE F F D\nPOINTS 0", ""), "TYPE 'D'");
    EXPECT_REFUSED(text("FIELDS x y z\nPOINTS -1", ""), "'-1' is not a whole number");
    EXPECT_REFUSED(text("FIELDS x y z\nPOINTS 99999999999999999999", ""), "larger than any file");
    EXPECT_REFUSED(text("FIELDS x y z\nHEIGHT 2\nPOINTS 2", "1 2 3\n4 5 6"), "no WIDTH");
    EXPECT_REFUSED(text("FIELDS x y z\nWIDTH 2\nHEIGHT 2\nPOINTS 5", "1 2 3"), "2 × HEIGHT 2, but 5");
    std::string many = "FIELDS x y z";
    for (int i = 0; i < 10'000; ++i) many += " _";
    EXPECT_REFUSED(text(many + "\nPOINTS 0", ""), "up to 10000 fields");
}

TEST(Pcd, RefusesCountsThatLie) {
    EXPECT_REFUSED(text("FIELDS x y z\nWIDTH 4294967295\nHEIGHT 4294967295", "1 2 3"), "more points than");
    EXPECT_REFUSED(text("FIELDS x y z\nWIDTH 65536\nHEIGHT 65536", "1 2 3"), "more points than");
    EXPECT_REFUSED(points_text("4000000000", "1 2 3\n"), "promises 4000000000 points, but only 6 bytes");
    EXPECT_REFUSED(points_text("2", "1 2 3\n\n       \n\n"), "point 1 is missing");
    EXPECT_REFUSED(text("FIELDS x y z w\nCOUNT 1 1 1 4294967295\nPOINTS 1", "1 2 3 4\n"),
                   "but only 8 bytes follow");
    EXPECT_REFUSED("FIELDS x y z\nPOINTS 2\nDATA binary\n" + std::string(23, 'a'),
                   "promises 2 points, but only 23");
    EXPECT_EQ(refusal_of("FIELDS x y z\nPOINTS 2\nDATA binary\n" + std::string(24, 'a')), "");
}

TEST(Pcd, RefusesRowsThatAreWrong) {
    EXPECT_REFUSED(points_text("2", "1 2 3\n4 5\n6 7 8\n"),
                   "cloud.pcd:11: point 1 ends before the field 'z'");
    EXPECT_REFUSED(points_text("2", "1 2 3\n4 5 6 7\n"), "point 1 has more numbers");
    EXPECT_REFUSED(points_text("2", "1 2 3\n4 5 6a\n"), "has '6a' for the field 'z', which is no float32");
    EXPECT_EQ(refusal_of(text("FIELDS x _ y z\nPOINTS 1", "1 ? 2 3")), "") << "padding may be anything";
}

std::string compressed(std::uint32_t packed, std::uint32_t unpacked, const std::string& stream) {
    std::string lengths(8, '\0');
    std::memcpy(lengths.data(), &packed, 4);
    std::memcpy(lengths.data() + 4, &unpacked, 4);
    return "FIELDS x y z\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary_compressed\n" + lengths + stream;
}

TEST(Pcd, RefusesCompressedBodiesThatLie) {
    const std::string stream = "\x17" + std::string(24, '\0'); // 24 bytes as they are
    EXPECT_EQ(refusal_of(compressed(25, 24, stream)), "");
    EXPECT_REFUSED(compressed(26, 24, stream), "should take 26 bytes, but only 25 follow");
    EXPECT_REFUSED(compressed(4294967295U, 24, stream), "should take 4294967295 bytes");
    EXPECT_REFUSED(compressed(25, 23, stream), "should unpack to 23 bytes, which are not the 2 points");
    EXPECT_REFUSED(compressed(25, 4294967295U, stream), "should unpack to 4294967295");
    EXPECT_REFUSED(compressed(24, 24, stream), "do not unpack");
    EXPECT_REFUSED(compressed(0, 24, ""), "0 compressed bytes cannot unpack to 24");
    std::string broken = stream;
    broken[0] = '\xFF';
    EXPECT_REFUSED(compressed(25, 24, broken), "do not unpack");
    const std::string head = compressed(25, 24, stream);
    EXPECT_REFUSED(head.substr(0, head.size() - 26), "two lengths of the compressed points are missing");
    // What the length could unpack to at most is what memory is asked for.
    const std::string huge = "FIELDS x y z\nPOINTS 300000000\nDATA binary_compressed\n";
    std::string lengths(8, '\0');
    const std::uint32_t packed = 25, unpacked = 3'600'000'000U;
    std::memcpy(lengths.data(), &packed, 4);
    std::memcpy(lengths.data() + 4, &unpacked, 4);
    EXPECT_REFUSED(huge + lengths + stream, "25 compressed bytes cannot unpack to 3600000000");
}

TEST(Pcd, WritesACloudFromElsewhereAsANewFile) {
    PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0, 1, 2, 3});
    add_attribute(cloud, "red", std::vector<std::uint8_t>{1, 255});
    add_attribute(cloud, "green", std::vector<std::uint8_t>{2, 254});
    add_attribute(cloud, "blue", std::vector<std::uint8_t>{3, 253});
    for (const char* name : {"nx", "ny", "nz"}) add_attribute(cloud, name, std::vector<float>{1, 0});
    add_attribute(cloud, "two words", std::vector<float>{7, 8});
    cloud.attributes.push_back(
        {"pair", ScalarType::int16, std::vector<std::byte>(8, std::byte{1}), {0, 2, 4}});
    cloud.attributes.push_back(
        {"links", ScalarType::int16, std::vector<std::byte>(6, std::byte{1}), {0, 2, 3}});
    const std::vector<float> far{5, 6};
    std::vector<std::string> heard;
    const std::string bytes = written(cloud, {{}, {}, {{"far", far}}}, "out.pcd", &heard);
    EXPECT_NE(bytes.find("FIELDS x y z rgb normal_x normal_y normal_z two_words pair far\n"),
              std::string::npos);
    EXPECT_NE(bytes.find("TYPE F F F F F F F F I F\nCOUNT 1 1 1 1 1 1 1 1 2 1\nWIDTH 2\nHEIGHT 1\n"),
              std::string::npos);
    ASSERT_EQ(heard.size(), 2U) << joined(heard);
    EXPECT_NE(joined(heard).find("'two words' is called 'two_words'"), std::string::npos);
    EXPECT_NE(joined(heard).find("'links' are left out"), std::string::npos);
    const PointCloud back = read(bytes);
    EXPECT_EQ(back.positions, cloud.positions);
    for (const char* name : {"red", "green", "blue", "nx", "pair"})
        EXPECT_EQ(back.attributes[find_attribute(back, name).value()].values,
                  cloud.attributes[find_attribute(cloud, name).value()].values)
            << name;
    add_attribute(cloud, "alpha", std::vector<std::uint8_t>{9, 10});
    const std::string transparent = written(cloud, {}, "out.pcd");
    EXPECT_NE(transparent.find("FIELDS x y z rgba normal_x"), std::string::npos);
    EXPECT_EQ(value_at(read(transparent).attributes[6], 1), 10);
    EXPECT_EQ(read(written(make_cloud({}), {}, "out.pcd")).size(), 0U);
}

TEST(Pcd, TellsWhatOtherFormatsDoNotHold) {
    std::vector<std::string> heard;
    const PointCloud cloud = read(sample({PcdEncoding::binary, ScalarType::float64, true, false, "\n"}));
    const PointCloud back = read_bytes(written(cloud, {}, "out.ply", &heard));
    EXPECT_NE(joined(heard).find("the arrangement of the points as 3 × 2"), std::string::npos)
        << joined(heard);
    EXPECT_NE(joined(heard).find("the viewpoint"), std::string::npos);
    EXPECT_NE(joined(heard).find("time is of type uint64"), std::string::npos);
    EXPECT_EQ(back.positions, cloud.positions);
    EXPECT_TRUE(find_attribute(back, "red") && find_attribute(back, "nx"));
    EXPECT_EQ(back.attributes[find_attribute(back, "histogram").value()].first.size(), sample_points + 1);
}

TEST(Pcd, MovesACompressedScan) {
    KNEAD_SAMPLE_OR_SKIP(path, "odd/pcl_five_people.pcd");
    SilentProgress progress;
    const PointCloud cloud = read_cloud(path, progress);
    EXPECT_EQ(written(cloud, {cloud.positions, {}}, "out.pcd"), read_text(path));
    std::vector<float> posed = cloud.positions;
    for (std::size_t i = 0; i < 3000; ++i) posed[i] += 0.25F;
    const std::string saved = written(cloud, {posed, {}}, "out.pcd");
    EXPECT_LT(saved.size(), 5 * read_text(path).size() / 4) << "it is packed about as well";
    const PointCloud back = read(saved);
    for (std::size_t a = 3; a < cloud.attributes.size(); ++a)
        EXPECT_EQ(back.attributes[a].values, cloud.attributes[a].values);
    const auto finite = [](double value) { return std::isfinite(value); };
    for (std::size_t i = 0; i < cloud.size(); i += 97) {
        const Vec3d was = cloud.file_position(i), is = back.file_position(i);
        const double step = i < 1000 ? 0.25 : 0;
        if (finite(was[0]) && finite(was[1]) && finite(was[2])) {
            EXPECT_NEAR((is - was)[2], step, 1e-6) << i;
        }
    }
}

} // namespace
} // namespace knead::test
