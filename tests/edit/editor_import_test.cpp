#include "edit/editor_import.h"
#include "edit/json_text.h"

#include "edit/live.h"

#include <fstream>

namespace knead::test {

namespace {

// Nine points in a row along x, with a label and what is no label.
PointCloud labelled_row() {
    std::vector<float> positions;
    std::vector<std::uint8_t> labels{7, 0, 0, 2, 2, 0, 0, 0, 7};
    std::vector<float> heights(9, 1.0f);
    for (int i = 0; i < 9; ++i) {
        positions.push_back(static_cast<float>(i));
        positions.push_back(0.1f * static_cast<float>(i % 2));
        positions.push_back(0);
    }
    PointCloud cloud = make_cloud(positions);
    add_attribute(cloud, "label", labels);
    add_attribute(cloud, "part", std::vector<std::uint8_t>(9, 1));
    add_attribute(cloud, "height", heights);
    return cloud;
}

class Import : public ::testing::Test {
protected:
    void SetUp() override {
        SilentProgress silent;
        write_cloud(folder_ / "row.ply", labelled_row(), {}, silent);
        OpenRequest request;
        request.file = folder_ / "row.ply";
        request.device = "reference";
        request.threads = 1;
        open(editor_, request);
        ASSERT_TRUE(wait_until([&] { return refresh(editor_) && editor_.document; }));
        calm();
    }

    void calm() {
        wait_until_idle(*editor_.live);
        refresh(editor_);
        refresh(editor_);
    }

    // `points`: of its cloud, as the header tells.
    std::filesystem::path session(const std::string& lines, std::size_t points = 9) {
        std::ofstream(folder_ / "other.knead")
            << R"({"knead":1,"cloud":{"path":"gone.ply","points":)" << points << "}}\n"
            << lines;
        return folder_ / "other.knead";
    }

    const Handle* handle(const std::string& name) const {
        for (const Handle& one : editor_.document->handles)
            if (one.name == name) return &one;
        return nullptr;
    }
    using Points = std::vector<Index>;

    ScratchFolder folder_;
    Editor editor_{1};
};

TEST(LabelColumns, AreWholeNumbersOfFewValues) {
    PointCloud cloud = labelled_row();
    const std::vector<LabelColumn> columns = label_columns(cloud);
    ASSERT_EQ(columns.size(), 1U) << "not one of a single value, nor of floats, nor a coordinate";
    EXPECT_EQ(columns[0].name, "label");
    ASSERT_EQ(columns[0].values.size(), 3U);
    EXPECT_EQ(columns[0].values[0].value, 0);
    EXPECT_EQ(columns[0].values[0].points, 5U);
    EXPECT_EQ(columns[0].values[1].value, 2);
    EXPECT_EQ(columns[0].values[2].value, 7);
    EXPECT_EQ(columns[0].values[2].points, 2U);
    EXPECT_EQ(columns[0].commonest, 0U);
}

TEST(LabelColumns, OfTooManyValuesAreNone) {
    std::vector<float> positions;
    std::vector<std::uint8_t> few, many;
    for (std::size_t i = 0; i < 2 * most_labels; ++i) {
        positions.insert(positions.end(), {static_cast<float>(i), 0, 0});
        few.push_back(static_cast<std::uint8_t>(i % most_labels));
        many.push_back(static_cast<std::uint8_t>(i % (most_labels + 1)));
    }
    PointCloud cloud = make_cloud(positions);
    add_attribute(cloud, "few", few);
    add_attribute(cloud, "many", many);
    const std::vector<LabelColumn> columns = label_columns(cloud);
    ASSERT_EQ(columns.size(), 1U);
    EXPECT_EQ(columns[0].name, "few");
}

TEST(NamesOfColumns, BecomeUtf8) {
    EXPECT_EQ(utf8_of("Gebäude"), "Gebäude");
    EXPECT_EQ(utf8_of("Geb\xe4ude"), "Geb\xef\xbf\xbdude"); // Latin 1, which no session file can hold
}

TEST_F(Import, LabelsBecomeHandlesInOneStep) {
    const std::vector<LabelChoice> choices{{7, HandleRole::fixed}, {2, HandleRole::moving}, {5, {}}};
    handles_from_labels(editor_, "label", choices);
    calm();
    ASSERT_EQ(editor_.document->handles.size(), 2U) << "no point has a 5";
    ASSERT_TRUE(handle("label 7") && handle("label 2"));
    EXPECT_EQ(*handle("label 7")->points, (Points{0, 8}));
    EXPECT_EQ(handle("label 7")->role, HandleRole::fixed);
    EXPECT_EQ(*handle("label 2")->points, (Points{3, 4}));
    EXPECT_EQ(handle("label 2")->role, HandleRole::moving);
    apply(editor_, UndoStep{});
    calm();
    EXPECT_TRUE(editor_.document->handles.empty());
}

TEST_F(Import, LabelsTakenAgainReplaceTheirHandlesAndSaySo) {
    const std::vector<LabelChoice> moving{{7, HandleRole::moving}}, fixed{{7, HandleRole::fixed}};
    handles_from_labels(editor_, "label", moving);
    calm();
    handles_from_labels(editor_, "label", fixed);
    calm();
    ASSERT_EQ(editor_.document->handles.size(), 1U);
    EXPECT_EQ(editor_.document->handles[0].role, HandleRole::fixed);
    EXPECT_NE(editor_.notices.back().words.find("took the place"), std::string::npos)
        << editor_.notices.back().words;
}

TEST_F(Import, LabelsThatAreNotThereAreRefusedWithWords) {
    const std::vector<LabelChoice> none{{5, HandleRole::moving}};
    handles_from_labels(editor_, "label", none);
    handles_from_labels(editor_, "height", none);
    handles_from_labels(editor_, "colour", none);
    calm();
    EXPECT_EQ(editor_.notices.size(), 3U);
    EXPECT_TRUE(editor_.document->handles.empty());
    EXPECT_FALSE(can_undo(editor_));
}

TEST_F(Import, ASessionGivesTheHandlesThatItEndsWith) {
    handles_from_session(editor_, session(R"({"op":"handle","name":"a","role":"fixed","points":[[0,2]]}
{"op":"handle","name":"b","role":"moving","region":{"box":{"min":[4.5,-1,-1],"max":[6.5,1,1]}}}
{"op":"handle","name":"c","role":"moving","points":[8]}
{"op":"delete","handle":"c"}
{"op":"handle","name":"d","role":"roi","points":[3]}
{"op":"undo"}
{"op":"rename","handle":"b","to":"arm"}
)"));
    calm();
    ASSERT_EQ(editor_.document->handles.size(), 2U);
    ASSERT_TRUE(handle("a") && handle("arm"));
    EXPECT_EQ(*handle("a")->points, (Points{0, 1, 2}));
    EXPECT_EQ(handle("a")->role, HandleRole::fixed);
    EXPECT_EQ(*handle("arm")->points, (Points{5, 6}));
    apply(editor_, UndoStep{});
    calm();
    EXPECT_TRUE(editor_.document->handles.empty());
}

TEST_F(Import, ASessionGivesThePivotsOfTheSameShape) {
    const std::string arm =
        R"({"op":"handle","name":"arm","role":"moving","points":[8],"pivot":[0.5,0.25,1]})"
        "\n";
    handles_from_session(editor_, session(arm));
    calm();
    ASSERT_TRUE(handle("arm") && handle("arm")->pivot);
    EXPECT_EQ(*handle("arm")->pivot, Vec3d(0.5, 0.25, 1));
    const Vec3d there = Vec3d(0.5, 0.25, 1) - editor_.opened.cloud->origin;
    ASSERT_TRUE(pivot_of(editor_, "arm"));
    EXPECT_LT(glm::distance(*pivot_of(editor_, "arm"), glm::dvec3(there.x(), there.y(), there.z())), 1e-12);
    apply(editor_, UndoStep{});
    calm();
    EXPECT_FALSE(pivot_of(editor_, "arm"));
    handles_from_session(editor_, session(arm + R"({"op":"commit"})" + "\n"));
    calm();
    ASSERT_TRUE(handle("arm"));
    EXPECT_FALSE(handle("arm")->pivot) << "told of another shape, for all that is known";
}

TEST_F(Import, TakesNoHandleThePlaceOfAnotherOfItsName) {
    const std::filesystem::path other = session(R"({"op":"handle","name":"a","role":"fixed","points":[0]}
{"op":"handle","name":"b","role":"moving","points":[8]}
)");
    handles_from_session(editor_, other);
    handles_from_session(editor_, other); // with no answer yet
    calm();
    handles_from_session(editor_, other);
    calm();
    ASSERT_EQ(editor_.document->handles.size(), 6U);
    for (const char* const name : {"a", "b", "a (2)", "b (2)", "a (3)", "b (3)"})
        EXPECT_TRUE(handle(name)) << name;
    EXPECT_NE(editor_.notices.back().words.find("\"a\" is called \"a (3)\""), std::string::npos)
        << editor_.notices.back().words;
}

TEST_F(Import, RedoneHandlesOfASessionCount) {
    handles_from_session(editor_, session(R"({"op":"handle","name":"a","role":"fixed","points":[0]}
{"op":"handle","name":"b","role":"moving","points":[8]}
{"op":"undo"}
{"op":"undo"}
{"op":"redo"}
)"));
    calm();
    ASSERT_EQ(editor_.document->handles.size(), 1U);
    EXPECT_TRUE(handle("a"));
}

TEST_F(Import, ASessionOfAnotherCloudIsRefusedWithWords) {
    for (const std::string lines : {R"({"op":"handle","name":"a","role":"fixed","points":[0]}
{"op":"handle","name":"b","role":"moving","points":[[7,9]]}
)",
                                    "{\"op\":\"settle\",\"iterations\":1}\n", "{\"op\":\"jump\"}\n"}) {
        editor_.notices.clear();
        handles_from_session(editor_, session(lines));
        calm();
        EXPECT_EQ(editor_.notices.size(), 1U) << lines;
        EXPECT_TRUE(editor_.document->handles.empty()) << lines;
        EXPECT_FALSE(can_undo(editor_)) << lines;
    }
    const std::string of_numbers = R"({"op":"handle","name":"a","role":"fixed","points":[0]})";
    const std::string of_region =
        R"({"op":"handle","name":"b","role":"fixed","region":{"box":{"min":[-1,-1,-1],"max":[1.5,1,1]}}})";
    editor_.notices.clear();
    handles_from_session(editor_, session(of_numbers + "\n" + of_region + "\n", 10));
    calm();
    ASSERT_EQ(editor_.notices.size(), 1U);
    EXPECT_NE(editor_.notices[0].words.find("of 10 points, and this one has 9"), std::string::npos)
        << editor_.notices[0].words;
    EXPECT_TRUE(editor_.document->handles.empty());
    handles_from_session(editor_, session(of_region + "\n", 10));
    calm();
    EXPECT_EQ(*handle("b")->points, (Points{0, 1})) << "a region is one in any cloud";
    editor_.notices.clear();
    handles_from_session(editor_, folder_ / "nowhere.knead");
    EXPECT_EQ(editor_.notices.size(), 1U);
}

} // namespace

} // namespace knead::test
