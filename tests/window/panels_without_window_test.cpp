// Panels and widgets without a window: Dear ImGui's frames, drawn by nobody, and a hand that is told to it.

#include "app/number_fields.h"
#include "app/ui.h"
#include "app/widgets.h"
#include "view/framing.h"
#include "window/panel.h"

#include <stdexcept>
#include <string_view>

namespace knead::test {

namespace {

class NumberSlider : public Panel {
protected:
    void draw() override {
        if (whole_)
            bar_slider("Samples", count_, 50, 100000, "%d");
        else if (bar_slider("Stiffness", value_, 0.0f, 1.0f, "%.3f"))
            ++changes_;
        middle_ = ImRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax()).GetCenter();
    }

    // Typing begins, and takes effect nowhere yet.
    void type(std::string_view text) {
        frames(2);
        click(middle_, true);
        for (const char letter : text) {
            ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(letter));
            frames(2);
            EXPECT_EQ(value_, 0.5f) << "while it is typed";
        }
        EXPECT_EQ(changes_, 0) << "while it is typed";
    }

    float value_ = 0.5f;
    bool whole_ = false;
    int count_ = 1000, changes_ = 0;
    ImVec2 middle_;
};

// Three sliders, the middle one of which cannot be used.
class SlidersInARow : public Panel {
protected:
    void draw() override {
        bar_slider("First", first_, 0.0f, 1.0f, "%.3f");
        middle_ = ImRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax()).GetCenter();
        ImGui::BeginDisabled();
        bar_slider("Second", second_, 0.0f, 1.0f, "%.3f");
        ImGui::EndDisabled();
        bar_slider("Third", third_, 0.0f, 1.0f, "%.3f");
    }
    void type(std::string_view text) {
        for (const char letter : text) {
            ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(letter));
            frames(2);
        }
    }
    void tab(bool back) {
        ImGui::GetIO().KeyShift = back;
        press(ImGuiKey_Tab);
        ImGui::GetIO().KeyShift = false;
        frames(2);
    }

    float first_ = 0.5f, second_ = 0.5f, third_ = 0.5f;
    ImVec2 middle_;
};

// A choice of three at the right side, near the lower edge.
class ExplainedChoice : public Panel {
protected:
    void SetUp() override {
        Panel::SetUp();
        ImGui::GetIO().DisplaySize.x = 1000;
        left_ = 700;
    }
    void draw() override {
        ImGui::SetCursorPosY(600);
        segmented("choice", std::array{"one", "two", "three"}, 1);
        choice_ = ImRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
        explain("First line\nsecond line\nthird line");
    }

    static const ImGuiWindow* explanation() { return ImGui::FindWindowByName("##Tooltip_00"); }
    static bool is_explained() { return explanation() && explanation()->Active && !explanation()->Hidden; }

    ImRect choice_;
};

// The panel of handles, of a document that was made by hand.
class HandleList : public Panel {
protected:
    void SetUp() override {
        Panel::SetUp();
        state_.fonts = fonts_;
        have(20);
    }
    void draw() override { handles_panel({editor_, state_, commands_, wishes_}); }

    void have(int handles) {
        auto document = std::make_shared<DocumentView>();
        for (int i = 1; i <= handles; ++i) {
            Handle handle;
            handle.name = "handle " + std::to_string(i);
            handle.points = std::make_shared<const std::vector<Index>>(1, Index{0});
            document->handles.push_back(std::move(handle));
        }
        editor_.document = std::move(document);
    }

    // The list's own window.
    static const ImGuiWindow& list() {
        for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
            if (std::string_view(window->Name).find("/list_") != std::string_view::npos) return *window;
        throw std::runtime_error("there is no list");
    }
    static float row() { return ImGui::GetFrameHeight() + 2; }
    // Whether the whole row of the handle of this number, from 1, is seen.
    static bool sees(int number) {
        const float top = row() * static_cast<float>(number - 1) - list().Scroll.y;
        return top >= -1 && top + row() <= list().Size.y + 1;
    }

    Editor editor_{1};
    UiState state_;
    std::vector<Command> commands_;
    std::vector<Wish> wishes_;
};

// Messages in a view of 440 by 480, and a gizmo in its lower right corner once there is a handle.
class Messages : public Panel {
protected:
    void SetUp() override {
        Panel::SetUp();
        ImGui::GetIO().DisplaySize = {440, 480};
        state_.fonts = fonts_;
        state_.view = {0, 0, 440, 480};
        editor_.viewport = {800, 800}; // whose middle is at 400, 400
        editor_.camera = first_view({glm::dvec3(-1), glm::dvec3(1)}, editor_.viewport);
        auto document = std::make_shared<DocumentView>();
        document->handles.emplace_back().name = "paw";
        document->motions.resize(1);
        editor_.document = std::move(document);
        add_toast(state_, {Notice::Kind::information, "Saved the cloud as paw.ply"});
    }
    void draw() override { draw_toasts({editor_, state_, commands_, wishes_}); }

    Editor editor_{1};
    UiState state_;
    std::vector<Command> commands_;
    std::vector<Wish> wishes_;
};

} // namespace

TEST_F(NumberSlider, WhatIsTypedCountsOnceWhenReturnIsPressed) {
    type("0.125");
    press(ImGuiKey_Enter);
    EXPECT_EQ(value_, 0.125f);
    EXPECT_EQ(changes_, 1);
    frames(5);
    EXPECT_EQ(changes_, 1);
}

TEST_F(NumberSlider, TakesSums) {
    type("1/8");
    press(ImGuiKey_Enter);
    EXPECT_EQ(value_, 0.125f);
}

TEST_F(NumberSlider, ACommaIsADecimalPoint) {
    type("0,125");
    press(ImGuiKey_Enter);
    EXPECT_EQ(value_, 0.125f);
}

TEST_F(NumberSlider, ACommaInAWholeNumberCountsForNothing) {
    whole_ = true;
    type("12,500");
    press(ImGuiKey_Enter);
    EXPECT_EQ(count_, 12500);
}

TEST_F(NumberSlider, WhatIsTypedCountsOnceWhenTheFieldIsLeft) {
    type("0.25");
    click({150, 500});
    EXPECT_EQ(value_, 0.25f);
    EXPECT_EQ(changes_, 1);
}

TEST_F(NumberSlider, EscapeTakesBackWhatWasTyped) {
    type("0.75");
    press(ImGuiKey_Escape);
    EXPECT_EQ(value_, 0.5f);
    EXPECT_EQ(changes_, 0);
}

TEST_F(NumberSlider, TheSameNumberTypedAgainIsNoChange) {
    type("0.5");
    press(ImGuiKey_Enter);
    EXPECT_EQ(value_, 0.5f);
    EXPECT_EQ(changes_, 0);
}

TEST_F(NumberSlider, ADragCountsAtOnce) {
    frames(2);
    click({middle_.x + 60, middle_.y});
    EXPECT_GT(value_, 0.55f);
    EXPECT_GE(changes_, 1);
}

TEST_F(SlidersInARow, AreTypedIntoOneAfterTheOtherByTab) {
    frames(2);
    click(middle_, true);
    type("0.1");
    tab(false);
    EXPECT_EQ(first_, 0.1f);
    type("0.3");
    tab(true);
    EXPECT_EQ(third_, 0.3f);
    type("0.2");
    tab(false);
    EXPECT_EQ(first_, 0.2f) << "back at the first";
    tab(false);
    type("0.4"); // round at the end
    press(ImGuiKey_Enter);
    EXPECT_EQ(first_, 0.4f);
    EXPECT_EQ(second_, 0.5f);
    EXPECT_EQ(third_, 0.3f) << "nothing typed, nothing changed";
}

TEST_F(ExplainedChoice, IsExplainedWhicheverTheCursorRestsOn) {
    frames(2);
    for (const float part : {1.0f / 6, 0.5f, 5.0f / 6}) {
        ImGui::GetIO().MousePos = nowhere;
        frames(3);
        EXPECT_FALSE(is_explained());
        ImGui::GetIO().MousePos = {choice_.Min.x + part * choice_.GetWidth(), choice_.GetCenter().y};
        frames(60);
        EXPECT_TRUE(is_explained()) << part;
    }
}

TEST_F(ExplainedChoice, IsExplainedBesideItsPanel) {
    frames(2);
    ImGui::GetIO().MousePos = choice_.GetCenter();
    frames(60);
    ASSERT_TRUE(is_explained());
    const ImRect words = explanation()->Rect();
    EXPECT_LE(words.Max.x, left_);
    EXPECT_LE(words.Max.y, ImGui::GetIO().DisplaySize.y);
    EXPECT_GT(words.Max.y, choice_.Min.y) << "at its height";
    EXPECT_LT(words.Min.y, choice_.Max.y);
}

TEST_F(HandleList, ShowsAsMuchAsThereIsRoomFor) {
    frames(4);
    EXPECT_GT(list().Size.y, 10 * row());
    EXPECT_LT(list().Size.y, 20 * row());
}

TEST_F(HandleList, ShowsSixRowsAtLeast) {
    ImGui::GetIO().DisplaySize.y = 200;
    frames(4);
    EXPECT_NEAR(list().Size.y, 6 * row(), 1);
    have(3);
    frames(4);
    EXPECT_NEAR(list().Size.y, 3 * row(), 1);
}

TEST_F(HandleList, AClickChoosesAndWithShiftOneMore) {
    frames(4);
    const ImVec2 second(list().Pos.x + 100, list().Pos.y + 1.5f * row());
    click(second);
    ASSERT_FALSE(commands_.empty());
    const auto* chosen = std::get_if<ChooseHandle>(&commands_.back());
    ASSERT_TRUE(chosen);
    EXPECT_EQ(chosen->handle, "handle 2");
    ImGui::GetIO().KeyShift = true;
    click({second.x, second.y + row()});
    ImGui::GetIO().KeyShift = false;
    const auto* also = std::get_if<ChooseAlso>(&commands_.back());
    ASSERT_TRUE(also);
    EXPECT_EQ(also->handle, "handle 3");
}

TEST_F(HandleList, AClickOnTheSquareIsAboutTheColour) {
    frames(4);
    click({list().Pos.x + 18, list().Pos.y + 1.5f * row()});
    EXPECT_TRUE(commands_.empty()) << "which handle is chosen stays";
    EXPECT_TRUE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
}

TEST_F(HandleList, GoesToTheFirstHandleThatHasNoRoom) {
    ImGui::GetIO().DisplaySize.y = 200;
    have(6);
    frames(4);
    editor_.chosen = "handle 7";
    have(7);
    frames(4);
    EXPECT_TRUE(sees(7));
}

TEST_F(HandleList, GoesToAHandleThatWasJustMade) {
    ImGui::GetIO().DisplaySize.y = 300;
    frames(4);
    EXPECT_TRUE(sees(1));
    EXPECT_FALSE(sees(20));
    editor_.chosen = "handle 21"; // which the document does not have yet
    frames(2);
    have(21);
    frames(4);
    EXPECT_TRUE(sees(21));

    // And leaves it to the user then where the list is.
    editor_.chosen = "handle 1";
    frames(4);
    EXPECT_TRUE(sees(1));
    ImGui::SetScrollY(const_cast<ImGuiWindow*>(&list()), 400);
    frames(4);
    EXPECT_FALSE(sees(1));
}

TEST_F(Messages, GoOutOfTheWayOfTheGizmo) {
    frames(3);
    EXPECT_FALSE(state_.toasts_on_top);
    editor_.chosen = "paw";
    frames(3);
    EXPECT_TRUE(state_.toasts_on_top);
    editor_.chosen.clear();
    frames(3);
    EXPECT_TRUE(state_.toasts_on_top) << "they do not jump back";
    state_.toasts.clear();
    frames(1);
    EXPECT_FALSE(state_.toasts_on_top) << "but the next ones are where they always are";
}

TEST_F(Messages, GoOutOfTheWayOfABand) {
    editor_.tools.band = {{100, 30}, {300, 150}};
    frames(3);
    EXPECT_FALSE(state_.toasts_on_top);
    editor_.tools.band.emplace_back(300, 440);
    frames(3);
    EXPECT_FALSE(state_.toasts_on_top) << "where it is everywhere there is nowhere to go";
    editor_.tools.band = {{300, 300}};
    frames(3);
    EXPECT_FALSE(state_.toasts_on_top);
    ImGui::GetIO().MousePos = {300, 440}; // where the next corner is to be
    frames(3);
    EXPECT_TRUE(state_.toasts_on_top);
}

} // namespace knead::test
