#include "base/error.h"
#include "io/ply.h"
#include "io/ply_samples.h"

#include <gtest/gtest.h>

#include <cstring>

#include <algorithm>
#include <cmath>
#include <limits>

namespace knead::test {
namespace {

// Says stop after some reports.
class Impatient final : public Progress {
public:
    explicit Impatient(int patience) : patience_(patience) {}
    void report(std::string_view /*stage*/, double /*fraction*/) override { --patience_; }
    bool cancelled() const override { return patience_ < 0; }

private:
    int patience_;
};

TEST(PlyWriter, leaves_every_byte_of_an_unmoved_cloud) {
    for (const SampleKind& kind : all_sample_kinds()) {
        const std::string bytes = sample(kind);
        const PointCloud cloud = read_bytes(bytes);
        EXPECT_EQ(written(cloud, {}), bytes) << name_of(kind);
        EXPECT_EQ(written(cloud, {cloud.positions, read_normals(cloud)}), bytes) << name_of(kind);
    }
}

TEST(PlyWriter, changes_the_coordinates_of_moved_points_only) {
    for (const SampleKind& kind : all_sample_kinds()) {
        SCOPED_TRACE(name_of(kind));
        const PointCloud cloud = read_bytes(sample(kind));
        std::vector<float> posed = cloud.positions;
        posed[3 * 2] += 4;     // x of point 2: 12 → 16
        posed[3 * 4 + 2] -= 7; // z of point 4: 30 → 23
        const std::string saved = written(cloud, {posed, {}});
        const PointCloud again = read_bytes(saved);
        EXPECT_EQ(again.file_position(2), Vec3d(16, 18, 30));
        EXPECT_EQ(again.file_position(4), Vec3d(14, 16, 23));
        // Moved back, the file is what it was: all other bytes have kept their values and places.
        std::vector<float> back = again.positions;
        back[3 * 2] -= 4;
        back[3 * 4 + 2] += 7;
        EXPECT_EQ(written(again, {back, {}}), sample(kind));
        EXPECT_EQ(saved.size(), sample(kind).size());
        std::size_t changed = 0;
        for (std::size_t i = 0; i < saved.size(); ++i) changed += saved[i] != sample(kind)[i] ? 1U : 0U;
        EXPECT_LE(changed,
                  std::max<std::size_t>(3, 2 * size_of(kind.coordinates))); // a text changes 3 digits
        EXPECT_GE(changed, 2U);
    }
}

TEST(PlyWriter, keeps_the_text_of_numbers_that_did_not_change) {
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty double y\n"
        "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
        "property uchar red\nend_header\n";
    const PointCloud cloud =
        read_bytes(header + " 1.500\t2.0e0  +3. 0 0 1.000 007\n4.0 5.0 6.0 1.0 0 0 1\n\n");
    std::vector<float> posed = cloud.positions;
    posed[0] += 0.25F;
    posed[4] += 0.125F;
    const std::vector<float> normals{0, 0, 1, 0, 1, 0};
    EXPECT_EQ(written(cloud, {posed, normals}),
              header + " 1.75\t2.0e0  +3. 0 0 1.000 007\n4.0 5.125 6.0 0 1 0 1\n\n");
}

TEST(PlyWriter, adds_the_displacement_to_the_files_own_value_in_double) {
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
        "property double z\nend_header\n";
    const PointCloud cloud = read_bytes(header + "5403123.123456789 0 0\n5403124.987654321 1 1\n");
    std::vector<float> posed = cloud.positions;
    const double rest = posed[0];
    posed[0] += 0.5F;
    const double value = 5403123.123456789 + (static_cast<double>(posed[0]) - rest);
    const PointCloud saved = read_bytes(written(cloud, {posed, {}}));
    EXPECT_EQ(saved.file_position(0)[0], value);
    EXPECT_EQ(saved.file_position(1)[0], 5403124.987654321);
}

TEST(PlyWriter, rounds_whole_numbers_and_refuses_those_that_do_not_fit) {
    const PointCloud cloud = read_bytes(sample({PlyEncoding::ascii, ScalarType::int8, false, false, "\n"}));
    std::vector<float> posed = cloud.positions;
    posed[0] += 0.4F; // 10.4 → 10, which is what the file has
    posed[1] -= 0.6F; // 19.4 → 19
    const PointCloud saved = read_bytes(written(cloud, {posed, {}}));
    EXPECT_EQ(saved.file_position(0), Vec3d(10, 19, 30));
    posed[3] += 200;
    const std::string words = refusal_to_write(cloud, {posed, {}});
    EXPECT_NE(words.find("point 1 moves to x = 211"), std::string::npos) << words;
    EXPECT_NE(words.find("int8"), std::string::npos) << words;
}

TEST(PlyWriter, knows_the_largest_whole_number_of_each_type) {
    for (const auto& [type, beyond] :
         {std::pair("char", 128), {"uchar", 256}, {"short", 32768}, {"ushort", 65536}}) {
        const PointCloud cloud =
            read_bytes(std::string("ply\nformat ascii 1.0\nelement vertex 1\nproperty ") + type +
                       " x\nproperty float y\nproperty float z\nend_header\n0 0 0\n");
        std::vector<float> posed = cloud.positions;
        posed[0] += static_cast<float>(beyond - 1);
        EXPECT_EQ(read_bytes(written(cloud, {posed, {}})).file_position(0).x(), beyond - 1) << type;
        posed[0] += 1;
        EXPECT_NE(refusal_to_write(cloud, {posed, {}}), "") << type;
    }
}

std::string with_normals(const std::string& type, const std::string& normals) {
    return "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
           "property " +
           type + " nx\nproperty " + type + " ny\nproperty " + type + " nz\nend_header\n0 0 0 " + normals +
           "\n1 0 0 0 0 127\n";
}

TEST(PlyWriter, turns_normals_of_whole_numbers_with_a_sign) {
    for (const char* type : {"char", "short", "int"}) {
        const PointCloud cloud = read_bytes(with_normals(type, "0 -128 0"));
        EXPECT_TRUE(cloud.remarks.empty()) << joined(cloud.remarks);
        const std::vector<float> turned{127.6F, 0.4F, 0, 0, 0, 127};
        const std::string expected = std::string(type) == "char" ? "127 0 0" : "128 0 0";
        EXPECT_EQ(written(cloud, {cloud.positions, turned}), with_normals(type, expected)) << type;
        EXPECT_EQ(written(cloud, {cloud.positions, read_normals(cloud)}), with_normals(type, "0 -128 0"));
    }
    const PointCloud cloud = read_bytes(with_normals("uchar", "0 128 0"));
    ASSERT_EQ(cloud.remarks.size(), 1U);
    EXPECT_NE(cloud.remarks[0].find("do not turn"), std::string::npos) << cloud.remarks[0];
}

TEST(PlyWriter, refuses_a_pose_that_is_not_finite) {
    const PointCloud cloud = read_bytes(sample({}));
    std::vector<float> posed = cloud.positions;
    posed[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(refusal_to_write(cloud, {posed, {}}), "");
    posed[3] = std::numeric_limits<float>::infinity();
    EXPECT_NE(refusal_to_write(cloud, {posed, {}}), "");
}

TEST(PlyWriter, keeps_points_that_are_not_finite) {
    const std::string bytes = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                              "property float z\nend_header\nNaN 1 2\n3 4 -Inf\n";
    const PointCloud cloud = read_bytes(bytes);
    EXPECT_EQ(written(cloud, {cloud.positions, {}}), bytes);
}

TEST(PlyWriter, writes_a_cloud_without_a_file_as_a_new_one) {
    const std::vector<float> positions{0, 0, 0, 1, 2, 3, 4, 5, 7};
    PointCloud cloud = make_cloud(positions);
    add_attribute(cloud, "red", std::vector<std::uint8_t>{1, 2, 255});
    add_attribute(cloud, "nx", std::vector<float>{1, 0, 0});
    add_attribute(cloud, "ny", std::vector<float>{0, 1, 0});
    add_attribute(cloud, "nz", std::vector<float>{0, 0, 1});
    Attribute list{"links", ScalarType::uint16, {}, {0, 2, 2, 3}, ScalarType::uint8};
    list.values.resize(6, std::byte{9});
    cloud.attributes.push_back(list);

    const PointCloud same = read_bytes(written(cloud, {}));
    ASSERT_EQ(same.attributes.size(), cloud.attributes.size());
    EXPECT_EQ(file_kind(same).encoding, "binary_little_endian");
    EXPECT_EQ(same.positions, cloud.positions);
    for (std::size_t a = 0; a < cloud.attributes.size(); ++a) {
        EXPECT_EQ(same.attributes[a].name, cloud.attributes[a].name);
        EXPECT_EQ(same.attributes[a].type, cloud.attributes[a].type);
        EXPECT_EQ(same.attributes[a].values, cloud.attributes[a].values);
        EXPECT_EQ(same.attributes[a].first, cloud.attributes[a].first);
    }

    std::vector<float> posed = cloud.positions;
    posed[8] += 1;
    const std::vector<float> normals{0, 1, 0, 0, 1, 0, 0, 0, 1};
    const PointCloud moved = read_bytes(written(cloud, {posed, normals}));
    EXPECT_EQ(moved.file_position(2), Vec3d(4, 5, 8));
    EXPECT_EQ(read_normals(moved), normals);
}

TEST(PlyWriter, adds_columns_behind_those_of_every_kind_of_file) {
    const std::vector<float> far{0, 0.5F, 1, -2, 1e-20F};
    const std::vector<float> red{5, 4, 3, 2, 1}; // a name that is taken
    for (const SampleKind& kind : all_sample_kinds()) {
        SCOPED_TRACE(name_of(kind));
        const PointCloud cloud = read_bytes(sample(kind));
        const PosedShape shape{{}, {}, {{"far", far}, {"red", red}}};
        const PointCloud back = read_bytes(written(cloud, shape));
        ASSERT_EQ(back.attributes.size(), cloud.attributes.size() + 2);
        EXPECT_EQ(back.positions, cloud.positions);
        for (std::size_t a = 0; a < cloud.attributes.size(); ++a) {
            EXPECT_EQ(back.attributes[a].name, cloud.attributes[a].name);
            EXPECT_EQ(back.attributes[a].values, cloud.attributes[a].values);
        }
        const Attribute& added = back.attributes[cloud.attributes.size()];
        EXPECT_EQ(added.name, "far");
        EXPECT_EQ(added.type, ScalarType::float32);
        EXPECT_EQ(std::memcmp(added.values.data(), far.data(), 4 * far.size()), 0);
        EXPECT_EQ(back.attributes.back().name, "red_2");
        EXPECT_EQ(std::memcmp(back.attributes.back().values.data(), red.data(), 4 * red.size()), 0);
    }
}

TEST(PlyWriter, adds_columns_to_a_cloud_without_a_file) {
    const std::vector<float> positions{0, 0, 0, 1, 2, 3};
    const std::vector<float> far{7, 8};
    const PointCloud back = read_bytes(written(make_cloud(positions), {{}, {}, {{"far", far}}}));
    ASSERT_EQ(back.attributes.size(), 4U);
    EXPECT_EQ(std::memcmp(back.attributes[3].values.data(), far.data(), 8), 0);
}

TEST(PlyWriter, writes_a_cloud_of_no_points) {
    EXPECT_EQ(read_bytes(written(make_cloud({}), {})).size(), 0U);
}

TEST(PlyWriter, refuses_a_list_too_long_for_its_length) {
    PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0});
    Attribute list{"links", ScalarType::uint8, std::vector<std::byte>(300), {0, 300}, ScalarType::uint8};
    cloud.attributes.push_back(list);
    EXPECT_NE(refusal_to_write(cloud, {}).find("300 values"), std::string::npos);
}

TEST(PlyWriter, refuses_names_of_other_formats) {
    const ScratchFolder folder;
    SilentProgress progress;
    const PointCloud cloud = make_cloud(std::vector<float>{1, 2, 3});
    for (const char* name : {"out.stl", "out", "ply", "out.ply.gz"}) try {
            write_cloud(folder / name, cloud, {}, progress);
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.trouble(), Trouble::output);
            EXPECT_NE(std::string(error.what()).find("knead writes .ply"), std::string::npos);
        }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    write_cloud(folder / "OUT.PLY", cloud, {}, progress);
    EXPECT_TRUE(std::filesystem::exists(folder / "OUT.PLY"));
}

TEST(PlyWriter, leaves_the_old_file_when_it_cannot_write_or_must_stop) {
    const ScratchFolder folder;
    SilentProgress progress;
    write_text(folder / "old.ply", "old");
    // Larger than a block, so that there is a moment between blocks.
    const PointCloud cloud = make_cloud(std::vector<float>(3 * 1000000, 1.0F));
    for (int patience = 0; patience < 4; ++patience) {
        Impatient impatient(patience);
        EXPECT_THROW(write_cloud(folder / "old.ply", cloud, {}, impatient), Cancelled) << patience;
    }
    EXPECT_THROW(write_cloud(folder / "missing" / "new.ply", cloud, {}, progress), Error);
    const PointCloud bytes = read_bytes(sample({PlyEncoding::ascii, ScalarType::uint8, false, false, "\n"}));
    std::vector<float> far = bytes.positions;
    far[0] -= 1000;
    EXPECT_THROW(write_cloud(folder / "old.ply", bytes, {far, {}}, progress), Error);
    EXPECT_EQ(read_text(folder / "old.ply"), "old");
    const std::filesystem::directory_iterator entries(folder.path());
    EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

TEST(PlyWriter, may_replace_the_file_that_the_cloud_came_from) {
    const ScratchFolder folder;
    SilentProgress progress;
    const SampleKind kind{PlyEncoding::binary_big_endian, ScalarType::float32, true, true, "\n"};
    write_text(folder / "cloud.ply", sample(kind));
    const PointCloud cloud = read_cloud(folder / "cloud.ply", progress);
    std::vector<float> posed = cloud.positions;
    posed[0] += 1;
    write_cloud(folder / "cloud.ply", cloud, {posed, {}}, progress);
    EXPECT_EQ(read_cloud(folder / "cloud.ply", progress).file_position(0), Vec3d(11, 20, 30));
}

} // namespace
} // namespace knead::test
