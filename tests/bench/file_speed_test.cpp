#include "bench/file_speed.h"

#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using namespace knead;

TEST(FileSpeed, MeasuresEveryFormatAndLeavesNothing) {
    const test::ScratchFolder folder;
    Workers workers(2);
    SilentProgress progress;
    const FileSpeed speed = measure_files(folder.path(), 500, 2, workers, progress);
    std::vector<std::string> extensions;
    for (const FormatSpeed& format : speed.formats) {
        extensions.push_back(format.extension);
        EXPECT_GT(format.bytes, 500U * 12);
        for (const Summary& seconds : {format.read, format.load, format.copy, format.save}) {
            EXPECT_EQ(seconds.count, 2U);
            EXPECT_GT(seconds.lowest, 0);
        }
    }
    for (const char* known : {".ply", ".las", ".pcd", ".obj", ".off", ".xyz"})
        EXPECT_NE(std::ranges::find(extensions, known), extensions.end()) << known;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));

    const auto json = nlohmann::json::parse(file_speed_json(speed));
    ASSERT_EQ(json["formats"].size(), speed.formats.size());
    const auto& ply = json["formats"][0];
    EXPECT_DOUBLE_EQ(ply["load"]["megabytes_per_second"].get<double>() *
                         ply["load"]["seconds"]["median"].get<double>(),
                     1e-6 * ply["bytes"].get<double>());
    const std::string text = file_speed_text(speed);
    for (const std::string& extension : extensions) EXPECT_NE(text.find(extension), std::string::npos);
}

} // namespace
