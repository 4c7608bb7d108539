#pragma once
// How the stages, and the memory that they take, grow with the number of points and of samples: on the plane,
// with a colour at every point and no normals.

#include "bench/table1.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace knead {

struct Growth {
    Machine machine;
    unsigned threads = 0;
    std::string device;
    double copy_bytes_per_second = 0;   // memory_copy_rate()
    std::vector<RowFigures> by_points;  // with 1000 samples
    std::vector<RowFigures> by_samples; // on a million points, or as many as are asked for
    std::vector<std::string> warnings;
};

// Measures 10,000, 30,000, 100,000 … points up to `most_points` (≥ 10,000), and 100, 300, 1000 … samples up
// to 100,000 or a tenth of the points; each as a row of Table 1 (measure_row()), `options.repeats` times.
Growth measure_growth(std::size_t most_points, const Table1Options& options, Progress& progress);

// A stage of the set-up or of a frame.
struct Stage {
    const char* name;
    Summary RowFigures::*seconds;
};
std::span<const Stage> growth_stages();

// The exponent e of the law seconds ~ size^e that fits best: the slope of the straight line through the
// logarithms, by least squares. `size`: RowFigures::points or ::samples. Nothing for fewer than two different
// sizes.
std::optional<double> fitted_exponent(std::span<const RowFigures> rows, std::size_t RowFigures::*size,
                                      const Stage& stage);

// A table for people, at most 130 columns wide; one JSON object with every number; and a picture (SVG) of all
// stages, both axes logarithmic.
std::string growth_text(const Growth& growth);
std::string growth_json(const Growth& growth);
std::string growth_picture(const Growth& growth);

} // namespace knead
