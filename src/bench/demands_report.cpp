#include "base/counts.h"
#include "bench/demands.h"
#include "bench/report.h"

namespace knead {

namespace {

bool holds(const DemandResult& result) {
    const bool is_even = !result.uneven || *result.uneven <= evenness_bar;
    return is_even && result.words.empty() == !result.too_much;
}

} // namespace

std::string demands_text(std::span<const DemandResult> results) {
    TextTable table{
        {"Handles that ask for the impossible, 1000 samples: links' length over that at rest, 1 % "
         "beyond; aim: even within " +
         digits_text(100 * evenness_bar, 0) + " %, and said"},
        {"pose", "points", "longest", "shortest", "torn", "uneven %", "handles off / D", "said", ""}};
    for (const DemandResult& result : results)
        table.push_back({result.name, grouped(result.points), digits_text(result.demand.strain.longest, 2),
                         digits_text(result.demand.strain.shortest, 2), digits_text(result.demand.parted, 1),
                         result.uneven ? digits_text(100 * *result.uneven, 1) : unknown_text,
                         power_text(result.handle_error), result.words.empty() ? "nothing" : "yes",
                         verdict_text(holds(result))});
    return format_table(table);
}

ReportJson demands_json(std::span<const DemandResult> results) {
    ReportJson json = ReportJson::array();
    for (const DemandResult& result : results)
        json.push_back({{"pose", result.name},
                        {"points", result.points},
                        {"longest", result.demand.strain.longest},
                        {"shortest", result.demand.strain.shortest},
                        {"torn", result.demand.parted},
                        {"uneven", result.uneven ? ReportJson(*result.uneven) : ReportJson()},
                        {"bar", result.uneven ? ReportJson(evenness_bar) : ReportJson()},
                        {"handle_error", result.handle_error},
                        {"too_much", result.too_much},
                        {"said", result.words},
                        {"holds", holds(result)}});
    return json;
}

} // namespace knead
