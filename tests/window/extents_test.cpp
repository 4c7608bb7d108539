#include "app/extents.h"
#include "view/marks.h"

#include <gtest/gtest.h>

namespace knead::test {

namespace {

// A cloud of three points, two of which are selected, that begins at 100, 0, 0 of its file's coordinates.
struct Extents : ::testing::Test {
    Extents() {
        cloud.origin = {100, 0, 0};
        editor.opened.cloud = &cloud;
        editor.opened.bounds = {Vec3d(100, 0, 0), Vec3d(101, 2, 4)};
        place({0, 0, 0, 1, 0.25, 0, 1, 2, 4}, 1);
        mark({mark_selected, mark_selected, 0});
    }
    void place(std::initializer_list<float> positions, std::uint64_t version) {
        auto shape = std::make_shared<RestShape>();
        shape->positions.assign(positions.begin(), positions.end());
        editor.frame.shape = std::move(shape);
        editor.frame.version = version;
    }
    void mark(std::vector<std::uint8_t> marks) {
        editor.marks = std::move(marks);
        editor.selected = count_marks(editor.marks).selected;
        ++editor.marks_version;
    }

    PointCloud cloud;
    Editor editor{1};
    UiState state;
    std::vector<Command> commands;
    std::vector<Wish> wishes;
    Ui ui{editor, state, commands, wishes};
};

} // namespace

TEST_F(Extents, OfABoxAreItsSizeAndItsMiddle) {
    EXPECT_EQ(extent_text(ui, editor.opened.bounds),
              "Size: 1.0000 × 2.0000 × 4.0000\nMiddle: 100.5000, 1.0000, 2.0000");
}

TEST_F(Extents, NoNothingIsBelowZero) {
    editor.opened.bounds = {Vec3d(-1, -1, -1.00001), Vec3d(1, 1, 1)};
    EXPECT_EQ(extent_text(ui, editor.opened.bounds),
              "Size: 2.0000 × 2.0000 × 2.0000\nMiddle: 0.0000, 0.0000, 0.0000");
}

TEST_F(Extents, LengthsHaveAsManyDigitsAsTellPartsOfTheCloudApart) {
    EXPECT_EQ(length_format(ui, 1), "%.4f");
    EXPECT_EQ(length_format(ui, 612345), "%.1f");
    editor.opened.bounds.highest = {40'000, 0, 0};
    EXPECT_EQ(length_format(ui, 1), "%.0f");
    editor.opened.bounds = {Vec3d::Zero(), Vec3d(1e-9, 0, 0)};
    EXPECT_EQ(length_format(ui, 1e-9), "%.3g");
}

TEST_F(Extents, FollowWhatIsSelectedAndWhereItIs) {
    EXPECT_EQ(shown_extent_text(ui), "Size: 1.0000 × 0.2500 × 0.0000\nMiddle: 100.5000, 0.1250, 0.0000");
    mark({0, mark_selected, mark_selected});
    EXPECT_EQ(shown_extent_text(ui), "Size: 0.0000 × 1.7500 × 4.0000\nMiddle: 101.0000, 1.1250, 2.0000");
    place({0, 0, 0, 1, 1, 0, 1, 2, 4}, 2);
    EXPECT_EQ(shown_extent_text(ui), "Size: 0.0000 × 1.0000 × 4.0000\nMiddle: 101.0000, 1.5000, 2.0000");
    mark({0, 0, 0});
    EXPECT_EQ(shown_extent_text(ui), "Size: 1.0000 × 2.0000 × 4.0000\nMiddle: 100.5000, 1.0000, 2.0000")
        << "all of them";
}

TEST_F(Extents, WaitForTheEndOfADrag) {
    const std::string before = shown_extent_text(ui);
    editor.drag = EditorDrag{};
    place({0, 0, 0, 9, 9, 9, 1, 2, 4}, 2);
    EXPECT_EQ(shown_extent_text(ui), before);
    editor.drag.reset();
    EXPECT_EQ(shown_extent_text(ui), "Size: 9.0000 × 9.0000 × 9.0000\nMiddle: 104.5000, 4.5000, 4.5000");
}

} // namespace knead::test
