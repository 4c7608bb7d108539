// The fields of the panel "Transform": what the hand does there, and what the editor is told.

#include "app/ui.h"
#include "window/panel.h"

#include <numbers>

namespace knead::test {

namespace {

// The panel of a document that was made by hand: a handle that was moved by 0.5 along x, of a cloud of size 1
// that begins at 100, 0, 0 of its file's coordinates.
class TransformFields : public Panel {
protected:
    void SetUp() override {
        Panel::SetUp();
        state_.fonts = fonts_;
        cloud_.positions = {0, 0, 0, 1, 0, 0};
        cloud_.origin = {100, 0, 0};
        editor_.opened.cloud = &cloud_;
        editor_.opened.bounds = {Vec3d(100, 0, 0), Vec3d(101, 0, 0)};
        auto document = std::make_shared<DocumentView>();
        document->handles.emplace_back().name = "paw";
        document->handles.emplace_back().name = "stand";
        document->handles.back().role = HandleRole::fixed;
        document->handles.emplace_back().name = "tail";
        for (Handle& handle : document->handles)
            handle.points = std::make_shared<const std::vector<Index>>(1, Index{0});
        document->motions.resize(3);
        document->motions[0].offset = {0.5, 0, 0};
        editor_.document = std::move(document);
        editor_.chosen = "paw";
        editor_.handle_middle = {0.75, 0, 0};
    }
    void draw() override { transform_panel({editor_, state_, commands_, wishes_}); }

    // The middle of a field: of the rows place, moved, turned, scaled from 0, and x, y, z.
    ImVec2 field(int row, int column) {
        const ImGuiStyle& style = ImGui::GetStyle();
        const float left = style.WindowPadding.x + 66, width = 310 - style.WindowPadding.x - left;
        return {left + width * (static_cast<float>(column) + 0.5f) / 3,
                style.WindowPadding.y + (static_cast<float>(row) + 0.5f) * ImGui::GetFrameHeight() +
                    static_cast<float>(row) * style.ItemSpacing.y};
    }
    void type(std::string_view text) {
        for (const char letter : text) {
            ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(letter));
            frames(2);
        }
        EXPECT_TRUE(commands_.empty()) << "while it is typed";
    }
    // Clicks into a field, types, and leaves it by a key.
    void enter(ImVec2 into, std::string_view text, ImGuiKey key = ImGuiKey_Enter) {
        click(into);
        type(text);
        press(key);
    }
    // The button goes down there, and stays so.
    ImGuiIO& grab(ImVec2 at) {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = at;
        frame();
        io.MouseDown[0] = true;
        frame();
        return io;
    }
    // The one drag that the editor was told of, whole; its transform.
    Transform told_drag() {
        if (commands_.size() != 3) {
            ADD_FAILURE() << commands_.size() << " commands";
            return {};
        }
        EXPECT_TRUE(std::holds_alternative<BeginDrag>(commands_[0]));
        EXPECT_TRUE(std::holds_alternative<EndDrag>(commands_[2]));
        const Transform transform = std::get<DragTo>(commands_[1]).transform;
        commands_.clear();
        return transform;
    }

    PointCloud cloud_;
    Editor editor_{1};
    UiState state_;
    std::vector<Command> commands_;
    std::vector<Wish> wishes_;
};

TEST_F(TransformFields, TakeANumberAsADragOfTheHandle) {
    frames(2);
    enter(field(0, 0), "101,25");
    EXPECT_NEAR(told_drag().shift.x, 0.5, 1e-12) << "in the file's coordinates";
    enter(field(1, 0), "0.75");
    EXPECT_NEAR(told_drag().shift.x, 0.25, 1e-12) << "from where it was at rest";
    enter(field(2, 2), "720");
    const Transform turn = told_drag();
    EXPECT_NEAR(turn.angle, 4 * std::numbers::pi, 1e-9) << "both turns";
    EXPECT_NEAR(turn.axis.z, 1, 1e-12);
    enter(field(3, 1), "1.5");
    EXPECT_NEAR(told_drag().scale.y, 1.5, 1e-12);
}

TEST_F(TransformFields, TakeSums) {
    frames(2);
    enter(field(1, 0), "0.25*3");
    EXPECT_NEAR(told_drag().shift.x, 0.25, 1e-12);
    enter(field(2, 2), "-90/4+2.5");
    EXPECT_NEAR(told_drag().angle, -20 * std::numbers::pi / 180, 1e-9);
}

// Where y is a right angle, turns about x and z are one to the pose, but not to who types them.
TEST_F(TransformFields, TellXFromZWhereYIsARightAngle) {
    constexpr double degree = std::numbers::pi / 180;
    const auto turn_to = [&](const Vec3d& turned) { // what the document answers
        auto document = std::make_shared<DocumentView>(*editor_.document);
        HandleMotion& motion = document->motions[0];
        motion.turned = turned * degree;
        motion.rotation = Eigen::AngleAxisd(motion.turned.z(), Vec3d::UnitZ()) *
                          Eigen::AngleAxisd(motion.turned.y(), Vec3d::UnitY()) *
                          Eigen::AngleAxisd(motion.turned.x(), Vec3d::UnitX());
        motion.linear = motion.rotation.toRotationMatrix();
        editor_.document = std::move(document);
        frames(2);
    };
    turn_to({0, 90, 0});
    enter(field(2, 0), "30");
    EXPECT_NEAR(told_drag().angle, 30 * degree, 1e-9);
    turn_to({0, 90, -30}); // the same, in the angles of the pose
    enter(field(2, 0), "40");
    EXPECT_NEAR(told_drag().angle, 10 * degree, 1e-9) << "from 30, and not from 0";
    turn_to({0, 90, -40});
    enter(field(2, 2), "5");
    EXPECT_NEAR(told_drag().angle, 5 * degree, 1e-9);
}

TEST_F(TransformFields, GoOnByTab) {
    frames(2);
    enter(field(1, 0), "0.75", ImGuiKey_Tab);
    EXPECT_NEAR(told_drag().shift.x, 0.25, 1e-12);
    frames(3);
    type("2");
    press(ImGuiKey_Tab);
    EXPECT_NEAR(told_drag().shift.y, 2, 1e-12);
    frames(3);
    type("3");
    press(ImGuiKey_Enter);
    EXPECT_NEAR(told_drag().shift.z, 3, 1e-12);
}

TEST_F(TransformFields, LeaveTheHandleWhereNothingWasTyped) {
    frames(2);
    click(field(1, 0));
    press(ImGuiKey_Enter);
    enter(field(2, 0), "45", ImGuiKey_Escape);
    EXPECT_TRUE(commands_.empty());
}

TEST_F(TransformFields, RefuseToMirrorOrFlatten) {
    frames(2);
    for (const char* factor : {"0", "-1"}) {
        enter(field(3, 0), factor);
    }
    EXPECT_TRUE(commands_.empty());
    EXPECT_EQ(state_.toasts.size(), 1U) << "said once";
}

TEST_F(TransformFields, SlideAsOneDrag) {
    frames(2);
    ImGuiIO& io = grab(field(2, 1));
    for (int step = 0; step < 5; ++step) {
        io.MousePos.x += 10;
        frame();
    }
    io.MouseDown[0] = false;
    frames(3);
    ASSERT_GT(commands_.size(), 3U);
    EXPECT_TRUE(std::holds_alternative<BeginDrag>(commands_.front()));
    EXPECT_TRUE(std::holds_alternative<EndDrag>(commands_.back()));
    double before = 0;
    for (std::size_t c = 1; c + 1 < commands_.size(); ++c) {
        const Transform& transform = std::get<DragTo>(commands_[c]).transform;
        EXPECT_GT(transform.angle, before);
        EXPECT_NEAR(transform.axis.y, 1, 1e-12);
        before = transform.angle;
    }
}

TEST_F(TransformFields, TakeBackWhatIsSlidWhenItIsGivenUp) {
    frames(2);
    ImGuiIO& io = grab(field(1, 1));
    io.MousePos.x += 30;
    frames(2);
    state_.pose_fields.editing.gives_up = true;
    frames(2);
    io.MousePos.x += 30;
    frames(2);
    io.MouseDown[0] = false;
    frames(2);
    EXPECT_TRUE(std::holds_alternative<BeginDrag>(commands_.front()));
    EXPECT_TRUE(std::holds_alternative<CancelDrag>(commands_.back()));
}

TEST_F(TransformFields, LeaveTheHandleWhereTheHandSlidBack) {
    frames(2);
    ImGuiIO& io = grab(field(2, 1));
    io.MousePos.x += 20;
    frame();
    io.MousePos.x -= 20;
    frame();
    io.MouseDown[0] = false;
    frames(3);
    ASSERT_FALSE(commands_.empty());
    EXPECT_TRUE(std::holds_alternative<CancelDrag>(commands_.back())) << "no empty step to undo";
}

TEST_F(TransformFields, MoveThePivotAloneInPivotMode) {
    editor_.tools.move_pivot = true;
    frames(2);
    enter(field(0, 2), "0.5");
    ASSERT_EQ(commands_.size(), 1U);
    const auto pivot = std::get<SetPivot>(commands_[0]).pivot;
    ASSERT_TRUE(pivot);
    EXPECT_NEAR(pivot->x, 0.75, 1e-12);
    EXPECT_NEAR(pivot->z, 0.5, 1e-12);
}

TEST_F(TransformFields, RefuseMoreThanTwentyTurnsAndWhatIsNoNumber) {
    frames(2);
    for (const char* typed : {"8000", "1e999", "1e300", "-", "1.2.3", ""}) {
        click(field(2, 0));
        press(ImGuiKey_Delete);
        type(typed);
        press(ImGuiKey_Enter);
        EXPECT_TRUE(commands_.empty()) << typed;
    }
    enter(field(2, 0), "+30"); // is 30, and not 30 more
    EXPECT_NEAR(told_drag().angle, std::numbers::pi / 6, 1e-12);
}

TEST_F(TransformFields, StayAmongThemselvesByTab) {
    frames(2);
    click(field(3, 2));
    press(ImGuiKey_Tab);
    frames(3);
    type("100.5");
    press(ImGuiKey_Enter);
    EXPECT_NEAR(told_drag().shift.x, -0.25, 1e-12) << "round to the first";
}

TEST_F(TransformFields, TakeWhatIsTypedWhenTheHandGoesElsewhere) {
    frames(2);
    click(field(1, 0));
    type("7");
    ImGui::ClearActiveID();
    frame();
    EXPECT_NEAR(told_drag().shift.x, 6.5, 1e-12);
    frames(3);
    EXPECT_TRUE(commands_.empty()) << "once";
}

TEST_F(TransformFields, DoNothingToAnotherHandleThatWasChosenMeanwhile) {
    frames(2);
    click(field(1, 0));
    type("7");
    editor_.chosen = "tail";
    frames(5);
    press(ImGuiKey_Enter);
    EXPECT_TRUE(commands_.empty());
}

} // namespace

} // namespace knead::test
