#pragma once
// What the window's panels share: what they may look at, what they remember between frames, and how they say
// what the user wants.
//
// A panel is a function that draws itself with Dear ImGui. It reads the editor, changes only its own part of
// UiState, and asks for everything else: by commands (edit/command.h), which the editor carries out, and by
// wishes, which the main loop does. Nothing happens in the middle of drawing.

#include "app/display.h"
#include "app/file_browser.h"
#include "app/handle_colors.h"
#include "app/label_dialog.h"
#include "app/number_fields.h"
#include "app/theme.h"
#include "app/timeline.h"
#include "edit/editor.h"
#include "edit/pose_numbers.h"

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace knead {

// --- What a panel can ask of the main loop ---

struct WishOpen { // asks about unsaved work first
    std::filesystem::path file;
    std::optional<std::filesystem::path> cloud = {}; // instead of the session's
    bool as_started = false; // what the program was started with: its settings are meant for it
};
struct WishUseCloud { // for the session that could not be opened without; asks like WishOpen
    std::filesystem::path cloud;
};
struct WishRestore {
    LostWork work;
};
struct WishDeleteLost {
    LostWork work;
};
struct WishCancelOpening {};
struct WishBrowse { // the file browser
    BrowseFor purpose = BrowseFor::open;
};
struct WishSaveSession {}; // where it was saved before, or asks where
struct WishSaveTo {        // asks before anything is overwritten
    BrowseFor purpose = BrowseFor::save_session;
    std::filesystem::path file;
    bool ask = true;
    ExportOptions options = {};  // of a cloud
    bool anyway = false;         // although somebody else changed it since it was read or written here
    bool keeps_original = false; // of the cloud that it takes the place of
};
struct WishDiscard {}; // the unsaved work; what it kept waiting comes now
struct WishDemonstration {
    bool posed = false; // the recorded session; else the creature at rest, to be posed
};
struct WishPress { // a key, as if the hand had pressed it
    KeyPress press;
};
struct WishSelectTool {
    SelectTool tool = SelectTool::lasso;
};
struct WishThrough {
    bool through = false;
};
struct WishMovePivot { // the gizmo's arrows move its pivot instead of the handle
    bool pivot = false;
};
struct WishLocalAxes {
    bool local = false;
};
struct WishOrbiting {
    Orbiting style = Orbiting::turntable;
};
struct WishUpAxis { // of the camera and the ground; remembered for clouds that do not tell theirs
    UpAxis up = UpAxis::z;
};
struct WishChooseSamples { // or leave their number alone; remembered for the next cloud
    bool by_themselves = false;
};
struct WishBrowseLabels {}; // the dialog that makes handles of an attribute
struct WishLabelHandles {
    std::string column;
    std::vector<LabelChoice> choices;
};
struct WishTakeHandles { // of a session
    std::filesystem::path session;
};
struct WishForgetRecent {};
struct WishClose {}; // the window; asks about unsaved work first

using Wish =
    std::variant<WishOpen, WishUseCloud, WishRestore, WishDeleteLost, WishCancelOpening, WishBrowse,
                 WishSaveSession, WishSaveTo, WishDiscard, WishDemonstration, WishPress, WishSelectTool,
                 WishThrough, WishMovePivot, WishLocalAxes, WishOrbiting, WishUpAxis, WishChooseSamples,
                 WishBrowseLabels, WishLabelHandles, WishTakeHandles, WishForgetRecent, WishClose>;

// --- What the panels remember ---

struct Rectangle { // in ImGui's coordinates
    float x = 0, y = 0, width = 0, height = 0;
};

// A message in the corner of the view.
struct Toast {
    Notice notice;
    double seconds_left = 0;
    float shown = 0; // 0 … 1, for fading in
};

// A setting that is being dragged: it takes effect when the hand rests for a moment, so that one drag is not
// fifty steps of undo.
struct SlidingSettings {
    std::optional<SettingsChange> change;
    double last_moved = 0; // ImGui's time
};

// The fields of the panel "Transform".
struct PoseFields {
    std::string handle; // whose they are
    NumberEditing editing;
    PoseRow typed_row = PoseRow::place; // of the field that is typed into
    int typed_axis = 0;
    std::optional<ChosenPose> base = {}; // of what is being slid, when that began
    bool slides_pivot = false;           // and not the handle
    Transform slid = {};                 // since then
    Vec3d turned = Vec3d::Zero();        // how the handle is turned, in the angles that were typed last
};

// How large is what is selected, or all, and of which marks and points that was measured.
struct ShownExtent {
    std::uint64_t marks_version = 0, frame_version = 0; // of the editor
    Box3 box = {};                                      // relative to the cloud's origin
};

// What the status line tells; measured by the main loop.
struct Measured {
    double frame = 0;    // seconds, smoothed, of frames that were drawn
    double solve = 0;    // of the newest frame's iterations
    double upsample = 0; // of its upsampling
    std::size_t drawn = 0, in_view = 0;
    bool complete = true;
};

// What to do once the user has said what becomes of the unsaved work.
struct AfterSaving {
    std::optional<Wish> then;                    // what replaces the document
    bool waiting_for_save = false;               // `then` comes when a save has succeeded
    bool save_was_posted = false;                // that save
    bool waiting_for_file = false;               // `then` comes when what is being written is there
    std::optional<std::uint64_t> discarded = {}; // the state (DocumentView) that need not be saved
};

// The keys in the menus of the bar.
struct MenuWalk {
    int open = -1;           // which menu of the bar is, in the last frame; -1: none
    bool at_submenu = false; // the arrows are at one that is closed
    int step = 0;            // in the next frame the next menu opens, or the one before (-1)
    bool stepped = false;    // by an arrow that is not let go yet
};

// What belongs to what is open: another document begins without it.
struct UiOfDocument {
    // Where it was to be exported last, and its session to be saved, whatever came of it; proposed again.
    std::filesystem::path last_export, last_session;
    std::filesystem::path last_picture;    // beside which the next one is proposed, under a name of its own
    std::optional<WishSaveTo> overwriting; // the dialog asks whether to overwrite this

    std::string row_at_rest; // of the list of handles: the one that was clicked, until the cursor leaves it
    HandleColors handle_colors;
    std::string recoloring; // the handle whose colours are to be shown; empty: none
    std::string renaming;   // the handle that is being renamed in the list; empty: none
    std::string name_text;  // what was typed so far
    bool renaming_begins = false;
    std::string listed_chosen; // the handle that the list was scrolled to last
    SlidingSettings sliding;
    PoseFields pose_fields;
    ShownExtent shown_extent;
    NumberEditing range_fields; // of the colours
    LabelDialog labels;
};

struct UiState : UiOfDocument {
    Fonts fonts;
    float scale = 1;
    Display display;
    Legend legend; // of the colours as they are
    Rectangle legend_place = {};
    FileBrowser browser;
    Measured measured;

    std::deque<Toast> toasts;
    float recovery_end = 0;     // the lower edge of the card that offers to restore; 0: there is none
    bool toasts_on_top = false; // in the upper corner of the view; else in the lower one
    float toasts_height = 0;    // of all in the last frame
    std::vector<std::filesystem::path> recent;
    std::vector<LostWork> lost;       // that was found at the start
    std::optional<LostWork> deleting; // the dialog asks whether to

    bool show_help = false;
    bool show_about = false;
    bool show_panels = true;
    float panel_width = 310; // of the panels at the right, on a display of scale 1; remembered
    std::optional<float> panel_grabbed = {}; // by the hand, so far from their edge; nothing: they are not
    MenuWalk menus;
    bool full_screen = false;          // asked for
    bool as_opened = false;            // the cloud is shown as it was before all edits, to compare
    bool ask_unsaved = false;          // the dialog is to be opened
    bool choose_samples = true;        // by themselves, of the next cloud; remembered
    std::uint64_t some_samples = 1000; // the number there was last, for after All
    AfterSaving after;
    std::optional<Editor::WithoutCloud> without_cloud; // which cloud it is to be opened with

    float list_height = 0; // of the list of handles in the last frame
    float beside_list = 0; // height of what the side panels hold beside the list of handles
    Playback playback;

    bool opening_demonstration = false; // which is then looked at from where the creature looks best
    double long_stage_since = 0;        // ImGui's time; of draw_opening()
    Rectangle long_stage = {};          // the card that tells of it; empty: none is shown

    Rectangle view;              // the part of the window that shows the cloud
    float pixel_ratio = 1;       // framebuffer pixels to one of ImGui's
    bool cursor_in_view = false; // over the cloud, and over no panel

    // What the menu at the cursor is about, where the right button opened it.
    struct ViewMenu {
        bool opens = false;
        std::string handle; // empty: what is selected, or the view
    } view_menu;
};

// What a panel is given.
struct Ui {
    const Editor& editor;
    UiState& state;
    std::vector<Command>& commands;
    std::vector<Wish>& wishes;

    void tell(Command command) const { commands.push_back(std::move(command)); }
    void wish(Wish wanted) const { wishes.push_back(std::move(wanted)); }
    float scaled(float distance) const { return distance * state.scale; }
    bool has_cloud() const { return editor.document != nullptr; }
};

// --- The panels, one file each ---

// Each draws itself at its place; the main loop calls them all once a frame.
void draw_menu_bar(const Ui& ui); // returns with its height known to ImGui
void draw_tool_column(const Ui& ui, Rectangle where);
void draw_side_panels(const Ui& ui, Rectangle where); // Handles, Transform, Shape, Display
void draw_timeline(const Ui& ui, Rectangle where);
void draw_status_line(const Ui& ui, Rectangle where);
void draw_overlay(const Ui& ui);   // gizmo, bands, names: over the cloud, under all panels
void draw_legend(const Ui& ui);    // of the colours
void draw_view_menu(const Ui& ui); // at the cursor
void draw_welcome(const Ui& ui);   // while nothing is open
void draw_opening(const Ui& ui);   // progress of opening and of other long stages
void draw_recovery(const Ui& ui);  // work that a crash left
void draw_toasts(const Ui& ui);
void draw_help(const Ui& ui);
void draw_about(const Ui& ui);
void draw_file_browser(const Ui& ui);
void draw_label_dialog(const Ui& ui);
void draw_dialogs(const Ui& ui); // unsaved work, overwriting

// Parts of the side panels.
void handles_panel(const Ui& ui);
void transform_panel(const Ui& ui);
void shape_panel(const Ui& ui);
// What is being slid there counts now, if anything is: the hand goes elsewhere.
void send_slid_settings(const Ui& ui);
void display_panel(const Ui& ui);
void coloring_menu(const Ui& ui); // the same choice of colours, in a menu

// What is said of the shape of a document holds no longer once another one is opened.
void forget_shape(std::deque<Toast>& toasts);

// Puts a notice among the toasts.
void add_toast(UiState& state, Notice notice);

} // namespace knead
