// Files met in the wild, of all formats: what is legal opens and comes back as it was, what is bad is refused
// in one line.

#include "base/error.h"
#include "io/through_files.h"
#include "support/scans.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

namespace knead::test {
namespace {

// Files that the index calls odd, and that knead refuses in these words: why.
const std::map<std::string, std::string> hopeless = {
    {"pdal_sized_dims.ply", "no property z"},                // a point needs one
    {"magnum_unsupported-face-size.ply", "is cut off"},      // it promises two faces and holds one
    {"assimp_box_UTF16BE.obj", "UTF-16"},                    // no OBJ program writes it
    {"assimp_number_formats.obj", "'3.1+e2' is no number"},  // some programs read 3.1 there, others 310
    {"pcl_stereo_left.pcd", "x, y"},                         // it has colours alone
    {"meshlab_chameleon4k.pts", "neither a row of numbers"}, // no table, but a binary file of PointShop3D
};

// Opens it and saves it unedited in its own format.
void expect_whole(const std::filesystem::path& file, const PointCloud& cloud) {
    std::vector<std::string> heard;
    EXPECT_EQ(written(cloud, {}, "out" + file.extension().string(), &heard), read_text(file));
    EXPECT_EQ(joined(heard), "");
    const std::vector<float> normals = read_normals(cloud);
    EXPECT_EQ(written(cloud, {cloud.positions, normals}, "out" + file.extension().string()), read_text(file));
}

TEST(WildFiles, open_if_odd_and_are_refused_if_bad) {
    KNEAD_SAMPLE_OR_SKIP(path, "odd/INDEX.tsv");
    const std::filesystem::path folder = path.parent_path();
    std::ifstream index(path);
    SilentProgress progress;
    std::size_t files = 0;
    for (std::string line; std::getline(index, line);) {
        std::istringstream words(line);
        std::string file, kind;
        words >> file >> kind;
        const std::filesystem::path opened = folder / file;
        if (kind == "kind" || (kind == "odd" && !has_cloud_extension(opened))) continue;
        SCOPED_TRACE(line);
        ++files;
        try {
            const PointCloud cloud = read_cloud(opened, progress);
            EXPECT_TRUE(kind == "odd" && !hopeless.contains(file));
            expect_whole(opened, cloud);
        } catch (const Error& error) {
            const auto why = hopeless.find(file);
            EXPECT_TRUE(kind == "bad" || why != hopeless.end()) << error.what();
            if (why != hopeless.end()) {
                EXPECT_NE(std::string(error.what()).find(why->second), std::string::npos) << error.what();
            }
            EXPECT_EQ(error.trouble(), Trouble::input);
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            EXPECT_NE(std::string(error.what()).find(file), std::string::npos);
        }
    }
    EXPECT_GT(files, 50U);
}

TEST(WildFiles, open_if_plain) {
    KNEAD_SAMPLE_OR_SKIP(path, "plain/test1_4.las");
    SilentProgress progress;
    for (const auto& entry : std::filesystem::directory_iterator(path.parent_path())) {
        if (!has_cloud_extension(entry.path())) continue;
        SCOPED_TRACE(entry.path().filename());
        const PointCloud cloud = read_cloud(entry.path(), progress);
        EXPECT_GE(cloud.size(), 100U);
        expect_whole(entry.path(), cloud);
    }
}

} // namespace
} // namespace knead::test
