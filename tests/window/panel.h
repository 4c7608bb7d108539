#pragma once
// A panel without a window: Dear ImGui's frames, drawn by nobody, and a hand that is told to it.

#include "app/theme.h"

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <cfloat>

namespace knead::test {

inline const ImVec2 nowhere(-FLT_MAX, -FLT_MAX);

// One ImGui window that fills the display, or what is right of `left_`, drawn frame by frame.
class Panel : public ::testing::Test {
protected:
    void SetUp() override {
        context_ = ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.ConfigDragClickToInputText = true; // as in the window
        io.DisplaySize = {310, 700};
        io.MousePos = nowhere;
        for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = key;
        fonts_ = apply_theme(1);
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height); // no frame begins without
    }
    void TearDown() override { ImGui::DestroyContext(context_); }

    virtual void draw() = 0;

    void frame() {
        ImGui::GetIO().DeltaTime = 1.0f / 60;
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({left_, 0});
        ImGui::SetNextWindowSize({ImGui::GetIO().DisplaySize.x - left_, ImGui::GetIO().DisplaySize.y});
        ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoNav);
        draw();
        ImGui::End();
        ImGui::Render();
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) frame();
    }

    void click(ImVec2 at, bool ctrl = false) {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = at;
        io.KeyCtrl = ctrl;
        frame();
        io.MouseDown[0] = true;
        frame();
        io.MouseDown[0] = false;
        io.KeyCtrl = false;
        frames(2);
    }
    void press(ImGuiKey key) {
        ImGui::GetIO().KeysDown[key] = true;
        frame();
        ImGui::GetIO().KeysDown[key] = false;
        frames(2);
    }

    ImGuiContext* context_ = nullptr;
    Fonts fonts_;
    float left_ = 0;
};

} // namespace knead::test
