#include "edit/editor_bar.h"
#include "edit/view_vectors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knead::test {

namespace {

constexpr double pi = std::numbers::pi;

} // namespace

TEST_F(BarEditor, SelectsWhatTheBoxHolds) {
    editor_.camera.orthographic = true;
    select_heights(1, 3);
    EXPECT_EQ(editor_.selected, points_between(1, 3));
    select_heights(-3, -1, SelectMode::add);
    EXPECT_EQ(editor_.selected, points_between(1, 3) + points_between(-3, -1));
    select_heights(2, 3, SelectMode::remove);
    EXPECT_EQ(editor_.selected, points_between(1, 3) + points_between(-3, -1) - points_between(2, 3));
}

TEST_F(BarEditor, VisibleOnlyLeavesTheBackAlone) {
    const ScreenBox all{{0, 0}, {800, 800}};
    apply(editor_, SelectRegion{all, SelectMode::replace, true});
    EXPECT_EQ(editor_.selected, 3000U);
    apply(editor_, SelectRegion{all, SelectMode::replace, false});
    EXPECT_GT(editor_.selected, 500U);
    EXPECT_LT(editor_.selected, 1500U);
}

TEST_F(BarEditor, UndoAndRedoGoOverSelectionsToo) {
    editor_.camera.orthographic = true;
    select_heights(1, 3);
    const auto first = editor_.marks;
    apply(editor_, ChangeSelection{SelectionStep::invert});
    const auto second = editor_.marks;
    apply(editor_, ChangeHidden{HideStep::hide_selected});
    EXPECT_EQ(editor_.hidden, 3000U - points_between(1, 3));
    apply(editor_, UndoStep{});
    EXPECT_EQ(editor_.marks, second);
    apply(editor_, UndoStep{});
    EXPECT_EQ(editor_.marks, first);
    apply(editor_, RedoStep{});
    EXPECT_EQ(editor_.marks, second);
    apply(editor_, UndoStep{});
    apply(editor_, UndoStep{});
    EXPECT_EQ(editor_.selected, 0U);
    EXPECT_FALSE(can_undo(editor_));
}

TEST_F(BarEditor, ADoubleClickLeavesTheSelectionAlone) {
    select_heights(1, 2);
    const std::vector<std::uint8_t> marks = editor_.marks;
    const std::size_t steps = editor_.past.size();
    const glm::dvec2 low = pixel_of({0, 0, -2});
    const double before = editor_.camera.pivot.z;
    apply(editor_, SelectPointUnder{low});
    EXPECT_NE(editor_.marks, marks) << "the first of the two is a click";
    apply(editor_, SetPivotUnder{low});
    EXPECT_EQ(editor_.marks, marks);
    EXPECT_EQ(editor_.past.size(), steps);
    EXPECT_LT(editor_.camera.pivot.z, before - 1);
    // A click of long ago stays.
    apply(editor_, SelectPointUnder{low});
    apply(editor_, ChangeSelection{SelectionStep::grow});
    const std::vector<std::uint8_t> grown = editor_.marks;
    apply(editor_, SetPivotUnder{low});
    EXPECT_EQ(editor_.marks, grown);
}

TEST_F(BarEditor, ADoubleClickTakesBackNothingThatItDidNotSelect) {
    const glm::dvec2 low = pixel_of({0, 0, -2});
    apply(editor_, SelectPointUnder{low});
    const std::vector<std::uint8_t> marks = editor_.marks;
    apply(editor_, SetPivotUnder{pixel_of({0, 0, 2})}); // elsewhere
    EXPECT_EQ(editor_.marks, marks);

    apply(editor_, ChangeSelection{SelectionStep::none});
    apply(editor_, SelectPointUnder{low});
    OpenRequest request;
    request.file = folder_ / "bar.ply";
    request.device = "reference";
    open(editor_, request);
    ASSERT_TRUE(wait_until([&] { return refresh(editor_) && !editor_.opening; }));
    apply(editor_, SetPivotUnder{pixel_of({0, 0, -2})}); // in another document, where nothing was done
    EXPECT_TRUE(editor_.past.empty());
}

TEST_F(BarEditor, TellsWhichHandleIsUnderTheCursor) {
    make_handles();
    EXPECT_EQ(handle_under(editor_, pixel_of({0, 0, 2.4})), "high");
    EXPECT_EQ(handle_under(editor_, pixel_of({0, 0, 0})), "");
    EXPECT_EQ(handle_under(editor_, {5, 5}), "");
}

TEST_F(BarEditor, GrowingAndShrinkingGoAlongTheSurface) {
    editor_.camera.orthographic = true;
    select_heights(1, 3);
    const std::size_t before = editor_.selected;
    apply(editor_, ChangeSelection{SelectionStep::grow});
    EXPECT_GT(editor_.selected, before);
    EXPECT_LT(editor_.selected, points_between(0.5, 3));
    apply(editor_, ChangeSelection{SelectionStep::shrink});
    apply(editor_, ChangeSelection{SelectionStep::shrink});
    EXPECT_LT(editor_.selected, before);
    EXPECT_GT(editor_.selected, points_between(1.5, 3));
    apply(editor_, ChangeSelection{SelectionStep::connected});
    EXPECT_EQ(editor_.selected, 3000U);
}

TEST_F(BarEditor, RXNinetyEnterTurnsTheHandleByNinetyDegrees) {
    make_handles();
    transform_chosen('R', 'X', "90");
    ASSERT_TRUE(editor_.document->posed);
    const Eigen::AngleAxisd turn(editor_.document->motions[1].rotation);
    EXPECT_NEAR(turn.angle(), pi / 2, 1e-12);
    EXPECT_NEAR(std::abs(turn.axis().x()), 1, 1e-12);
    // About the middle of the handle's points: that stays where it is.
    EXPECT_NEAR(glm::length(editor_.handle_middle - middle_at_rest()), 0, 1e-5);
}

TEST_F(BarEditor, EscapeTakesADragBack) {
    make_handles();
    const LineArray<float> rest = editor_.frame.positions();
    const std::size_t steps = editor_.past.size();
    move({400, 100});
    press('G');
    move({500, 150});
    press(Key::escape);
    calm();
    EXPECT_EQ(editor_.frame.positions(), rest);
    EXPECT_EQ(editor_.past.size(), steps);
    EXPECT_FALSE(editor_.document->posed);
}

TEST_F(BarEditor, TakingBackInTheMiddleOfATransformDropsIt) {
    make_handles();
    const std::size_t steps = editor_.past.size();
    move({400, 100});
    press('G');
    move({500, 150});
    press('Z');
    press('Z', {false, true, false});
    calm();
    EXPECT_FALSE(editor_.tools.drag);
    EXPECT_EQ(editor_.past.size(), steps);
    EXPECT_FALSE(editor_.document->posed);
}

TEST_F(BarEditor, TheHandleFollowsTheCursor) {
    make_handles();
    move({400, 100});
    press('G');
    move({460, 130});
    move({500, 150});
    const double pixel = pixel_size_at(editor_.camera, editor_.viewport, editor_.handle_middle);
    press(Key::enter);
    calm();
    const Vec3d offset = editor_.document->motions[1].offset;
    const Ray ray = ray_through(editor_.camera, editor_.viewport, {400, 400});
    EXPECT_NEAR(offset.norm(), std::hypot(100, 50) * pixel, 1e-9);
    EXPECT_NEAR(to_glm(offset).z, -50 * pixel, 1e-9);
    EXPECT_NEAR(glm::dot(to_glm(offset), ray.direction), 0, 1e-9);
}

TEST_F(BarEditor, EnterCommitsAndSaysSoWhenThereIsNothing) {
    make_handles();
    press('R');
    type("30");
    press(Key::enter);
    calm();
    press(Key::enter);
    EXPECT_NE(editor_.just_done.find("new rest shape"), std::string::npos) << "it is told what became of it";
    calm();
    EXPECT_FALSE(editor_.document->posed);
    editor_.notices.clear();
    press(Key::enter);
    ASSERT_EQ(editor_.notices.size(), 1U);
    EXPECT_NE(editor_.notices[0].words.find("Nothing is posed"), std::string::npos);
}

TEST_F(BarEditor, HidesNotAllWhereNothingIsSelected) {
    apply(editor_, ChangeHidden{HideStep::hide_unselected});
    EXPECT_EQ(editor_.hidden, 0U);
    EXPECT_FALSE(can_undo(editor_));
    ASSERT_EQ(editor_.notices.size(), 1U);
    select_heights(2, 3);
    apply(editor_, ChangeHidden{HideStep::hide_unselected});
    EXPECT_GT(editor_.hidden, 0U);
}

TEST_F(BarEditor, FindsWhatLiesOffTheSurface) {
    apply(editor_, ChangeSelection{SelectionStep::outliers});
    EXPECT_EQ(editor_.selected, 0U);
    ASSERT_EQ(editor_.notices.size(), 1U);
    EXPECT_NE(editor_.notices[0].words.find("off the surface"), std::string::npos);

    ShapeOptions options;
    options.points = 3000;
    options.outliers = 0.02;
    SilentProgress silent;
    Workers workers(1);
    const PointCloud bar = make_shape(Shape::bar, options, workers, silent);
    write_cloud(folder_ / "dusty.ply", bar, {}, silent);
    OpenRequest request;
    request.file = folder_ / "dusty.ply";
    request.device = "reference";
    open(editor_, request);
    ASSERT_TRUE(wait_until([&] {
        refresh(editor_);
        return !editor_.opening && editor_.document->outliers;
    }));
    apply(editor_, ChangeSelection{SelectionStep::outliers});
    EXPECT_GT(editor_.selected, 20U);
    EXPECT_LE(editor_.selected, 60U);
    for (std::size_t i = 0; i < editor_.marks.size(); ++i) {
        if (!(editor_.marks[i] & mark_selected)) continue;
        const Vec3d p = point_at(editor_.frame.positions(), i) + editor_.opened.cloud->origin;
        const Vec3d beyond = p.cwiseAbs() - Vec3d(0.5, 0.5, 2.5); // of the bar's faces
        const double off = beyond.maxCoeff() > 0 ? beyond.cwiseMax(0).norm() : -beyond.maxCoeff();
        EXPECT_GT(off, 0.01) << i;
    }
    apply(editor_, ChangeHidden{HideStep::hide_selected});
    apply(editor_, ChangeSelection{SelectionStep::outliers});
    EXPECT_EQ(editor_.selected, 0U) << "hidden ones are left alone";
}

TEST_F(BarEditor, ASessionWithoutItsCloudIsToldInWordsOfTheWindow) {
    write_text(folder_ / "s.knead", R"({"knead":1,"cloud":{"path":"moved.ply"}})"
                                    "\n");
    OpenRequest request;
    request.file = folder_ / "s.knead";
    open(editor_, request);
    ASSERT_TRUE(wait_until([&] { return refresh(editor_) && editor_.without_cloud; }));
    EXPECT_NE(editor_.without_cloud->why.find("moved.ply"), std::string::npos);
    EXPECT_EQ(editor_.without_cloud->why.find("--"), std::string::npos);

    request = std::exchange(editor_.without_cloud, std::nullopt)->request;
    request.cloud = folder_ / "s.knead"; // taken by mistake
    open(editor_, request);
    ASSERT_TRUE(wait_until([&] { return refresh(editor_) && editor_.without_cloud; }));
    EXPECT_EQ(editor_.without_cloud->why.find("replay"), std::string::npos);
    EXPECT_NE(editor_.without_cloud->why.find("Ctrl+O"), std::string::npos);
}

TEST_F(BarEditor, AnotherSelectToolDropsWhatWasBegun) {
    editor_.tools.select = SelectTool::polygon;
    const auto click = [&](glm::dvec2 at) {
        handle_input(editor_, MousePress{MouseButton::left, at, {}, 1});
        handle_input(editor_, MouseRelease{MouseButton::left, at, {}});
    };
    for (const SelectTool next : {SelectTool::polygon, SelectTool::lasso, SelectTool::brush}) {
        editor_.tools.select = SelectTool::polygon;
        click({300, 300});
        ASSERT_EQ(editor_.tools.band.size(), 1U);
        take_select_tool(editor_, next);
        EXPECT_EQ(editor_.tools.select, next);
        EXPECT_EQ(editor_.tools.doing, Tools::Doing::nothing);
        press(Key::backspace);
        move({350, 350});
        EXPECT_TRUE(editor_.tools.band.empty());
    }
}

TEST_F(BarEditor, FramesTheChosenHandleWhereNothingIsSelected) {
    make_handles();
    apply(editor_, FrameView{FrameWhat::selection});
    const double near = pixel_size_at(editor_.camera, editor_.viewport, editor_.handle_middle);
    apply(editor_, ChooseHandle{});
    apply(editor_, FrameView{FrameWhat::selection});
    EXPECT_GT(pixel_size_at(editor_.camera, editor_.viewport, editor_.handle_middle), 2 * near);
}

TEST_F(BarEditor, StepsOfSelectionShareWhatIsTheSame) {
    for (int i = 0; i < 4; ++i) select_heights(-0.5 * i, 2);
    ASSERT_EQ(editor_.past.size(), 4U);
    for (std::size_t step = 1; step < 4; ++step)
        EXPECT_EQ(editor_.past[step].before, editor_.past[step - 1].after);
}

TEST_F(BarEditor, AFailedOpeningLeavesThePresentDocument) {
    make_handles();
    OpenRequest request;
    request.file = folder_ / "nothing.ply";
    open(editor_, request);
    ASSERT_TRUE(wait_until([&] {
        refresh(editor_);
        return !editor_.opening;
    }));
    EXPECT_EQ(editor_.document->handles.size(), 2U);
    EXPECT_EQ(editor_.notices.size(), 1U);
}

TEST_F(BarEditor, WhatBecameOfASaveIsToldThoughAnotherFileWasOpenedMeanwhile) {
    write_text(folder_ / "other.ply", "somebody else's");
    editor_.live->save_cloud(folder_ / "nowhere" / "a.ply");
    OpenRequest request;
    request.file = bar_file(folder_);
    request.device = "reference";
    LiveDocument* const before = editor_.live.get();
    open(editor_, request);
    ASSERT_TRUE(wait_until([&] { // nobody looks before all of it is done
        return !before->status().busy && editor_.opening->status().stage == LiveDocument::Stage::open;
    }));
    refresh(editor_);
    ASSERT_NE(editor_.live.get(), before);
    ASSERT_EQ(editor_.notices.size(), 1U);
    EXPECT_NE(editor_.notices[0].words.find("nowhere"), std::string::npos);
}

TEST_F(BarEditor, LeadsTheArtistFromStepToStep) {
    EXPECT_NE(next_step(editor_).find("box"), std::string::npos);
    editor_.camera.orthographic = true;
    select_heights(2, 3);
    EXPECT_NE(next_step(editor_).find("Press H"), std::string::npos);
    press('H');
    calm();
    EXPECT_NE(next_step(editor_).find("Nothing holds the rest"), std::string::npos);
    select_heights(-3, -2);
    press('H', {.shift = true});
    calm();
    EXPECT_NE(next_step(editor_).find("gizmo"), std::string::npos);
    select_heights(-1, 1);
    EXPECT_NE(next_step(editor_).find("H makes the selection a handle"), std::string::npos);
}

TEST_F(BarEditor, ACancelledDragKeepsWhatCanBeRedone) {
    make_handles();
    press('R');
    type("30");
    press(Key::enter);
    calm();
    apply(editor_, UndoStep{});
    calm();
    ASSERT_TRUE(can_redo(editor_));
    press('G');
    move({500, 150});
    press(Key::escape);
    calm();
    EXPECT_TRUE(can_redo(editor_));
    apply(editor_, RedoStep{});
    calm();
    EXPECT_TRUE(editor_.document->posed);
}

TEST_F(BarEditor, UndoBehindARefusedStepTakesNothingElseBack) {
    make_handles();
    apply(editor_, DeleteHandles{{"low"}});
    apply(editor_, RenameHandle{"low", "foot"}); // refused, but the editor does not know yet
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(editor_.document->handles.size(), 1U) << "the first deletion stands";
    EXPECT_FALSE(can_redo(editor_));
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(editor_.document->handles.size(), 2U);
}

TEST_F(BarEditor, ASliderThatGoesOnMovingIsOneStep) {
    make_handles();
    const std::size_t steps = editor_.past.size();
    for (const double stiffness : {0.02, 0.03, 0.05}) {
        SettingsChange change;
        change.stiffness = stiffness;
        apply(editor_, ChangeSettings{change});
    }
    calm();
    EXPECT_EQ(editor_.past.size(), steps + 1);
    EXPECT_EQ(editor_.document->settings.stiffness, 0.05);
    EXPECT_EQ(editor_.document->undoable_steps, 3U) << "two handles, and the slider";
    apply(editor_, UndoStep{});
    calm();
    EXPECT_EQ(editor_.document->settings.stiffness, 0.01);
    apply(editor_, RedoStep{});
    calm();
    EXPECT_EQ(editor_.document->settings.stiffness, 0.05);
}

TEST_F(BarEditor, KnowsWhatIsUnsaved) {
    EXPECT_FALSE(has_unsaved_session(editor_));
    make_handles();
    EXPECT_TRUE(has_unsaved_session(editor_));
    editor_.live->save_session(folder_ / "a.knead");
    calm();
    EXPECT_FALSE(has_unsaved_session(editor_));
    apply(editor_, UndoStep{});
    calm();
    EXPECT_TRUE(has_unsaved_session(editor_));
    apply(editor_, RedoStep{});
    calm();
    EXPECT_FALSE(has_unsaved_session(editor_));
    apply(editor_, ChooseHandle{"high"});
    press('R');
    type("30");
    press(Key::enter);
    calm();
    EXPECT_TRUE(has_unsaved_session(editor_));
    editor_.live->save_cloud(folder_ / "b.ply");
    calm();
    EXPECT_TRUE(has_unsaved_session(editor_)) << "an exported cloud is no session";
    editor_.live->save_session(folder_ / "a.knead");
    calm();
    EXPECT_FALSE(has_unsaved_session(editor_));
}

TEST_F(BarEditor, DisplacementAndStretchAreThoseOfTheShape) {
    make_handles();
    EXPECT_EQ(std::ranges::max(displacements(editor_)), 0.0F);
    for (const float stretch : local_stretch(editor_)) EXPECT_EQ(stretch, 1.0F);
    transform_chosen('G', 'Z', "1");
    EXPECT_NEAR(static_cast<double>(std::ranges::max(displacements(editor_))), 1, 0.05);
    const std::vector<float> stretch = local_stretch(editor_);
    double sum = 0;
    for (const float s : stretch) sum += static_cast<double>(s);
    EXPECT_GT(sum / static_cast<double>(stretch.size()), 1.05);
}

} // namespace knead::test
