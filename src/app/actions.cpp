#include "app/actions.h"

#include "app/widgets.h"
#include "base/require.h"

#include <array>

namespace knead {

namespace {

// --- What must be the case ---

bool always(const Ui&) {
    return true;
}
bool cloud_is_open(const Ui& ui) {
    return ui.has_cloud();
}
bool something_is_selected(const Ui& ui) {
    return ui.has_cloud() && ui.editor.selected > 0;
}
bool something_is_hidden(const Ui& ui) {
    return ui.has_cloud() && ui.editor.hidden > 0;
}
bool handle_is_chosen(const Ui& ui) {
    return ui.has_cloud() && chosen_handle(ui.editor);
}
bool handle_or_selection_is_there(const Ui& ui) {
    return handle_is_chosen(ui) || something_is_selected(ui);
}
bool handle_can_be_named(const Ui& ui) {
    return ui.has_cloud() && handle_to_name(ui.editor);
}
bool handle_and_selection_are_there(const Ui& ui) {
    return handle_is_chosen(ui) && ui.editor.selected > 0;
}
bool moving_handle_is_chosen(const Ui& ui) {
    if (!ui.has_cloud()) return false;
    const Handle* handle = chosen_handle(ui.editor);
    return handle && handle->role == HandleRole::moving;
}
bool moving_handle_and_selection_are_there(const Ui& ui) {
    return moving_handle_is_chosen(ui) && ui.editor.selected > 0;
}
bool something_is_posed(const Ui& ui) {
    return ui.has_cloud() && ui.editor.document->posed;
}
bool something_was_done(const Ui& ui) {
    return ui.state.as_opened ||
           (ui.has_cloud() && (something_is_posed(ui) || ui.editor.document->undoable_steps > 0));
}
bool samples_are_there(const Ui& ui) {
    return ui.has_cloud() && ui.editor.document->sample_vertices != nullptr;
}
bool handles_are_there(const Ui& ui) {
    return ui.has_cloud() && !ui.editor.document->handles.empty();
}
bool undo_is_possible(const Ui& ui) {
    return ui.has_cloud() && can_undo(ui.editor);
}
bool redo_is_possible(const Ui& ui) {
    return ui.has_cloud() && can_redo(ui.editor);
}

bool document_has_steps(const Ui& ui) {
    return ui.has_cloud() && playback_steps(ui.editor) > 0;
}

// --- Short ways to say what an action does ---

template<BrowseFor purpose>
void browse(const Ui& ui) {
    ui.wish(WishBrowse{purpose});
}
template<SelectionStep step>
void select(const Ui& ui) {
    ui.tell(ChangeSelection{step});
}
template<HideStep step>
void hide(const Ui& ui) {
    ui.tell(ChangeHidden{step});
}
template<HandleRole role>
void make_handle(const Ui& ui) {
    ui.tell(MakeHandle{role, {}});
}
template<SelectMode mode>
void assign_points(const Ui& ui) {
    ui.tell(AssignPoints{ui.editor.chosen, mode});
}
template<int axis>
void mirror(const Ui& ui) {
    ui.tell(MirrorHandle{ui.editor.chosen, axis});
}
template<PosePart part>
void take_back(const Ui& ui) {
    ui.tell(TakeBackPart{moved_with(ui.editor, ui.editor.chosen), part});
}
bool chosen_is_posed(const Ui& ui) {
    return moving_handle_is_chosen(ui) && something_is_posed(ui);
}
template<int axis>
bool moves_are_mirrored(const Ui& ui) {
    return ui.has_cloud() && ui.editor.symmetry && ui.editor.symmetry->axis == axis;
}
template<int axis>
void mirror_moves(const Ui& ui) {
    const bool are_so = moves_are_mirrored<axis>(ui);
    ui.tell(MirrorMoves{are_so ? std::nullopt : std::optional(axis)});
}
template<SelectTool tool>
void choose_tool(const Ui& ui) {
    ui.wish(WishSelectTool{tool});
}
template<SelectTool tool>
bool tool_is_chosen(const Ui& ui) {
    return ui.editor.tools.select == tool;
}
template<char letter>
void press(const Ui& ui) {
    ui.wish(WishPress{{key(letter), {}, false}});
}
template<Side side>
void look_from(const Ui& ui) {
    ui.tell(LookAtSide{side});
}
template<bool Display::*flag>
void toggle(const Ui& ui) {
    ui.state.display.*flag = !(ui.state.display.*flag);
}
template<bool Display::*flag>
bool is_on(const Ui& ui) {
    return ui.state.display.*flag;
}
template<bool PointLook::*flag>
void toggle_look(const Ui& ui) {
    ui.state.display.look.*flag = !(ui.state.display.look.*flag);
}
template<bool PointLook::*flag>
bool look_is_on(const Ui& ui) {
    return ui.state.display.look.*flag;
}
template<Orbiting style>
void orbit_by(const Ui& ui) {
    ui.wish(WishOrbiting{style});
}
template<Orbiting style>
bool orbits_by(const Ui& ui) {
    return ui.editor.tools.orbiting == style;
}

template<UpAxis axis>
void turn_up(const Ui& ui) {
    ui.wish(WishUpAxis{axis});
}
template<UpAxis axis>
bool is_up(const Ui& ui) {
    return ui.editor.camera.up == axis;
}

template<int direction>
void choose_next_handle(const Ui& ui) {
    const std::vector<Handle>& handles = ui.editor.document->handles;
    if (handles.empty()) return;
    const std::vector<std::size_t> order = order_of_list(handles);
    const int count = static_cast<int>(order.size());
    int at = direction > 0 ? -1 : 0;
    for (int i = 0; i < count; ++i)
        if (handles[order[static_cast<std::size_t>(i)]].name == ui.editor.chosen) at = i;
    ui.tell(ChooseHandle{handles[order[static_cast<std::size_t>((at + direction + count) % count)]].name});
}

void delete_handle(const Ui& ui) {
    if (handle_is_chosen(ui)) return ui.tell(DeleteHandles{chosen_with(ui.editor, ui.editor.chosen)});
    add_toast(ui.state, {Notice::Kind::information,
                         "No point is ever deleted, and no handle is chosen. V hides what is selected."});
}

void name_handle(const Ui& ui) {
    ui.state.renaming = ui.state.name_text = handle_to_name(ui.editor)->name;
    ui.state.renaming_begins = true;
    ui.state.show_panels = true; // the name is typed there
}

template<int direction>
void resize_points(const Ui& ui) {
    resize_points_by(ui.state.display, direction > 0 ? 1.15f : 1 / 1.15f);
}

void toggle_orthographic(const Ui& ui) {
    Camera camera = ui.editor.camera;
    camera.orthographic = !camera.orthographic;
    ui.tell(MoveCamera{camera});
}

// --- The table ---

constexpr Modifiers plain{};
constexpr Modifiers shift{true, false, false};
constexpr Modifiers ctrl{false, true, false};
constexpr Modifiers alt{false, false, true};
constexpr Modifiers ctrl_shift{true, true, false};
constexpr Modifiers ctrl_alt{false, true, true};
constexpr Modifiers alt_shift{true, false, true};

// The shortcut of what the tools do at a key of theirs (edit/tools_keys.cpp), which they take before anybody
// asks here.
constexpr std::nullopt_t of_tools = std::nullopt;

constexpr Shortcut on(char letter, Modifiers held = plain) {
    return {key(letter), held};
}
constexpr Shortcut on(Key which, Modifiers held = plain) {
    return {which, held};
}
constexpr Shortcut repeating(Shortcut shortcut) {
    shortcut.repeats = true;
    return shortcut;
}

const Action file_actions[] = {
    {"File", "Open…", "Ctrl+O", "Opens a cloud or a recorded session", on('O', ctrl), browse<BrowseFor::open>,
     always},
    {"File", "Save session", "Ctrl+S",
     "Saves everything done so far as a session file, to go on with or to replay", on('S', ctrl),
     [](const Ui& ui) { ui.wish(WishSaveSession{}); }, cloud_is_open, nullptr, true},
    {"File", "Save session as…", "Ctrl+Shift+S", "Saves the session under another name", on('S', ctrl_shift),
     browse<BrowseFor::save_session>, cloud_is_open},
    {"File", "Export cloud…", "Ctrl+E", "Saves the points as they are now, with every attribute of the file",
     on('E', ctrl), browse<BrowseFor::save_cloud>, cloud_is_open},
    {"File", "Save picture…", "",
     "Saves what the view shows as a PNG of twice its size: the cloud without gizmo, names and panels",
     std::nullopt, browse<BrowseFor::save_picture>, cloud_is_open},
    {"File", "Demonstration", "", "Opens a creature whose handles are already posed", std::nullopt,
     [](const Ui& ui) { ui.wish(WishDemonstration{true}); }, always, nullptr, true},
    {"File", "Creature to pose", "", "Opens the same creature at rest", std::nullopt,
     [](const Ui& ui) { ui.wish(WishDemonstration{false}); }, always},
    {"File", "Quit", "Ctrl+Q", "Closes the window; asks if something is not saved", on('Q', ctrl),
     [](const Ui& ui) { ui.wish(WishClose{}); }, always, nullptr, true},
};

const Action edit_actions[] = {
    {"Edit", "Undo", "Ctrl+Z", "Takes the last step back", of_tools,
     [](const Ui& ui) { ui.tell(UndoStep{}); }, undo_is_possible, nullptr, false,
     [](const Ui& ui) { return words_of_undo(ui.editor); }},
    {"Edit", "Redo", "Ctrl+Shift+Z", "Does the step taken back again (also Ctrl+Y)", of_tools,
     [](const Ui& ui) { ui.tell(RedoStep{}); }, redo_is_possible, nullptr, false,
     [](const Ui& ui) { return words_of_redo(ui.editor); }},
    {"Edit", "Commit the pose", "Enter", "Makes the shape as it is now the new rest shape", of_tools,
     [](const Ui& ui) { ui.tell(CommitPose{}); }, something_is_posed, nullptr, true},
};

const Action select_actions[] = {
    {"Select", "All", "A", "Selects every point that is shown", of_tools, select<SelectionStep::all>,
     cloud_is_open},
    {"Select", "None", "Alt+A", "Selects nothing", of_tools, select<SelectionStep::none>,
     something_is_selected},
    {"Select", "Invert", "Ctrl+I", "Selects what is not selected", of_tools, select<SelectionStep::invert>,
     cloud_is_open},
    {"Select", "Grow", "Ctrl++", "Adds the neighbours of the selected points", of_tools,
     select<SelectionStep::grow>, something_is_selected, nullptr, true},
    {"Select", "Shrink", "Ctrl+-", "Takes away points at the border of the selection", of_tools,
     select<SelectionStep::shrink>, something_is_selected},
    {"Select", "Connected part", "L", "Adds all that hangs together with the selected points", of_tools,
     select<SelectionStep::connected>, something_is_selected},
    {"Select", "Outliers", "",
     "Selects the points that lie off the surface by themselves, as scanners leave them: what follows their "
     "surface without pulling at it",
     std::nullopt, select<SelectionStep::outliers>, cloud_is_open},
    {"Select", "Hide the selection", "V", "Hides the selected points; hidden points cannot be selected",
     of_tools, hide<HideStep::hide_selected>, something_is_selected, nullptr, true},
    {"Select", "Hide the rest", "Shift+V", "Hides what is not selected", of_tools,
     hide<HideStep::hide_unselected>, something_is_selected},
    {"Select", "Show all", "Alt+V", "Shows hidden points again", of_tools, hide<HideStep::show_all>,
     something_is_hidden},
    {"Select/Tool", "Click", "C", "Selects the point under the cursor", of_tools,
     choose_tool<SelectTool::click>, cloud_is_open, tool_is_chosen<SelectTool::click>, true},
    {"Select/Tool", "Box", "B", "Selects what lies in a rectangle", of_tools, choose_tool<SelectTool::box>,
     cloud_is_open, tool_is_chosen<SelectTool::box>},
    {"Select/Tool", "Lasso", "Q", "Selects what you draw a line around", of_tools,
     choose_tool<SelectTool::lasso>, cloud_is_open, tool_is_chosen<SelectTool::lasso>},
    {"Select/Tool", "Polygon", "P",
     "Selects what lies between corners that you click; Enter or a double click closes", of_tools,
     choose_tool<SelectTool::polygon>, cloud_is_open, tool_is_chosen<SelectTool::polygon>},
    {"Select/Tool", "Brush", "K", "Paints the selection; [ and ] change its size", of_tools,
     choose_tool<SelectTool::brush>, cloud_is_open, tool_is_chosen<SelectTool::brush>},
    {"Select", "Through", "T", "Also selects what lies behind the visible surface", of_tools,
     [](const Ui& ui) { ui.wish(WishThrough{!ui.editor.tools.through}); }, cloud_is_open,
     [](const Ui& ui) { return ui.editor.tools.through; }},
};

const Action handle_actions[] = {
    {"Handles", "Moving handle", "H", "Makes the selection a handle that you can move, turn and scale",
     of_tools, make_handle<HandleRole::moving>, something_is_selected},
    {"Handles", "Fixed handle", "Shift+H", "Makes the selection a handle that stays where it is", of_tools,
     make_handle<HandleRole::fixed>, something_is_selected},
    {"Handles", "Region of interest", "Ctrl+H", "Only the selection may deform; everything else stays",
     of_tools, make_handle<HandleRole::region_of_interest>, something_is_selected},
    {"Handles", "From an attribute…", "", "Makes handles of an attribute that labels the points of the file",
     std::nullopt, [](const Ui& ui) { ui.wish(WishBrowseLabels{}); }, cloud_is_open, nullptr, true},
    {"Handles", "From a session…", "", "Makes the handles that another session has, on this cloud",
     std::nullopt, browse<BrowseFor::take_handles>, cloud_is_open},
    {"Handles", "Move", "G", "Moves the chosen handle with the cursor; X, Y or Z keeps to an axis", of_tools,
     press<'G'>, moving_handle_is_chosen, nullptr, true},
    {"Handles", "Rotate", "R", "Turns the chosen handle with the cursor; type degrees for an exact turn",
     of_tools, press<'R'>, moving_handle_is_chosen},
    {"Handles", "Scale", "S", "Scales the chosen handle with the cursor", of_tools, press<'S'>,
     moving_handle_is_chosen},
    {"Handles", "Local axes", ",", "The gizmo's axes turn with the handle", on(','),
     [](const Ui& ui) { ui.wish(WishLocalAxes{!ui.editor.local_axes}); }, cloud_is_open,
     [](const Ui& ui) { return ui.editor.local_axes; }, true},
    {"Handles", "Move the pivot", ".",
     "Moves the point that the handle turns about, and not the handle: a click puts it inside of what is "
     "there; the gizmo's arrows and G move it",
     on('.'), [](const Ui& ui) { ui.wish(WishMovePivot{!ui.editor.tools.move_pivot}); },
     moving_handle_is_chosen, [](const Ui& ui) { return ui.editor.tools.move_pivot; }},
    {"Handles", "Pivot to the middle", "Alt+.", "Puts the pivot into the middle of the handle", on('.', alt),
     [](const Ui& ui) { ui.tell(SetPivot{}); }, moving_handle_is_chosen},
    {"Handles", "Pivot to the selection", "Ctrl+.", "Puts the pivot into the middle of the selected points",
     on('.', ctrl), [](const Ui& ui) { ui.tell(SetPivotToSelection{}); },
     moving_handle_and_selection_are_there},
    {"Handles", "Next handle", "Tab", "Chooses the next handle of the list", on(Key::tab),
     choose_next_handle<1>, handles_are_there, nullptr, true},
    {"Handles", "Previous handle", "Shift+Tab", "Chooses the handle before it", on(Key::tab, shift),
     choose_next_handle<-1>, handles_are_there},
    {"Handles/Its points", "Select its points", "Shift+L", "Selects the points of the chosen handle",
     on('L', shift),
     [](const Ui& ui) {
         ui.tell(SelectHandlePoints{ui.editor.chosen, SelectMode::replace});
     },
     handle_is_chosen},
    {"Handles/Its points", "Add the selection to it", "Ctrl+Shift+H",
     "The chosen handle holds the selected points, too", on('H', ctrl_shift), assign_points<SelectMode::add>,
     handle_and_selection_are_there},
    {"Handles/Its points", "Take the selection from it", "Ctrl+Alt+H",
     "The chosen handle lets go of the selected points", on('H', ctrl_alt), assign_points<SelectMode::remove>,
     handle_and_selection_are_there},
    {"Handles/Its points", "Hold the selection instead", "",
     "The chosen handle holds the selected points and no others", std::nullopt,
     assign_points<SelectMode::replace>, handle_and_selection_are_there},
    {"Handles", "Rename", "F2", "Gives the handle that was just made, or else the chosen one, another name",
     on(Key::f2), name_handle, handle_can_be_named},
    {"Handles", "Reset its pose", "Alt+Shift+R",
     "Puts what is chosen back where it was at rest, with what goes along", on('R', alt_shift),
     [](const Ui& ui) { ui.tell(ResetPoses{moved_with(ui.editor, ui.editor.chosen)}); }, chosen_is_posed},
    {"Handles", "Take its move back", "Alt+G",
     "Puts the chosen handle's pivot back where it was at rest, and what goes along; turn and size stay",
     on('G', alt), take_back<PosePart::move>, chosen_is_posed},
    {"Handles", "Take its turn back", "Alt+R",
     "Unwinds the chosen handle about its pivot, and what goes along; place and size stay", on('R', alt),
     take_back<PosePart::turn>, chosen_is_posed},
    {"Handles", "Take its scaling back", "Alt+S",
     "Makes the chosen handle as large as it was at rest, and what goes along; place and turn stay",
     on('S', alt), take_back<PosePart::scaling>, chosen_is_posed},
    {"Handles/Mirror", "Along X", "", "Makes the same handle, mirrored, on the other side along x",
     std::nullopt, mirror<0>, handle_is_chosen},
    {"Handles/Mirror", "Along Y", "", "Makes the same handle, mirrored, on the other side along y",
     std::nullopt, mirror<1>, handle_is_chosen},
    {"Handles/Mirror", "Along Z", "", "Makes the same handle, mirrored, on the other side along z",
     std::nullopt, mirror<2>, handle_is_chosen},
    {"Handles/Both sides", "Across X", "",
     "What is moved moves its counterpart on the other side along x, too, mirrored", std::nullopt,
     mirror_moves<0>, cloud_is_open, moves_are_mirrored<0>},
    {"Handles/Both sides", "Across Y", "",
     "What is moved moves its counterpart on the other side along y, too, mirrored", std::nullopt,
     mirror_moves<1>, cloud_is_open, moves_are_mirrored<1>},
    {"Handles/Both sides", "Across Z", "",
     "What is moved moves its counterpart on the other side along z, too, mirrored", std::nullopt,
     mirror_moves<2>, cloud_is_open, moves_are_mirrored<2>},
    {"Handles", "Delete", "Del", "Deletes what is chosen of the handles; their points stay", on(Key::del),
     delete_handle, handle_or_selection_is_there, nullptr, true},
};

const Action view_actions[] = {
    {"View", "Frame the selection", "F", "Brings the selection, or the chosen handle, into view", of_tools,
     [](const Ui& ui) { ui.tell(FrameView{FrameWhat::selection}); }, cloud_is_open},
    {"View", "Frame everything", "Home", "Brings the whole cloud into view", of_tools,
     [](const Ui& ui) { ui.tell(FrameView{FrameWhat::everything}); }, cloud_is_open},
    {"View/Look from", "Front", "1", "Looks at the front", of_tools, look_from<Side::front>, cloud_is_open},
    {"View/Look from", "Back", "Ctrl+1", "Looks at the back", of_tools, look_from<Side::back>, cloud_is_open},
    {"View/Look from", "Right", "3", "Looks against x", of_tools, look_from<Side::right>, cloud_is_open},
    {"View/Look from", "Left", "Ctrl+3", "Looks along x", of_tools, look_from<Side::left>, cloud_is_open},
    {"View/Look from", "Top", "7", "Looks down", of_tools, look_from<Side::top>, cloud_is_open},
    {"View/Look from", "Bottom", "Ctrl+7", "Looks up", of_tools, look_from<Side::bottom>, cloud_is_open},
    {"View", "Orthographic", "5", "No perspective: parallel lines stay parallel", of_tools,
     toggle_orthographic, cloud_is_open, [](const Ui& ui) { return ui.editor.camera.orthographic; }},
    {"View/Orbit as", "Turntable", "", "Orbiting keeps the horizon level", std::nullopt,
     orbit_by<Orbiting::turntable>, always, orbits_by<Orbiting::turntable>},
    {"View/Orbit as", "Trackball", "", "Orbiting turns freely in all directions", std::nullopt,
     orbit_by<Orbiting::trackball>, always, orbits_by<Orbiting::trackball>},
    {"View/Upward axis", "Z", "", "The cloud stands on the plane of x and y, as most surveys do",
     std::nullopt, turn_up<UpAxis::z>, cloud_is_open, is_up<UpAxis::z>},
    {"View/Upward axis", "Y", "",
     "The cloud stands on the plane of x and z, as many scanned and modelled figures do", std::nullopt,
     turn_up<UpAxis::y>, cloud_is_open, is_up<UpAxis::y>},
    {"View/Upward axis", "-Y", "",
     "y points down and z to the back, as depth cameras and photogrammetry have it", std::nullopt,
     turn_up<UpAxis::minus_y>, cloud_is_open, is_up<UpAxis::minus_y>},
    {"View", "As it was opened", "O",
     "Shows the cloud as it was before all edits, to compare, until it is asked for again or moved", on('O'),
     [](const Ui& ui) { ui.state.as_opened = !ui.state.as_opened; }, something_was_done,
     [](const Ui& ui) { return ui.state.as_opened; }},
    {"View", "Larger points", "+", "Draws the points larger", repeating(on('=')), resize_points<1>,
     cloud_is_open, nullptr, true},
    {"View", "Smaller points", "-", "Draws the points smaller", repeating(on('-')), resize_points<-1>,
     cloud_is_open},
    {"View", "Eye-dome lighting", "E", "Darkens what lies behind, so that depth shows", on('E'),
     toggle_look<&PointLook::eye_dome>, cloud_is_open, look_is_on<&PointLook::eye_dome>},
    {"View", "Shading", "", "Lights the points by their normals; where the file has none, they are estimated",
     std::nullopt, toggle_look<&PointLook::shading>, cloud_is_open, look_is_on<&PointLook::shading>},
    {"View", "Ground grid", "", "Shows a grid under the cloud", std::nullopt, toggle<&Display::grid>, always,
     is_on<&Display::grid>, true},
    {"View", "Axes", "", "Shows the directions of x, y and z in the corner", std::nullopt,
     toggle<&Display::axes>, always, is_on<&Display::axes>},
    {"View", "Samples", "", "Shows the points that are solved for; all others follow those near them",
     std::nullopt, toggle<&Display::samples>, samples_are_there, is_on<&Display::samples>},
    {"View", "Sample links", "", "Shows which samples hold each other", std::nullopt,
     toggle<&Display::sample_graph>, samples_are_there, is_on<&Display::sample_graph>},
    {"View", "Handle colours", "",
     "Colours and patterns of what handles hold; without them a picture is of the cloud alone", std::nullopt,
     toggle<&Display::handles>, always, is_on<&Display::handles>},
    {"View", "Handle names", "", "Writes the names of the handles beside them", std::nullopt,
     toggle<&Display::names>, always, is_on<&Display::names>},
    {"View", "Panels", "N", "Shows or hides the panels at the right", on('N'),
     [](const Ui& ui) { ui.state.show_panels = !ui.state.show_panels; }, always,
     [](const Ui& ui) { return ui.state.show_panels; }, true},
    {"View", "Full screen", "F11", "Gives the whole screen to the window, and back", on(Key::f11),
     [](const Ui& ui) { ui.state.full_screen = !ui.state.full_screen; }, always,
     [](const Ui& ui) { return ui.state.full_screen; }},
};

const Action session_actions[] = {
    {"Session", "Play", "Space", "Plays back what was done, as it was recorded; again: holds it", on(' '),
     toggle_playing, document_has_steps, [](const Ui& ui) { return ui.state.playback.playing; }},
    {"Session", "Next frame", "Right", "Shows the next frame that was recorded, and stops there",
     repeating(on(Key::right)), [](const Ui& ui) { play_frame(ui, 1); }, document_has_steps},
    {"Session", "Previous frame", "Left", "Shows the frame before; between two steps, the step before",
     repeating(on(Key::left)), [](const Ui& ui) { play_frame(ui, -1); }, document_has_steps},
    {"Session", "To the beginning", "", "Goes back to the cloud as it was opened", std::nullopt,
     [](const Ui& ui) { play_to(ui, 0); }, document_has_steps},
    {"Session", "To the end", "", "Goes to the last step that was done", std::nullopt,
     [](const Ui& ui) { play_to(ui, playback_steps(ui.editor)); }, document_has_steps},
    {"Session", "Timeline", "", "Shows the steps in a bar, to go back and forth through them", std::nullopt,
     [](const Ui& ui) { ui.state.playback.shown ? close_timeline(ui) : show_timeline(ui); }, cloud_is_open,
     [](const Ui& ui) { return ui.state.playback.shown; }, true},
};

const Action help_actions[] = {
    {"Help", "Keys and mouse", "F1", "Shows this page", on(Key::f1),
     [](const Ui& ui) { ui.state.show_help = !ui.state.show_help; }, always},
    {"Help", "About knead", "", "What this is", std::nullopt,
     [](const Ui& ui) { ui.state.show_about = true; }, always},
};

template<std::size_t n>
void append(std::vector<Action>& all, const Action (&some)[n]) {
    all.insert(all.end(), std::begin(some), std::end(some));
}

std::vector<Action> all_actions() {
    std::vector<Action> all;
    append(all, file_actions);
    append(all, edit_actions);
    append(all, select_actions);
    append(all, handle_actions);
    append(all, view_actions);
    append(all, session_actions);
    append(all, help_actions);
    return all;
}

// Second keys of actions: the same as another one.
KeyPress usual_key(KeyPress press) {
    if (press.key == key('S') && press.held == ctrl_alt) return {key('S'), ctrl_shift, press.repeated};
    if (press.key == key('+') || press.key == key('=')) {
        press.key = key('=');
        press.held.shift = false; // where + is Shift and =
    }
    return press;
}

} // namespace

std::span<const Action> actions() {
    static const std::vector<Action> all = all_actions();
    return all;
}

const Action& action_called(std::string_view menu, std::string_view label) {
    const auto found = std::ranges::find_if(
        actions(), [&](const Action& action) { return menu == action.menu && label == action.label; });
    require(found != actions().end(), "an action of the table");
    return *found;
}

void menu_item(const Ui& ui, const Action& action) {
    const bool possible = action.possible(ui);
    const bool ticked = action.ticked && action.ticked(ui);
    const std::string about = action.about ? action.about(ui) : std::string();
    const std::string label = action.label + (about.empty() ? "" : ": " + about) + "###" + action.label;
    if (ImGui::MenuItem(label.c_str(), *action.keys ? action.keys : nullptr, ticked, possible))
        action.act(ui);
    explain(action.words);
}

bool press_shortcut(const Ui& ui, const KeyPress& press) {
    const KeyPress usual = usual_key(press);
    for (const Action& action : actions()) {
        if (!action.shortcut || action.shortcut->key != usual.key || !(action.shortcut->held == usual.held))
            continue;
        if (!action.possible(ui)) return false;
        if (!press.repeated || action.shortcut->repeats) action.act(ui);
        return true;
    }
    return false;
}

std::span<const Gesture> gestures() {
    static constexpr std::array list{
        Gesture{"Look around", "Middle drag", "Orbit (Alt+left drag without a middle button)"},
        Gesture{"Look around", "Shift+Middle drag", "Pan"},
        Gesture{"Look around", "Wheel", "Zoom to the cursor"},
        Gesture{"Look around", "Double click", "Orbit about this point"},
        Gesture{"Select", "Right click", "A menu of the handle there, of the selection, or of the view"},
        Gesture{"Select", "Left drag", "Draw with the select tool"},
        Gesture{"Select", "Shift+Left drag", "Add to the selection"},
        Gesture{"Select", "Ctrl+Left drag", "Take away from it"},
        Gesture{"Select", "Shift+click",
                "On a handle, while no points are selected: it goes along, as in the list"},
        Gesture{"Select", "[", "Smaller brush"},
        Gesture{"Select", "]", "Larger brush"},
        Gesture{"While moving, turning or scaling", "X",
                "Along x, of the gizmo's axes; again: of the other ones; again: free (Y, Z alike)"},
        Gesture{"While moving, turning or scaling", "Shift+X", "In the plane across x (Y, Z alike)"},
        Gesture{"While moving, turning or scaling", "0…9", "Type the amount; − turns its sign round"},
        Gesture{"While moving, turning or scaling", "Tab", "Type the length or factor along the next axis"},
        Gesture{"While moving, turning or scaling", "Ctrl", "Whole steps"},
        Gesture{"While moving, turning or scaling", "Shift", "Ten times slower"},
        Gesture{"While moving, turning or scaling", "Enter", "Done (or click)"},
        Gesture{"While moving, turning or scaling", "Esc", "As it was (or right click)"},
        Gesture{"In the panels", "Shift+click", "In the list: that handle goes along with the chosen one"},
        Gesture{"In the panels", "F10", "Menus; arrows walk through them, Enter chooses"},
        Gesture{"In the panels", "Ctrl+click", "Type the number of a slider"},
        Gesture{"In the panels", "Click", "Type the number of a field without a bar"},
        Gesture{"In the panels", "Tab", "Type the next number (with Shift: the one before)"},
    };
    return list;
}

} // namespace knead
