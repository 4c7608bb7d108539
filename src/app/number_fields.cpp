#include "app/number_fields.h"

#include "app/theme.h"
#include "app/widgets.h"
#include "base/arithmetic.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string_view>
#include <type_traits>

namespace knead {

std::string format_between(double low, double high) {
    const double width = std::max(high - low, 1e-300), largest = std::max(std::abs(low), std::abs(high));
    const double decimals = std::ceil(2 - std::log10(width));
    const double digits = std::ceil(std::log10(std::max(largest, width))) + decimals;
    if (decimals <= 7 && largest < 1e9)
        return "%." + std::to_string(std::max(0, static_cast<int>(decimals))) + "f";
    return "%." + std::to_string(static_cast<int>(std::clamp(digits, 3.0, 15.0))) + "g";
}

void take_decimal_commas(ImGuiID field) {
    if (ImGui::GetActiveID() != field) return;
    for (ImWchar& character : ImGui::GetIO().InputQueueCharacters)
        if (character == ',') character = '.';
}

namespace {

// --- The key Tab: what was typed is taken, and the next number, or the one before, is typed into ---
//
// ImGui would do that only where its keys walk through the whole panel.

// What a panel keeps for it between two fields and two frames: fields, or 0.
class TabPlaces {
public:
    explicit TabPlaces(const void* ring) : ring_(ImHashData(&ring, sizeof ring)) {}
    ImGuiID last() const { return get("number laid out last"); }
    ImGuiID from() const { return is_fresh() ? get("number left by Tab") : 0; } // whose next one it leads to
    ImGuiID to() const { return is_fresh() ? get("number that Tab leads back to") : 0; }
    void set_last(ImGuiID field) { set("number laid out last", field); }
    void leave(ImGuiID from, ImGuiID to) {
        set("number left by Tab", from);
        set("number that Tab leads back to", to);
        set("when a number was left", static_cast<ImGuiID>(ImGui::GetFrameCount()));
    }

private:
    // Where the fields are gone in the next picture, Tab leads nowhere.
    bool is_fresh() const {
        return static_cast<ImGuiID>(ImGui::GetFrameCount()) <= get("when a number was left") + 1;
    }
    ImGuiID key(const char* name) const { return ImHashStr(name, 0, ring_); }
    ImGuiID get(const char* name) const { return static_cast<ImGuiID>(storage_.GetInt(key(name))); }
    void set(const char* name, ImGuiID field) { storage_.SetInt(key(name), static_cast<int>(field)); }

    ImGuiID ring_;
    ImGuiStorage& storage_ = *ImGui::GetStateStorage();
};

// Call it before a field is laid out. Tab stays among the fields that name the same ring; of those without
// one, the sliders, in their panel.
void arrive_by_tab(ImGuiID field, const void* ring = nullptr) {
    if (is_disabled()) return;
    TabPlaces places(ring);
    const ImGuiID before = places.last();
    places.set_last(field);
    if (places.to() == field || (places.from() != 0 && places.from() == before)) {
        ImGui::SetKeyboardFocusHere();
        places.leave(0, 0);
    }
    if (!ImGui::TempInputIsActive(field) || !ImGui::IsKeyPressedMap(ImGuiKey_Tab)) return;
    if (ImGui::GetIO().KeyShift)
        places.leave(0, before);
    else
        places.leave(field, 0);
}

// And after it, if it is typed into.
void leave_by_tab() {
    if (ImGui::IsKeyPressedMap(ImGuiKey_Tab)) ImGui::ClearActiveID();
}

// --- Sliders ---

// Draws the bar and its words over a slider that has just been laid out without any.
void draw_bar(const char* name, const char* value, float filled) {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImGuiStyle& style = ImGui::GetStyle();
    const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
    list.AddRectFilled(low, high, with_alpha(lit ? palette::field_hovered : palette::field, style.Alpha),
                       style.FrameRounding);
    const float x = low.x + std::clamp(filled, 0.0f, 1.0f) * (high.x - low.x);
    list.PushClipRect(low, {x, high.y}, true);
    list.AddRectFilled(low, high, with_alpha(palette::accent, style.Alpha * (lit ? 0.52f : 0.42f)),
                       style.FrameRounding);
    list.PopClipRect();
    list.AddLine({x, low.y}, {x, high.y}, with_alpha(palette::accent, style.Alpha), 2);
    const float y = low.y + style.FramePadding.y;
    const ImU32 ink = with_alpha(palette::text, style.Alpha);
    list.AddText({low.x + style.FramePadding.x, y}, ink, name);
    list.AddText({high.x - style.FramePadding.x - ImGui::CalcTextSize(value).x, y}, ink, value);
}

bool bar_slider_of(const char* name, ImGuiDataType type, void* value, const void* lowest, const void* highest,
                   const char* format, int flags) {
    // While a number is typed it is an ordinary field.
    const std::string id = std::string("##") + name;
    const bool typed = ImGui::TempInputIsActive(ImGui::GetID(id.c_str()));
    if (typed && type == ImGuiDataType_Float) take_decimal_commas(ImGui::GetID(id.c_str()));
    if (!typed)
        for (const ImGuiCol hidden : {ImGuiCol_Text, ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive,
                                      ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive})
            ImGui::PushStyleColor(hidden, ImU32{0});
    arrive_by_tab(ImGui::GetID(id.c_str()));
    // The grab has no width of its own to speak of: the bar ends where the cursor is.
    ImGui::PushStyleVar(ImGuiStyleVar_GrabMinSize, 1.0f);
    const bool changed = ImGui::SliderScalar(id.c_str(), type, value, lowest, highest, format, flags);
    ImGui::PopStyleVar();
    if (!typed) ImGui::PopStyleColor(6);
    return changed;
}

float share(double value, double lowest, double highest, bool logarithmic) {
    if (logarithmic) return static_cast<float>(std::log(value / lowest) / std::log(highest / lowest));
    return static_cast<float>((value - lowest) / (highest - lowest));
}

template<typename Number>
std::string as_words(const char* format, Number value) {
    char words[48];
    std::snprintf(words, sizeof words, format, value);
    return words;
}

// The number, or sum, that stands in the field that is typed into, be there a unit behind it; nothing where
// it is none, or the text is the one that stood there at first.
std::optional<double> typed_number() {
    const ImGuiInputTextState& field = ImGui::GetCurrentContext()->InputTextState;
    std::string text(4 * static_cast<std::size_t>(field.CurLenW) + 1, 0);
    text.resize(static_cast<std::size_t>(ImTextStrToUtf8(
        text.data(), static_cast<int>(text.size()), field.TextW.Data, field.TextW.Data + field.CurLenW)));
    if (text == field.InitialTextA.Data) return std::nullopt;
    text.resize(std::strlen(text.c_str()));
    const std::optional<Sum> sum = sum_of(text);
    const bool is_one = sum && sum->rest.find_first_of("0123456789.,+-*/") == std::string_view::npos;
    return is_one ? std::optional(sum->value) : std::nullopt;
}

// Esc puts the text back.
std::optional<double> number_not_given_up() {
    return ImGui::IsKeyPressedMap(ImGuiKey_Escape) ? std::nullopt : typed_number();
}

// Of a slider, where what is typed may not go beyond them.
template<typename Number>
struct Limits {
    Number lowest, highest;
    bool hold;

    Number clamped(double number) const {
        const double least = hold ? static_cast<double>(lowest) : -1e9,
                     most = hold ? static_cast<double>(highest) : 1e9;
        number = std::clamp(number, least, most);
        return static_cast<Number>(std::is_integral_v<Number> ? std::round(number) : number);
    }
};

// What is being typed into a slider counts once it is done, and not at all if it is given up (Esc puts the
// text back) or no number. Returns whether `value` became what was typed.
template<typename Number>
bool take_typed(const char* id, bool is_typed, Number before, const Limits<Number>& limits,
                const char* format, Number& value) {
    ImGuiStorage& storage = *ImGui::GetStateStorage();
    const ImGuiID typing = ImGui::GetID((std::string(id) + " typing").c_str());
    const ImGuiID typed = ImGui::GetID((std::string(id) + " typed").c_str());
    const bool was_typed = storage.GetBool(typing, false);
    storage.SetBool(typing, is_typed);
    if (is_typed) {
        const std::optional<double> number = number_not_given_up();
        storage.SetFloat(typed, static_cast<float>(number ? limits.clamped(*number) : before));
        value = before;
        return false;
    }
    if (!was_typed) return false;
    const auto wanted = static_cast<Number>(storage.GetFloat(typed));
    if (as_words(format, wanted) == as_words(format, before)) return false;
    value = wanted;
    return true;
}

// What is typed beyond the ends of a slider is not what it becomes.
template<typename Number>
void tell_limits(Number lowest, Number highest, const char* format) {
    const std::optional<double> typed = typed_number();
    if (!typed || (*typed >= static_cast<double>(lowest) && *typed <= static_cast<double>(highest))) return;
    const ImVec2 corner = ImGui::GetItemRectMin();
    ImGui::SetNextWindowPos({corner.x, ImGui::GetItemRectMax().y + ImGui::GetStyle().ItemSpacing.y});
    ImGui::BeginTooltip();
    const Number end = *typed < static_cast<double>(lowest) ? lowest : highest;
    ImGui::Text("From %s to %s; this becomes %s", as_words(format, lowest).c_str(),
                as_words(format, highest).c_str(), as_words(format, end).c_str());
    ImGui::EndTooltip();
}

template<typename Number>
bool slide(const char* name, ImGuiDataType type, Number& value, Number lowest, Number highest,
           const char* format, int flags) {
    const std::string id = std::string("##") + name;
    const bool typed = ImGui::TempInputIsActive(ImGui::GetID(id.c_str()));
    const Number before = value;
    const bool slid = bar_slider_of(name, type, &value, &lowest, &highest, format, flags);
    const bool holds = (flags & ImGuiSliderFlags_AlwaysClamp) != 0;
    const bool changed =
        take_typed(id.c_str(), typed, before, Limits<Number>{lowest, highest, holds}, format, value) ||
        (slid && !typed);
    if (typed && holds) tell_limits(lowest, highest, format);
    if (typed) leave_by_tab();
    if (typed) return false;
    const std::string words = as_words(format, value);
    const bool logarithmic = (flags & ImGuiSliderFlags_Logarithmic) != 0;
    draw_bar(name, words.c_str(),
             share(static_cast<double>(value), static_cast<double>(lowest), static_cast<double>(highest),
                   logarithmic));
    return changed;
}

} // namespace

bool bar_slider(const char* name, float& value, float lowest, float highest, const char* format, int flags) {
    return slide(name, ImGuiDataType_Float, value, lowest, highest, format, flags);
}

bool bar_slider(const char* name, int& value, int lowest, int highest, const char* format, int flags) {
    return slide(name, ImGuiDataType_S32, value, lowest, highest, format, flags);
}

bool types_into_field() {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    return context.ActiveId != 0 && ImGui::TempInputIsActive(context.ActiveId);
}

bool tab_may_lead_to_field() {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    return context.NavMoveSubmitted && (context.NavMoveFlags & ImGuiNavMoveFlags_Tabbing) != 0;
}

NumberEdit number_field(const char* id, double& value, double speed, const char* format,
                        NumberEditing& editing, double lowest) {
    const ImGuiID field = ImGui::GetID(id);
    const bool types = ImGui::TempInputIsActive(field);
    if (types) take_decimal_commas(field);
    const int frame = ImGui::GetFrameCount();
    if (editing.frame + 1 < frame) editing.field = 0;
    const bool was_edited = editing.field == field;
    double number = was_edited && !editing.types ? editing.number : value;
    const std::string shown = as_words(format, number);
    if (!was_edited && shown.find_first_of("123456789") == std::string::npos) number = 0; // not "-0.000"
    arrive_by_tab(field, &editing);
    const bool slid = ImGui::DragScalar(id, ImGuiDataType_Double, &number, static_cast<float>(speed), &lowest,
                                        nullptr, format);
    if (types) {
        const std::optional<double> typed = number_not_given_up();
        editing = {field, typed.value_or(value), true, typed.has_value(), false, frame};
        leave_by_tab();
        return NumberEdit::none;
    }
    if (was_edited && editing.types) {
        editing.field = 0;
        if (!editing.is_another) return NumberEdit::none;
        value = editing.number;
        return NumberEdit::typed;
    }
    if (was_edited && editing.gives_up) {
        ImGui::ClearActiveID();
        editing.field = 0;
        return NumberEdit::given_up;
    }
    if (was_edited && !ImGui::IsItemActive()) {
        editing.field = 0;
        return NumberEdit::slid;
    }
    if (was_edited) editing.frame = frame;
    if (!slid) return NumberEdit::none;
    editing = {field, number, false, false, false, frame};
    value = number;
    return NumberEdit::slides;
}

} // namespace knead
