// The panel "Shape": how stiff the cloud is and how finely the deformation is computed.

#include "app/number_fields.h"
#include "app/ui.h"
#include "app/widgets.h"
#include "base/counts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace knead {

namespace {

// How long a slider has to rest until its value takes effect, in seconds.
constexpr double rest = 0.12;

void change(const Ui& ui, const SettingsChange& wanted) {
    SlidingSettings& sliding = ui.state.sliding;
    sliding.change = sliding.change ? merged(*sliding.change, wanted) : wanted;
    sliding.last_moved = ImGui::GetTime();
}

// Sends what was slid once the hand rests.
void send_rested(const Ui& ui) {
    const bool moves = ImGui::GetTime() - ui.state.sliding.last_moved < rest;
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left) || !moves) send_slid_settings(ui);
}

void stiffness_slider(const Ui& ui, const Settings& settings) {
    auto stiffness = static_cast<float>(settings.stiffness);
    if (bar_slider("Stiffness", stiffness, 1e-4f, 10.0f, "%.4g",
                   ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat |
                       ImGuiSliderFlags_AlwaysClamp)) {
        SettingsChange wanted;
        // Two digits are what a hand can mean; a session file then reads 0.013 and not 0.01298734. Typed are
        // as many as are shown.
        const double digits = ImGui::IsItemActive() ? 2 : 4;
        const double unit =
            std::pow(10.0, std::floor(std::log10(static_cast<double>(stiffness))) + 1 - digits);
        wanted.stiffness = std::max(1e-4, std::round(static_cast<double>(stiffness) / unit) * unit);
        change(ui, wanted);
    }
    explain(
        "How evenly turns spread through the cloud: little bends near the handles, much carries a turn far. "
        "α, a plain number; 0.01 suits most shapes.");
}

// Names for what a hand may want; the numbers are Poisson's ratios.
struct Material {
    const char* name;
    double poisson;
};
constexpr Material materials[] = {{"Auxetic", -0.7}, {"Cork", 0}, {"Rubber", 0.49}};

void material_choice(const Ui& ui, const Settings& settings) {
    auto poisson = static_cast<float>(settings.poisson);
    if (bar_slider("Elasticity", poisson, -0.9f, 0.49f, "%.2f", ImGuiSliderFlags_AlwaysClamp)) {
        SettingsChange wanted;
        wanted.poisson = std::round(static_cast<double>(poisson) * 100) / 100;
        change(ui, wanted);
    }
    explain(
        "Poisson's ratio: how much the cloud thins across for how much it is stretched along. 0.49 keeps the "
        "volume, 0 the width; below 0 it swells where it is pulled.");
    int chosen = -1;
    for (int m = 0; m < static_cast<int>(std::size(materials)); ++m)
        if (settings.poisson == materials[m].poisson) chosen = m;
    std::array<const char*, std::size(materials)> names;
    std::ranges::transform(materials, names.begin(), &Material::name);
    const int clicked = segmented("material", names, chosen);
    explain("Auxetic swells across where it is pulled (-0.7), cork keeps its width (0), rubber its volume "
            "(0.49)");
    if (clicked < 0 || clicked == chosen) return;
    SettingsChange wanted;
    wanted.poisson = materials[clicked].poisson;
    ui.tell(ChangeSettings{wanted});
}

// What was asked for, and what there are.
std::string sample_words(const DocumentView& document) {
    const auto& asked = document.settings.samples;
    const std::string used = grouped(document.samples);
    if (document.samples == 0) return "They are chosen once there is a handle to move.";
    if (!asked) return "All points: " + used + " used.";
    if (*asked == document.samples) return used + " asked and used.";
    return grouped(*asked) + " asked: " + used + " used, handle borders included.";
}

std::string words_about(const SampleChoice& choice) {
    return choice.samples ? counted(*choice.samples, "sample") : "Every point a sample";
}

// What decided an automatic number, in one line of the panel.
const char* reason_for(const SampleChoice& choice) {
    switch (choice.reason) {
    case SampleReason::few_points:
        return "There are no more points";
    case SampleReason::points:
        return "A good part of the points";
    case SampleReason::enough:
        return "More would hardly show";
    case SampleReason::handles:
        return "As many as the handles ask for";
    default:
        return "As many as this machine moves at once";
    }
}

void sample_choice(const Ui& ui, const Settings& settings) {
    const bool by_themselves = ui.editor.chooses_samples;
    constexpr int automatic = 0, by_hand = 1, all = 2;
    const int chosen = by_themselves ? automatic : settings.samples ? by_hand : all;
    const int clicked = segmented("samples", std::array{"Automatic", "By hand", "All"}, chosen);
    explain("Automatic: as many as show, as the handles ask for, and as this machine can move while it "
            "follows the hand. The number changes between edits only, never commits a pose, and is recorded. "
            "By hand: it stays. (Of these two the choice is remembered for the next cloud.) All: every point "
            "is a sample; exact, and slow on large clouds.");
    if (clicked < 0 || clicked == chosen) return;
    if (clicked != all && (clicked == automatic || settings.samples))
        return ui.wish(WishChooseSamples{clicked == automatic});
    SettingsChange wanted;
    wanted.samples = clicked == all ? std::optional<std::uint64_t>{} : std::optional(ui.state.some_samples);
    ui.tell(ChangeSettings{wanted});
}

void samples_slider(const Ui& ui, const Settings& settings) {
    ImGui::BeginDisabled(!settings.samples);
    ui.state.some_samples = settings.samples.value_or(ui.state.some_samples);
    const std::uint64_t used = std::max<std::uint64_t>(ui.editor.document->samples, 1);
    int samples = static_cast<int>(std::min<std::uint64_t>(settings.samples.value_or(used), 1'000'000'000));
    if (bar_slider("Samples", samples, 50, 20000, "%d", ImGuiSliderFlags_Logarithmic)) {
        SettingsChange wanted;
        const bool is_typed = !ImGui::IsItemActive(); // it may be any number; a hand means round ones
        const int step = samples < 1000 ? 50 : samples < 5000 ? 250 : 1000;
        wanted.samples = static_cast<std::uint64_t>(
            is_typed ? std::max(1, samples) : std::max(50, (samples + step / 2) / step * step));
        change(ui, wanted);
    }
    ImGui::EndDisabled();
    explain("At how many points the deformation is computed; all others follow. More are finer and slower: "
            "where the hand would have to wait for them, a few answer while it moves, and all as soon as it "
            "rests. "
            "Changing it while handles are posed commits the pose first.\n" +
            sample_words(*ui.editor.document) +
            " Up to a fifth more than asked for lie along the borders of the handles. Ctrl+click types any "
            "number.");
    sample_choice(ui, settings);
    if (!ui.editor.chooses_samples) return;
    const SampleChoice& suited = ui.editor.document->suited;
    const bool waits = suited.samples != settings.samples;
    // One line whatever it says: nothing below it is to jump.
    const char* const when =
        ui.editor.document->posed ? " from the next commit on" : " from the next edit on";
    faint_text(waits ? words_about(suited) + when : reason_for(suited));
}

void iterations_slider(const Ui& ui, const Settings& settings) {
    int iterations = static_cast<int>(settings.iterations);
    if (bar_slider("Iterations a frame", iterations, 0, 20, "%d")) {
        SettingsChange wanted;
        wanted.iterations = static_cast<unsigned>(std::clamp(iterations, 0, 1000));
        change(ui, wanted);
    }
    explain("How far the shape goes towards rest in each frame of a drag. Few follow the hand faster; the "
            "shape settles "
            "by itself when the hand rests.");
}

void weights_choice(const Ui& ui, const Settings& settings) {
    inline_caption("Weights", ui.scaled(92));
    const int chosen = settings.weights == InfluenceWeights::smooth ? 0 : 1;
    const int clicked = segmented("weights", std::array{"Smooth", "Paper"}, chosen);
    explain("How samples share out their influence on the points between them. Smooth: none at the farthest, "
            "so nothing "
            "jumps. Paper: one over the distance squared.");
    if (clicked < 0 || clicked == chosen) return;
    SettingsChange wanted;
    wanted.weights = clicked == 0 ? InfluenceWeights::smooth : InfluenceWeights::paper;
    ui.tell(ChangeSettings{wanted});
}

struct StraysWords {
    Strays strays;
    const char* name;
    const char* meaning;
};
constexpr StraysWords strays_words[] = {
    {Strays::freeze, "Stay", "Parts of the cloud that hold no handle stay where they are."},
    {Strays::carry, "Follow",
     "Each part that holds no handle follows the nearest that does, as one rigid piece."},
    {Strays::bridge, "Join",
     "Parts with no more than a few point spacings between them are one body: for scans that fall apart. "
     "What is too far away follows, as one rigid piece."},
};

void strays_choice(const Ui& ui, const Settings& settings) {
    inline_caption("Strays", ui.scaled(92));
    const auto* const chosen = std::ranges::find(strays_words, settings.strays, &StraysWords::strays);
    ImGui::SetNextItemWidth(-FLT_MIN);
    const bool open = ImGui::BeginCombo("##strays", chosen->name);
    if (!open) {
        explain(
            (std::string(chosen->meaning) + " Changing it while handles are posed commits the pose first.")
                .c_str());
        return;
    }
    for (const StraysWords& words : strays_words) {
        if (ImGui::Selectable(words.name, &words == chosen) && &words != chosen) {
            SettingsChange wanted;
            wanted.strays = words.strays;
            ui.tell(ChangeSettings{wanted});
        }
        explain(words.meaning);
    }
    ImGui::EndCombo();
}

// What is in parts, and what becomes of those that no handle holds.
void what_there_is(const Ui& ui) {
    const DocumentView& document = *ui.editor.document;
    std::string words;
    const std::size_t parts = document.components ? document.components->size.size() : 0;
    if (parts > 1) words = grouped(parts) + " connected parts";
    if (document.strays.parts > 0 && !document.handles.empty())
        words += (words.empty() ? "" : "\n") + counted(document.strays.parts, "part") + " (" +
                 counted(document.strays.points, "point") + ") without a handle: " +
                 (document.strays.fate == Strays::freeze ? "at rest" : "carried along");
    if (!words.empty()) faint_text(words);
}

} // namespace

void send_slid_settings(const Ui& ui) {
    if (const auto change = std::exchange(ui.state.sliding.change, std::nullopt))
        ui.tell(ChangeSettings{*change});
}

void shape_panel(const Ui& ui) {
    if (!ui.has_cloud()) {
        faint_text("How stiff the cloud is, and how finely it is computed.");
        return;
    }
    const DocumentView& document = *ui.editor.document;
    Settings settings = document.settings;
    if (ui.state.sliding.change) settings = changed(settings, *ui.state.sliding.change);
    stiffness_slider(ui, settings);
    material_choice(ui, settings);
    samples_slider(ui, settings);
    iterations_slider(ui, settings);
    weights_choice(ui, settings);
    strays_choice(ui, settings);
    what_there_is(ui);
    send_rested(ui);
}

} // namespace knead
