#pragma once
// A density along a line and its running total, both ways: the means to spread points by mass.

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace knead {

// The integral of a weight over low … high, as a table between whose entries the weight counts as constant.
struct Profile {
    double low = 0;
    double high = 1;
    std::vector<double> total; // at equal steps, from 0 to the whole integral

    double whole() const { return total.back(); }
};

// `weight` ≥ 0 is taken at the middle of each of 4096 steps.
Profile make_profile(double low, double high, const std::function<double(double)>& weight);

// Where the integral reaches `fraction` (0 … 1) of the whole.
double place_of(const Profile& profile, double fraction);

// Cuts `points` into consecutive rows: entry r is the first point of row r, the last entry is `points`. A row
// around the fraction m (0 … 1) of the points gets about points_across(m) of them; all rows come out evenly
// full, with no remainder in the last. A row may be empty where fewer than one point is asked for.
std::vector<std::size_t> cut_into_rows(std::size_t points,
                                       const std::function<double(double)>& points_across);

// The density at `fraction` (0 … 1) of the way from the sparse end to the dense end, over the sparsest.
inline double gradient_density(double gradient, double fraction) {
    return std::pow(gradient, fraction);
}

} // namespace knead
