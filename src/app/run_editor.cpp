// The main loop: events, what the document has made, a picture, and sleep while nothing happens.

#include "app/run_editor.h"

#include "app/kept_views.h"
#include "app/loop.h"
#include "app/recent_files.h"
#include "app/remembered.h"
#include "app/shown_names.h"
#include "app/timeline.h"
#include "view/standing.h"

#include <cmath>
#include <utility>

namespace knead {

namespace {

// Lets the observer do what the hand would. Returns whether it did anything.
bool be_played(Loop& loop) {
    EditorObserver* observer = loop.options.observer;
    if (!observer) return false;
    const std::vector<Input> inputs = observer->play(loop.editor);
    for (const Input& input : inputs) handle_input(loop.editor, input);
    if (observer->done()) loop.work.closing = true;
    return !inputs.empty();
}

// --- The document ---

// The creature of the demonstration looks along x, whatever was chosen for other clouds: from the front, a
// little from the left and above.
void face_creature(Editor& editor) {
    set_up(editor.camera, UpAxis::z);
    look_at_side(editor.camera, Side::right);
    const auto height = static_cast<double>(editor.viewport.height);
    orbit(editor.camera, Orbiting::turntable, {-0.2 * height, 0.09 * height}, editor.viewport);
}

// How a session that is left is looked at when it is opened again, and posed.
KeptView view_of(const Editor& editor) {
    return {editor.camera, editor.symmetry ? std::optional(editor.symmetry->axis) : std::nullopt,
            editor.chosen};
}

void leave_session(const std::filesystem::path& session, const KeptView& view) {
    if (!session.empty()) keep_view(session, view);
}

// The first look at what was opened.
void look_at_opened(Loop& loop) {
    Editor& editor = loop.editor;
    // As the cloud stood before it was posed.
    const auto standing = standing_axis(editor.opened.opened->positions, editor.opened.cloud->origin);
    set_up(editor.camera, standing.value_or(loop.state.display.up));
    if (loop.state.opening_demonstration) face_creature(editor);
    apply(editor, FrameView{FrameWhat::everything});
    if (loop.state.opening_demonstration || editor.document->session.empty()) return;
    const auto view = kept_view(editor.document->session);
    if (!view) return;
    editor.camera = view->camera;
    if (handle_named(editor.document->handles, view->chosen)) apply(editor, ChooseHandle{view->chosen});
    apply(editor, MirrorMoves{view->mirror_axis});
}

// Takes in what the document has made. Returns whether anything is new.
bool take_news(Loop& loop) {
    Editor& editor = loop.editor;
    const bool was_opening = editor.opening != nullptr;
    std::filesystem::path session_before;
    if (was_opening && editor.document) session_before = editor.document->session;
    const KeptView view_before = view_of(editor);
    const LiveDocument* before = editor.live.get();
    const bool changed = refresh(editor);
    if (was_opening && !editor.opening && editor.live.get() != before) {
        leave_session(session_before, view_before);
        const OpenRequest& request = editor.opening_request;
        if (request.restore)
            std::erase_if(loop.state.lost,
                          [&](const LostWork& lost) { return lost.journal == *request.restore; });
        else
            remember_file(loop.state.recent, request.file);
        static_cast<UiOfDocument&>(loop.state) = {};
        forget_shape(loop.state.toasts);
        loop.state.display.look.scale = 1; // another cloud is another matter
        loop.state.browser.options = {};
        if (!reads_file(loop.state.browser.purpose)) // it was about to save what was there before
            loop.state.browser.close_now = loop.state.browser.is_open;
        editor.held_saves.clear(); // which would ask about the document before
        loop.state.playback.playing = false;
        loop.state.playback.steps = 0; // where looking began was in the document before
        loop.state.playback.wanted.reset();
        lay_out(loop);
        look_at_opened(loop);
        loop.frames_to_draw = 3;
    }
    if (changed && editor.document) place_colors(loop.state.handle_colors, editor.document->handles);
    for (Notice& notice : std::exchange(editor.notices, {})) {
        if (notice.kind == Notice::Kind::error) loop.state.after = {}; // what should have been saved was not
        add_toast(loop.state, std::move(notice));
    }
    if (editor.without_cloud) loop.state.without_cloud = std::exchange(editor.without_cloud, std::nullopt);
    if (!editor.held_saves.empty() && !loop.state.overwriting) {
        ask_about(loop.work, editor.held_saves.front());
        editor.held_saves.erase(editor.held_saves.begin());
    }
    return changed || was_opening;
}

// --- How long to sleep ---

// Seconds until the window has to look again; 0: at once.
double patience(const Loop& loop, bool news) {
    const Editor& editor = loop.editor;
    if (loop.frames_to_draw > 0 || news || !loop.state.measured.complete) return 0;
    if (editor.opening || loop.is_coarse) return 0.03;
    for (const Toast& toast : loop.state.toasts)
        if (toast.shown < 1) return 0;
    if (editor.live && editor.status.busy) return 0.004;
    if (loop.state.sliding.change || loop.scene.expects_more()) return 0.03;
    // Tooltips come a moment after the last motion; a typing cursor blinks; toasts fade.
    if (loop.state.playback.playing || loop.state.playback.wanted) return 0.03;
    const bool restless = loop.calm.seconds() < 1 || ImGui::GetIO().WantTextInput;
    if (restless || !loop.state.toasts.empty()) return 0.12;
    return 0.5;
}

// Whether what was waited for has to be drawn though nothing happened.
bool shows_motion(const Loop& loop) {
    return loop.frames_to_draw > 0 || loop.is_coarse || !loop.state.measured.complete ||
           !loop.state.toasts.empty() || loop.state.sliding.change || loop.scene.expects_more() ||
           loop.state.playback.playing || loop.state.playback.wanted || ImGui::GetIO().WantTextInput ||
           loop.calm.seconds() < 1 || (loop.editor.live && !loop.editor.status.doing.empty());
}

void set_theme(Loop& loop) {
    loop.state.scale = loop.window.content_scale();
    loop.state.fonts = apply_theme(loop.state.scale, loop.foreign_letters);
    loop.window.renew_fonts();
}

void remember_size(const Window& window, float panel_width) {
    Remembered choices = read_remembered();
    const Window::Size size = window.size_of_choice();
    choices.width = size.width;
    choices.height = size.height;
    choices.panel = static_cast<int>(std::lround(panel_width));
    remember(choices);
}

// Names may come in any script; what letters they need is known once they are there.
void take_in_letters(Loop& loop) {
    const std::size_t before = loop.foreign_letters.size();
    add_foreign_letters_of_names(loop.editor, loop.state, loop.foreign_letters);
    if (loop.foreign_letters.size() != before) set_theme(loop);
}

} // namespace

void run_editor(const EditorOptions& options) {
    const Remembered remembered = read_remembered();
    const bool is_sized = options.width > 0;
    Loop loop(options, is_sized ? options.width : remembered.width,
              is_sized ? options.height : remembered.height);
    set_theme(loop);
    loop.state.recent = read_recent_files();
    loop.state.display.up = remembered.up;
    loop.state.choose_samples = remembered.choose_samples;
    loop.state.panel_width = static_cast<float>(remembered.panel);
    loop.state.lost = find_lost_work(default_journal_folder());
    if (!options.file.empty()) loop.wishes.emplace_back(WishOpen{options.file, options.cloud, true});
    bool news = true;
    while (!loop.work.closing) {
        if (options.told_to_stop && options.told_to_stop()) throw Cancelled();
        loop.window.set_endless(hand_is_full(loop) && !options.observer);
        loop.window.take_in(options.observer ? 0.001 : patience(loop, news));
        lay_out(loop);
        const bool played = be_played(loop);
        const bool events = take_events(loop) || played;
        news = take_news(loop);
        if (events) {
            loop.frames_to_draw = 3;
            loop.calm.lap();
        }
        if (!events && !news && !shows_motion(loop)) continue;
        take_in_letters(loop);
        draw(loop);
        if (options.observer)
            options.observer->shown(loop.editor,
                                    {loop.window.drawn_by(), loop.state.measured.drawn, !loop.is_coarse});
        loop.frames_to_draw = std::max(0, loop.frames_to_draw - 1);
    }
    if (!options.observer) remember_size(loop.window, loop.state.panel_width);
    if (loop.editor.document) leave_session(loop.editor.document->session, view_of(loop.editor));
    // Whoever closes the window has saved what they wanted to keep.
    if (loop.editor.live) loop.editor.live->discard_journal();
}

} // namespace knead
