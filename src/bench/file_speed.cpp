#include "bench/file_speed.h"

#include "base/counts.h"
#include "base/stopwatch.h"
#include "base/temporary_folder.h"
#include "base/whole_file.h"
#include "bench/made_cloud.h"
#include "bench/report.h"
#include "edit/json_text.h"
#include "io/cloud_file.h"
#include "io/format.h"

namespace knead {

namespace {

namespace fs = std::filesystem;

template<typename Work>
double seconds_of(Work&& work) {
    const Stopwatch clock;
    work();
    return clock.seconds();
}

// Every point somewhere else, as after any edit.
std::vector<float> moved(const PointCloud& cloud) {
    std::vector<float> positions = cloud.positions;
    const double step = 1e-3 * bounds_of(cloud).diagonal();
    for (std::size_t i = 0; i < positions.size(); ++i)
        positions[i] += static_cast<float>(step * static_cast<double>(i % 7 + 1));
    return positions;
}

FormatSpeed measure_format(const fs::path& file, std::size_t repeats, Progress& progress) {
    FormatSpeed speed{file.extension().string(), fs::file_size(file), {}, {}, {}, {}};
    const PointCloud cloud = read_cloud(file, progress);
    const std::vector<float> positions = moved(cloud);
    const fs::path target = file.parent_path() / ("saved" + speed.extension);
    const fs::path copy = file.parent_path() / "copy";
    std::vector<double> read, load, copied, save;
    for (std::size_t round = 0; round <= repeats; ++round) {
        std::vector<std::byte> bytes;
        const double reading = seconds_of([&] { bytes = read_whole_file(file, progress); });
        const double copying = seconds_of([&] {
            FileInTheMaking made(copy);
            made.write(bytes);
            made.commit();
        });
        const double loading = seconds_of([&] { read_cloud(file, progress); });
        const double saving = seconds_of([&] { write_cloud(target, cloud, {positions, {}}, progress); });
        if (round == 0) continue;
        read.push_back(reading), load.push_back(loading), copied.push_back(copying), save.push_back(saving);
    }
    fs::remove(copy);
    fs::remove(target);
    speed.read = summarize(read), speed.load = summarize(load);
    speed.copy = summarize(copied), speed.save = summarize(save);
    return speed;
}

double megabytes_per_second(std::size_t bytes, const Summary& seconds) {
    return seconds.median > 0 ? 1e-6 * static_cast<double>(bytes) / seconds.median : 0;
}

ReportJson json_of(std::size_t bytes, const Summary& seconds) {
    return {{"seconds", json_of(seconds)}, {"megabytes_per_second", megabytes_per_second(bytes, seconds)}};
}

} // namespace

FileSpeed measure_files(const fs::path& folder, std::size_t points, std::size_t repeats, Workers& workers,
                        Progress& progress) {
    FileSpeed result{this_machine(), points, repeats, {}};
    const TemporaryFolder scratch(folder);
    const PointCloud cloud = made_cloud(Shape::creature, points, workers, progress);
    for (const Format& format : known_formats()) {
        const fs::path file = scratch.path() / ("cloud" + std::string(format.extensions.front()));
        write_cloud(file, cloud, {}, progress);
        result.formats.push_back(measure_format(file, repeats, progress));
        fs::remove(file);
    }
    return result;
}

std::string file_speed_text(const FileSpeed& speed) {
    TextTable table;
    table.push_back({"", "MB", "read", "load", "MB/s", "load : read", "copy", "save", "MB/s", "save : copy"});
    for (const FormatSpeed& format : speed.formats) {
        const auto rate = [&](const Summary& seconds) {
            return digits_text(megabytes_per_second(format.bytes, seconds), 0);
        };
        table.push_back({format.extension, digits_text(1e-6 * static_cast<double>(format.bytes), 1),
                         duration_text(format.read.median), duration_text(format.load.median),
                         rate(format.load), digits_text(ratio(format.load, format.read), 1),
                         duration_text(format.copy.median), duration_text(format.save.median),
                         rate(format.save), digits_text(ratio(format.save, format.copy), 1)});
        table.push_back({"  min…max", "", spread_text(format.read), spread_text(format.load), "", "",
                         spread_text(format.copy), spread_text(format.save), "", ""});
    }
    return "Loading and saving " + grouped(speed.points) + " points with normals and colours, medians of " +
           std::to_string(speed.repeats) +
           ".\nread: the file's bytes into memory, from the system's cache. copy: the same bytes written, "
           "synced and "
           "renamed.\nsave: every point moved, the file patched, synced and renamed.\n" +
           machine_text(speed.machine) + "\n" + format_table(table);
}

std::string file_speed_json(const FileSpeed& speed) {
    ReportJson json = machine_json(speed.machine);
    json["points"] = speed.points;
    json["repeats"] = speed.repeats;
    for (const FormatSpeed& format : speed.formats)
        json["formats"].push_back({{"extension", format.extension},
                                   {"bytes", format.bytes},
                                   {"read", json_of(format.bytes, format.read)},
                                   {"load", json_of(format.bytes, format.load)},
                                   {"load_over_read", ratio(format.load, format.read)},
                                   {"copy", json_of(format.bytes, format.copy)},
                                   {"save", json_of(format.bytes, format.save)},
                                   {"save_over_copy", ratio(format.save, format.copy)}});
    return json_text(json);
}

} // namespace knead
