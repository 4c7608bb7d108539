// Files of all formats through the program: exit codes, warnings, conversion by --out.

#include "support/run_knead.h"
#include "support/scans.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace knead::test {
namespace {

using nlohmann::json;

const std::string ends =
    R"({"op":"handle","name":"foot","role":"fixed","region":{"halfspace":{"point":[0,0,-2],"normal":[0,0,-1]}}})"
    "\n"
    R"({"op":"handle","name":"top","role":"moving","region":{"halfspace":{"point":[0,0,2],"normal":[0,0,1]}}})"
    "\n";
const std::string lift = R"({"op":"drag","handle":"top","pivot":[0,0,2],"frames":[{"translate":[1,0,0.5]}]})"
                         "\n";

class Formats : public testing::Test {
protected:
    Outcome run(const std::vector<std::string>& arguments) { return run_knead(arguments, folder.path()); }

    void session(const std::string& file, const std::string& lines) {
        write_text(folder / "s.knead", R"({"knead":1,"cloud":{"path":")" + file + "\"}}\n" + lines);
    }

    ScratchFolder folder;
};

TEST_F(Formats, AnUneditedCloudComesBackAsTheIdenticalFile) {
    for (const char* extension :
         {".ply", ".las", ".pcd", ".xyz", ".txt", ".asc", ".csv", ".pts", ".obj", ".off"}) {
        const std::string file = std::string("bar") + extension;
        ASSERT_EQ(run({"make", "bar", "--points", "600", "--out", file}).code, 0);
        session(file, ends);
        const Outcome outcome = run({"replay", "s.knead", "--out", "out" + std::string(extension), "--json",
                                     "--device", "reference"});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(json::parse(outcome.out)["warnings"], json::array());
        EXPECT_EQ(read_text(folder / ("out" + std::string(extension))), read_text(folder / file));
    }
}

TEST_F(Formats, OutConvertsByItsExtensionAndWarnsOfWhatIsLost) {
    ASSERT_EQ(run({"make", "bar", "--points", "600", "--out", "bar.ply"}).code, 0);
    session("bar.ply", ends + lift);
    ASSERT_EQ(run({"replay", "s.knead", "--out", "bent.ply", "--device", "reference"}).code, 0);
    const Outcome outcome =
        run({"replay", "s.knead", "--out", "bent.las", "--json", "--device", "reference"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json warnings = json::parse(outcome.out)["warnings"];
    ASSERT_EQ(warnings.size(), 1U) << warnings;
    EXPECT_NE(warnings[0].get<std::string>().find("bent.las: LAS keeps coordinates as whole numbers"),
              std::string::npos);
    EXPECT_NE(outcome.err.find("warning: bent.las: LAS keeps"), std::string::npos);
    const Outcome difference = run({"diff", "bent.ply", "bent.las", "--json"});
    ASSERT_EQ(difference.code, 0) << difference.err;
    EXPECT_LT(json::parse(difference.out)["largest"], 1e-8);
    const Outcome info = run({"info", "bent.las", "--json"});
    ASSERT_EQ(info.code, 0) << info.err;
    EXPECT_EQ(json::parse(info.out)["format"], "las");
}

TEST_F(Formats, TargetsOfNoKnownFormatAreRefusedBeforeTheWork) {
    ASSERT_EQ(run({"make", "bar", "--points", "600", "--out", "bar.ply"}).code, 0);
    session("bar.ply", ends + lift);
    for (const char* target : {"bent.stl", "bent.laz", "bent"}) {
        const Outcome outcome = run({"replay", "s.knead", "--out", target});
        EXPECT_EQ(outcome.code, 5) << target;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find("knead writes .ply"), std::string::npos) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(folder / target));
    }
}

TEST_F(Formats, BadFilesAreRefusedWithExitCode3AndOneLine) {
    ASSERT_EQ(run({"make", "bar", "--points", "600", "--out", "bar.las"}).code, 0);
    const std::string whole = read_text(folder / "bar.las");
    write_text(folder / "cut.las", std::string_view(whole).substr(0, whole.size() - 1));
    std::string packed = whole;
    packed[104] = static_cast<char>(packed[104] | '\x80');
    write_text(folder / "packed.laz", packed);
    for (const char* file : {"cut.las", "packed.laz"})
        for (const char* command : {"info", "replay"}) {
            session(file, ends + lift);
            const Outcome outcome = run({command, command == std::string("info") ? file : "s.knead"});
            EXPECT_EQ(outcome.code, 3) << outcome.err;
            EXPECT_EQ(outcome.out, "");
            EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
            EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
        }
}

} // namespace
} // namespace knead::test
