#pragma once
// One page of pictures beside the numbers of the evaluation: the survey's shapes with few and with all
// samples, a strip of elasticities, and the figures of the paper on scans and on clouds that knead makes.
// What is missing is said on the page.

#include "base/progress.h"
#include "bench/data_files.h"

#include <filesystem>
#include <string>

namespace knead {

struct PageOptions {
    std::filesystem::path folder; // made if it is not there
    DataFolders scans, survey;
    std::string device;   // as make_upsampler() takes it
    unsigned threads = 0; // 0: one a core
};

// Throws Error where write_evaluation_page() could draw nothing (usage) or put nothing into the folder
// (output), so that one who computes for long can ask beforehand.
void refuse_bad_page(const std::filesystem::path& folder);

// Writes index.html, its pictures, and beside them the session of each picture with the cloud it works on
// (scans stay where they are), so that `knead replay` in that folder shows it again. Everything is put there
// at the end or not at all. Throws Error (usage) for a knead that draws no pictures and a device that is not
// there, (input) for a scan that cannot be read, (output), and Cancelled.
void write_evaluation_page(const PageOptions& options, Progress& progress);

} // namespace knead
