#include "app/wishes.h"

#include "app/recent_files.h"
#include "app/remembered.h"
#include "base/error.h"
#include "edit/journal.h"
#include "io/cloud_file.h"

#include <array>
#include <cstdlib>
#include <utility>

namespace knead {

namespace {

constexpr const char* demonstration_session = "creature-wave.knead";

void begin_opening(Work& work, OpenRequest request) {
    request.journal_folder = default_journal_folder();
    request.device = work.options.device;
    if (work.drawn_by_device && !work.sharing && work.options.device != "reference")
        work.sharing = share_with_current_gl_context();
    request.make_upsampler = [sharing = work.sharing](const std::string& device, Workers& workers,
                                                      unsigned threads) {
        return make_drawing_upsampler(device, workers, threads, sharing);
    };
    request.threads = work.options.threads;
    request.settings = work.options.settings;
    request.choose_samples = work.state.choose_samples;
    request.session_chooses_samples = chose_samples(request.file);
    work.state.opening_demonstration = false;
    open(work.editor, std::move(request));
}

// Asks what becomes of unsaved work, if there is any; `wish` comes after the answer.
bool has_to_ask(Work& work, const Wish& wish) {
    if (!has_unsaved_session(work.editor)) return false;
    work.state.after = {.then = wish};
    work.state.ask_unsaved = true;
    return true;
}

// Lets a file be finished that is being written; `wish` comes afterwards.
bool has_to_finish_saving(Work& work, const Wish& wish) {
    if (!work.editor.saving) return false;
    if (!work.state.after.waiting_for_file)
        add_toast(work.state, {Notice::Kind::information, "What is being saved is finished first."});
    work.state.after = {.then = wish, .waiting_for_file = true};
    return true;
}

// Beside the program, in its source, or where it was installed.
std::optional<std::filesystem::path> data_file(const char* name) {
    std::error_code ignored;
    const std::filesystem::path program =
        std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
    const std::array folders{program / "data", program / ".." / "data", program / ".." / "share" / "knead",
                             std::filesystem::path(KNEAD_SHARE_FOLDER),
                             std::filesystem::path(KNEAD_SOURCE_DATA)};
    for (const std::filesystem::path& folder : folders)
        if (std::filesystem::is_regular_file(folder / name, ignored))
            return std::filesystem::weakly_canonical(folder / name, ignored);
    return std::nullopt;
}

void fulfil(Work& work, const WishOpen& wish) {
    OpenRequest request;
    request.file = wish.file;
    request.cloud = wish.cloud;
    request.sets_session = wish.as_started;
    begin_opening(work, std::move(request));
}

void fulfil(Work& work, const WishUseCloud& wish) {
    if (!work.state.without_cloud) return;
    OpenRequest request = std::move(std::exchange(work.state.without_cloud, std::nullopt)->request);
    request.cloud = wish.cloud;
    begin_opening(work, std::move(request));
}

void fulfil(Work& work, const WishRestore& wish) {
    OpenRequest request;
    request.file = wish.work.cloud;
    request.restore = wish.work.journal;
    begin_opening(work, std::move(request));
}

void fulfil(Work& work, const WishDeleteLost& wish) {
    try {
        Journal::take_over(wish.work.journal).discard();
    } catch (const Error& error) {
        add_toast(work.state, {Notice::Kind::error, error.what()});
    }
    std::erase_if(work.state.lost, [&](const LostWork& lost) { return lost.journal == wish.work.journal; });
}

void fulfil(Work& work, const WishCancelOpening&) {
    cancel_opening(work.editor);
}

// The demonstration is knead's own, and there for the next one who wants to see it.
bool has_session_of_its_own(const Editor& editor) {
    const std::filesystem::path& session = editor.document->session;
    return !session.empty() && session != data_file(demonstration_session);
}

// What is open, as a place for something new to lie beside; knead's own creature counts as lying at home.
std::filesystem::path place_of(const Editor& editor) {
    if (has_session_of_its_own(editor)) return editor.document->session;
    const std::filesystem::path& opened = editor.opened.file;
    const auto own = data_file("creature.ply");
    const char* home = std::getenv("HOME");
    if (home && own && std::filesystem::absolute(opened).parent_path() == own->parent_path())
        return std::filesystem::path(home) / opened.filename();
    return opened;
}

// The nearest folder above that is there.
std::filesystem::path folder_around(const std::filesystem::path& file) {
    std::error_code ignored;
    std::filesystem::path folder = std::filesystem::absolute(file, ignored).parent_path();
    while (folder.has_relative_path() && !std::filesystem::is_directory(folder, ignored))
        folder = folder.parent_path();
    return folder;
}

// A name that no file of the folder has: with a number, if need be.
std::string free_name_in(const std::filesystem::path& folder, const std::filesystem::path& name) {
    std::error_code ignored;
    std::filesystem::path free = name;
    for (unsigned number = 2; std::filesystem::exists(folder / free, ignored); ++number)
        free = name.stem().string() + " " + std::to_string(number) + name.extension().string();
    return free.string();
}

// Where the last one went; the first time beside what is open, under such a name. Wherever was looked for
// something else to open.
void propose(FileBrowser& browser, const std::filesystem::path& last, const std::filesystem::path& beside,
             const std::string& first) {
    browser.folder = folder_around(last.empty() ? beside : last);
    browser.typed = last.empty() ? free_name_in(browser.folder, first) : last.filename().string();
}

// A name beside its own, of the same kind.
std::string name_of_export(const std::filesystem::path& opened) {
    return opened.stem().string() + "-posed" +
           (has_cloud_extension(opened) ? opened.extension().string() : ".ply");
}

void fulfil(Work& work, const WishBrowse& wish) {
    FileBrowser& browser = work.state.browser;
    browser.purpose = wish.purpose;
    browser.open_now = true;
    browser.typed.clear();
    const std::filesystem::path& opened = work.editor.opened.file;
    if (wish.purpose == BrowseFor::cloud_of_session && work.state.without_cloud)
        browser.folder = folder_around(work.state.without_cloud->request.file);
    if (browser.folder.empty()) {
        if (!opened.empty())
            browser.folder = std::filesystem::absolute(opened).parent_path();
        else if (!work.state.recent.empty())
            browser.folder = work.state.recent.front().parent_path();
    }
    if (!work.editor.document) return;
    const std::filesystem::path beside = place_of(work.editor);
    if (wish.purpose == BrowseFor::save_session)
        propose(browser, work.state.last_session, beside, opened.stem().string() + ".knead");
    if (wish.purpose == BrowseFor::save_cloud && looks_back(work.editor))
        add_toast(work.state, {Notice::Kind::warning,
                               "This is an earlier step: the cloud is saved as it was then, without what was "
                               "done later."});
    if (wish.purpose == BrowseFor::save_cloud) {
        propose(browser, work.state.last_export, beside, name_of_export(opened));
        browser.usual_extension = std::filesystem::path(browser.typed).extension().string();
    }
    if (wish.purpose == BrowseFor::save_picture) {
        const std::filesystem::path& last = work.state.last_picture;
        browser.folder = folder_around(last.empty() ? beside : last);
        browser.typed = free_name_in(browser.folder, opened.stem().string() + ".png");
    }
}

void save(Work& work, const WishSaveTo& wish) {
    if (wish.purpose == BrowseFor::save_picture) {
        work.state.last_picture = wish.file;
        work.picture = wish.file;
        return; // nobody waits for it: it is there when the next picture is shown
    }
    if (wish.purpose == BrowseFor::save_session) {
        save_session(work.editor, wish.file, wish.anyway);
        remember_file(work.state.recent, wish.file);
        remember_choosing(wish.file, work.editor.chooses_samples);
        work.state.last_session = wish.file;
    } else {
        save_cloud(work.editor, wish.file, wish.options, wish.anyway, wish.keeps_original);
        work.state.last_export = wish.file;
    }
    if (work.state.after.waiting_for_save) work.state.after.save_was_posted = true;
}

void fulfil(Work& work, const WishSaveSession&) {
    if (!work.editor.document) return;
    if (!has_session_of_its_own(work.editor))
        fulfil(work, WishBrowse{BrowseFor::save_session});
    else
        save(work, {BrowseFor::save_session, work.editor.document->session, false});
}

void fulfil(Work& work, const WishSaveTo& wish) {
    if (!work.editor.document) return;
    std::error_code ignored;
    const bool own_session =
        wish.purpose == BrowseFor::save_session && wish.file == work.editor.document->session;
    if (wish.ask && !own_session && std::filesystem::exists(wish.file, ignored))
        work.state.overwriting = wish;
    else
        save(work, wish);
}

void fulfil(Work& work, const WishDemonstration& wish) {
    const char* name = wish.posed ? demonstration_session : "creature.ply";
    if (const auto file = data_file(name)) {
        fulfil(work, WishOpen{*file});
        work.state.opening_demonstration = true;
    } else
        add_toast(work.state, {Notice::Kind::error,
                               std::string(name) + " does not lie beside knead, where it belongs. Install "
                                                   "knead anew, or open a scan of your own (Ctrl+O)."});
}

void fulfil(Work& work, const WishPress& wish) {
    handle_input(work.editor, wish.press);
}
void fulfil(Work& work, const WishSelectTool& wish) {
    take_select_tool(work.editor, wish.tool);
}
void fulfil(Work& work, const WishThrough& wish) {
    work.editor.tools.through = wish.through;
}
void fulfil(Work& work, const WishMovePivot& wish) {
    work.editor.tools.move_pivot = wish.pivot;
}
void fulfil(Work& work, const WishLocalAxes& wish) {
    work.editor.local_axes = wish.local;
}
void fulfil(Work& work, const WishOrbiting& wish) {
    work.editor.tools.orbiting = wish.style;
}
void fulfil(Work& work, const WishUpAxis& wish) {
    work.state.display.up = wish.up;
    set_up(work.editor.camera, wish.up);
    Remembered choices = read_remembered();
    choices.up = wish.up;
    remember(choices);
}
void fulfil(Work& work, const WishChooseSamples& wish) {
    work.state.choose_samples = wish.by_themselves;
    Remembered choices = read_remembered();
    choices.choose_samples = wish.by_themselves;
    remember(choices);
    apply(work.editor, ChooseSamples{wish.by_themselves});
}
void fulfil(Work& work, const WishBrowseLabels&) {
    if (!work.editor.document) return;
    LabelDialog& dialog = work.state.labels;
    dialog.columns = label_columns(*work.editor.opened.cloud);
    choose_column(dialog, 0);
    dialog.open_now = true;
}
void fulfil(Work& work, const WishLabelHandles& wish) {
    handles_from_labels(work.editor, wish.column, wish.choices);
}
void fulfil(Work& work, const WishTakeHandles& wish) {
    handles_from_session(work.editor, wish.session);
}
void fulfil(Work& work, const WishForgetRecent&) {
    forget_files(work.state.recent);
}
void fulfil(Work& work, const WishClose&) {
    work.closing = true;
}

void fulfil_what_waited(Work& work, const Wish& waited) {
    std::visit(
        [&]<typename Other>(const Other& wish) {
            if constexpr (!std::is_same_v<Other, WishDiscard>) fulfil(work, wish);
        },
        waited);
}

void fulfil(Work& work, const WishDiscard&) {
    const std::optional<Wish> then = std::exchange(work.state.after, {}).then;
    if (!then) return;
    if (has_to_finish_saving(work, *then))
        work.state.after.discarded = work.editor.document->state;
    else
        fulfil_what_waited(work, *then);
}

bool replaces_document(const Wish& wish) {
    return std::holds_alternative<WishOpen>(wish) || std::holds_alternative<WishUseCloud>(wish) ||
           std::holds_alternative<WishRestore>(wish) || std::holds_alternative<WishDemonstration>(wish) ||
           std::holds_alternative<WishClose>(wish);
}

} // namespace

void grant(Work& work, const Wish& wish) {
    // What the hand is doing counts: a question behind which it went on could not be answered.
    if (replaces_document(wish) && work.editor.tools.drag)
        handle_input(work.editor, KeyPress{Key::enter, {}});
    if (replaces_document(wish) && (has_to_ask(work, wish) || has_to_finish_saving(work, wish))) return;
    std::visit([&](const auto& wanted) { fulfil(work, wanted); }, wish);
}

void ask_about(Work& work, const HeldSave& held) {
    work.state.overwriting = {.purpose = held.options ? BrowseFor::save_cloud : BrowseFor::save_session,
                              .file = held.target,
                              .ask = true,
                              .options = held.options.value_or(ExportOptions{}),
                              .anyway = true};
    work.state.after.save_was_posted = false;
    if (work.state.after.waiting_for_file) work.state.after = {}; // it was not written, and is asked about
}

void go_on_after_saving(Work& work) {
    AfterSaving& after = work.state.after;
    if (work.editor.saving) return;
    if (after.waiting_for_file) {
        const AfterSaving waited = std::exchange(after, {});
        if (waited.discarded == work.editor.document->state)
            fulfil_what_waited(work, *waited.then);
        else
            grant(work, *waited.then); // which asks about what was done meanwhile
        return;
    }
    if (!after.waiting_for_save) return;
    if (work.state.overwriting || !work.editor.held_saves.empty()) return; // a save waits for an answer
    if (!has_unsaved_session(work.editor)) {
        fulfil(work, WishDiscard{}); // nothing is unsaved any more
        return;
    }
    const bool still_choosing = work.state.browser.open_now || work.state.browser.is_open;
    if (!after.save_was_posted && !still_choosing) after = {}; // the user thought better of it
}

} // namespace knead
