#include "support/run_knead.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <optional>
#include <set>
#include <string>

namespace {

using knead::test::Outcome;
using knead::test::run_knead;
using nlohmann::json;

TEST(Devices, ShowsTheReferenceAndOneDefault) {
    const Outcome outcome = run_knead({"devices"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("reference"), std::string::npos);
    const std::size_t first = outcome.out.find("(default)");
    ASSERT_NE(first, std::string::npos);
    EXPECT_EQ(outcome.out.find("(default)", first + 1), std::string::npos);
}

TEST(Devices, NumbersTheDevicesInJson) {
    const Outcome outcome = run_knead({"devices", "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json told = json::parse(outcome.out);
    const std::set<std::string> types = {"cpu", "gpu", "accelerator"};
    std::string chosen = "reference";
    std::size_t next = 0;
    for (const json& device : told.at("devices")) {
        EXPECT_EQ(device.at("index").get<std::size_t>(), next++);
        EXPECT_FALSE(device.at("name").get<std::string>().empty());
        EXPECT_FALSE(device.at("platform").get<std::string>().empty());
        EXPECT_EQ(types.count(device.at("type").get<std::string>()), 1U);
        EXPECT_GT(device.at("compute_units").get<unsigned>(), 0U);
        EXPECT_GT(device.at("memory_bytes").get<std::uint64_t>(), 0U);
        if (device.at("default").get<bool>()) chosen = device.at("name").get<std::string>();
    }
    EXPECT_EQ(told.at("default").get<std::string>(), chosen);
}

// The loader reads its list of drivers from the folder that this variable names; an empty one has none.
class HiddenDevices : public ::testing::Test {
protected:
    HiddenDevices() {
        if (const char* const before = std::getenv(variable)) before_ = before;
        ::setenv(variable, "/nonexistent/", 1);
    }
    ~HiddenDevices() override {
        if (before_)
            ::setenv(variable, before_->c_str(), 1);
        else
            ::unsetenv(variable);
    }

private:
    static constexpr const char* variable = "OCL_ICD_VENDORS";
    std::optional<std::string> before_;
};

TEST_F(HiddenDevices, AreNoError) {
    const Outcome outcome = run_knead({"devices"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.out.find("reference"), std::string::npos);
    EXPECT_NE(outcome.out.find("(default)"), std::string::npos);
    EXPECT_NE(outcome.err.find("pocl-opencl-icd"), std::string::npos) << outcome.err;
}

TEST_F(HiddenDevices, AreAnEmptyListInJson) {
    const Outcome outcome = run_knead({"devices", "--json"});
    ASSERT_EQ(outcome.code, 0);
    const json told = json::parse(outcome.out);
    EXPECT_TRUE(told.at("devices").empty());
    EXPECT_EQ(told.at("default").get<std::string>(), "reference");
}

} // namespace
