#include "bench/statistics.h"

#include <algorithm>

namespace knead {

Summary summarize(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    const bool odd = values.size() % 2 == 1;
    const double median = odd ? values[half] : (values[half - 1] + values[half]) / 2;
    return {median, values.front(), values.back(), values.size()};
}

double ratio(const Summary& a, const Summary& b) {
    return b.median > 0 ? a.median / b.median : 0;
}

} // namespace knead
