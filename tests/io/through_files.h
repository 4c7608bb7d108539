#pragma once
// Clouds from and to bytes, by way of files in a scratch folder: what the tests of all formats share.

#include "base/progress.h"
#include "io/cloud_file.h"
#include "support/scratch_folder.h"

#include <string>
#include <string_view>
#include <vector>

namespace knead::test {

// The cloud in these bytes, in a file of this name.
PointCloud read_bytes(std::string_view bytes, Progress& progress, const std::string& name = "cloud.ply");
PointCloud read_bytes(std::string_view bytes, const std::string& name = "cloud.ply");

// What write_cloud() makes of it, in a file of this name; `heard` becomes what it says.
std::string written(const PointCloud& cloud, const PosedShape& shape, const std::string& name = "out.ply",
                    std::vector<std::string>* heard = nullptr);

// The words of the Error that reading these bytes throws, from the file's name on, "" where it throws none.
std::string refusal(std::string_view bytes, const std::string& name = "cloud.ply");

// Whether a reader takes these bytes; it may refuse them with words, and nothing else. Quick, since there is
// no file.
using Reader = PointCloud (*)(std::vector<std::byte> bytes, const std::string& shown, Progress& progress);
bool is_taken(std::string_view bytes, Reader read);

// The words of the Error (output) that writing throws, "" where it throws none.
std::string refusal_to_write(const PointCloud& cloud, const PosedShape& shape,
                             const std::string& name = "out.ply");

// All the sentences, one a line.
std::string joined(const std::vector<std::string>& sentences);

} // namespace knead::test
