#pragma once
// Sliders and fields for numbers. From one that is typed into Tab leads to the next, and Shift+Tab to the one
// before: of the sliders, or of the fields with the same NumberEditing.

#include <imgui.h>

#include <cfloat>
#include <string>

namespace knead {

// A slider that is a bar with its name and value in it. Ctrl+click types a number. `format` is printf's;
// `flags` are ImGuiSliderFlags.
bool bar_slider(const char* name, float& value, float lowest, float highest, const char* format,
                int flags = 0);
bool bar_slider(const char* name, int& value, int lowest, int highest, const char* format, int flags = 0);

// What the hand does with a field for a number. One field at a time.
struct NumberEditing {
    ImGuiID field = 0;       // 0: none
    double number = 0;       // so far
    bool types = false;      // else it slides
    bool is_another = false; // what is typed is a number, and other than at first
    bool gives_up = false;   // what it slid is to be as before: set it from outside
    int frame = 0;           // of ImGui's, in which that was so; what is older is forgotten
};
enum class NumberEdit {
    none,
    slides,   // begins to, or goes on: `value` is what it is now
    slid,     // has let go
    typed,    // `value` is what was typed, by Enter, Tab or a click elsewhere
    given_up, // what was slid; what was typed and given up (Esc) never was
};
// A field that shows a number, which is slid to the left and right, by `speed` for each pixel and no farther
// down than to `lowest`, or clicked and typed.
NumberEdit number_field(const char* id, double& value, double speed, const char* format,
                        NumberEditing& editing, double lowest = -FLT_MAX);

// Whether a number is being typed: keys are meant for it.
bool types_into_field();
// Whether Tab was pressed and may have led to a field, which the next picture tells.
bool tab_may_lead_to_field();

// A printf format with as many digits as tell numbers between the two apart.
std::string format_between(double low, double high);

// A comma that is being typed into a field for a number becomes its point, as on the keypads of half the
// world. Call it before the field is laid out; bar_slider() does for numbers that are not whole.
void take_decimal_commas(ImGuiID field);

} // namespace knead
