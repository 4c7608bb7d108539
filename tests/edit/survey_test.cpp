// The survey's shapes: handles on target, and as much the same with few samples as the project promises.

#include "edit/editing.h"
#include "edit/survey_shape.h"
#include "support/scans.h"

namespace knead {
namespace {

using namespace test;

struct Promise {
    const char* name;
    double at_1000, at_200; // RMS distance to every point a sample, % of D
};

class Survey : public testing::TestWithParam<Promise> {};

std::vector<float> settled(Desk& desk, const SurveyShape& shape) {
    desk.play(shape.handles + shape.drag + settle(300));
    return desk.shape();
}

double rms(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size() / 3; ++i) sum += (at(a, i) - at(b, i)).squaredNorm();
    return std::sqrt(sum / (static_cast<double>(a.size()) / 3));
}

TEST_P(Survey, FewSamplesGiveTheShapeOfAll) {
    const auto path = find_survey(std::string(GetParam().name) + ".off");
    if (!path) GTEST_SKIP() << "no " << GetParam().name << ".off in KNEAD_SURVEY or ../shared/survey";
    const SurveyShape shape = read_survey_shape(*path);
    Settings settings;
    settings.samples = std::nullopt;
    Desk all(shape.cloud, settings);
    const std::vector<float> expected = settled(all, shape);
    EXPECT_LT(all.handle_error(), 1e-5);
    for (const auto& [samples, bar] :
         {std::pair{1000U, GetParam().at_1000}, std::pair{200U, GetParam().at_200}}) {
        settings.samples = samples;
        Desk desk(shape.cloud, settings);
        const double percent = 100 * rms(settled(desk, shape), expected) / desk.diagonal();
        EXPECT_LE(percent, bar) << samples << " samples";
        EXPECT_LT(desk.handle_error(), 1e-5);
        RecordProperty("percent_at_" + std::to_string(samples), std::to_string(percent));
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Survey,
                         testing::Values(Promise{"bar", 0.34, 0.57}, Promise{"cactus", 0.66, 0.79},
                                         Promise{"cylinder", 0.74, 1.1}, Promise{"plane", 0.64, 0.87}),
                         [](const auto& promise) { return promise.param.name; });

} // namespace
} // namespace knead
