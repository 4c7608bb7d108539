// What holds for clouds of every format: how a file is known, and what its reader says of it.

#include "io/cloud_file.h"
#include "io/through_files.h"

#include <gtest/gtest.h>

#include <string>

namespace knead::test {
namespace {

// An ascii PLY of one point with three more columns of a type.
std::string with_normals(const std::string& names, const std::string& type) {
    std::string bytes = "ply\nformat ascii 1.0\nelement vertex 1\n";
    for (const char* const axis : {"x", "y", "z"}) bytes += "property float " + std::string(axis) + "\n";
    for (const char axis : {'x', 'y', 'z'}) {
        std::string name = names;
        name.replace(name.find('?'), 1, 1, axis);
        bytes += "property " + type + " " + name + "\n";
    }
    return bytes + "end_header\n1 2 3 0 0 1\n";
}

TEST(CloudFile, SaysWhichNormalsStay) {
    for (const std::string names : {"n?", "normal_?"}) {
        for (const char* const type : {"char", "short", "int", "float", "double"})
            EXPECT_TRUE(read_bytes(with_normals(names, type)).remarks.empty()) << names << " of " << type;
        for (const char* const type : {"uchar", "ushort", "uint"}) {
            const PointCloud cloud = read_bytes(with_normals(names, type));
            ASSERT_EQ(cloud.remarks.size(), 1U) << names << " of " << type;
            std::string last = names;
            last.replace(last.find('?'), 1, "z");
            EXPECT_NE(cloud.remarks[0].find("and " + last + " are neither floats"), std::string::npos)
                << cloud.remarks[0];
        }
    }
}

TEST(CloudFile, ATableIsKnownUnderAnyNameHoweverLongItsFirstLineIs) {
    std::string bytes = "x y z";
    for (int i = 0; i < 400; ++i) bytes += " another_column_" + std::to_string(i);
    bytes += "\n1 2 3";
    for (int i = 0; i < 400; ++i) bytes += " 7";
    EXPECT_EQ(read_bytes(bytes + "\n", "cloud.dat").attributes.size(), 403U);
}

} // namespace
} // namespace knead::test
