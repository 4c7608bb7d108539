#pragma once
// Table 1 of the paper, measured again: how long it takes to set a cloud up, to factorise, to solve an
// iteration, and to move all points.

#include "base/progress.h"
#include "bench/data_files.h"
#include "bench/machine.h"
#include "bench/own_memory.h"
#include "bench/statistics.h"
#include "cloud/point_cloud.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

// One number for each of the paper's four columns; nothing where there is none.
struct FourFigures {
    std::optional<double> set_up;    // "subsampling": everything up to the influences
    std::optional<double> factorize; // "precomputation"
    std::optional<double> solve;     // an iteration
    std::optional<double> upsample;  // a frame
};

// A row of the table.
struct Table1Row {
    std::string_view model; // "dragon"
    std::string_view file;  // the scan's name; empty: the plane, which is made
    std::size_t samples = 0;
    FourFigures paper;  // seconds, on the paper's machine
    FourFigures floors; // how many times faster than the paper knead has to be
};
std::span<const Table1Row> table1_rows();

// "dragon/200".
std::string name_of(const Table1Row& row);

// The rows of these names, "dragon" for all of that model, in the order of the table; all rows for no names.
// Throws Error (usage) for a name that is none.
std::vector<Table1Row> rows_named(std::span<const std::string> names);

struct Table1Options {
    std::size_t repeats = 5; // ≥ 1, of the set-up, after one that warms up
    unsigned threads = 0;    // 0: one a core
    std::string device;      // as make_upsampler() takes it
    DataFolders scans;
};

// The same frame on the device and on the plain C++ reference, in turns, beside a copy of as many bytes.
struct UpsampleFigures {
    Summary device, reference, copy; // seconds
    double largest_difference = 0;   // between a coordinate of the two, in the cloud's units
    std::size_t bytes = 0;           // that a frame moves at least
    bool with_normals = false;
    std::optional<OwnMemoryFigures> own_memory = {}; // of a device that has its own, in that alone
};

// How fast the device moved these bytes beside how fast the processor copied as many: 1 for as fast.
double share_of_copy(const UpsampleFigures& figures);

// The same beside memory_copy_rate(), which no cache helps: what the bytes take if they come from memory.
double share_of_memory(const UpsampleFigures& figures, double copy_bytes_per_second);

// What one cloud and number of samples took; seconds.
struct RowFigures {
    std::size_t points = 0;
    std::size_t vertices = 0; // distinct positions
    std::size_t samples = 0;  // actual, the handles' included
    Summary order, neighbors, sampling, geodesic;
    Summary set_up; // the four together, and what frames read of them made ready
    Summary factorize;
    Summary solve;    // an iteration: local step, assembly, both solves
    Summary upsample; // a frame: the samples' motions made and all points moved
    UpsampleFigures upsampling;
    // Bytes that set-up and frames hold in the end, and held at most, beyond the file's own: the pipeline,
    // the handles, and the positions that are computed with; not the cloud's columns, nor the program and its
    // device, which are there already. 0 where that is not known.
    std::uint64_t memory_held = 0, memory_peak = 0;
};

// Sets the cloud up afresh `repeats` times, then bends it by 30° in as many frames with automatic_handles().
// The cloud has a finite point. `upsampler_warning` gets what the device had to say.
RowFigures measure_row(const PointCloud& cloud, std::size_t samples, const Table1Options& options,
                       Workers& workers, Progress& progress, std::vector<std::string>& warnings);

// A row and what became of it.
struct Table1Result {
    Table1Row row;
    std::string missing; // why it was not run; else empty
    RowFigures figures;
};

// How many times faster than the paper; nothing where the paper's figure is not known.
FourFigures factors_over_paper(const Table1Result& result);

struct Table1 {
    Machine machine;
    unsigned threads = 0;
    std::string device;
    std::size_t repeats = 0;
    double copy_bytes_per_second = 0; // memory_copy_rate()
    std::vector<Table1Result> results;
    std::vector<std::string> warnings;
};

// Measures the rows one after the other. A scan that is not there is reported in its row. Throws Error for a
// device that is not there and for a scan that cannot be read, and Cancelled.
Table1 measure_table1(std::span<const Table1Row> rows, const Table1Options& options, Progress& progress);

// The table for people, at most 130 columns wide, and one JSON object with every number.
std::string table1_text(const Table1& table);
std::string table1_json(const Table1& table);

} // namespace knead
