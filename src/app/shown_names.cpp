#include "app/shown_names.h"

#include "app/letters.h"

namespace knead {

void add_foreign_letters_of_names(const Editor& editor, const UiState& state, std::set<ImWchar>& letters) {
    const auto add = [&](const std::string& text) { add_foreign_letters(text, letters); };
    const auto add_path = [&](const std::filesystem::path& path) { add(path.string()); };
    const FileBrowser& browser = state.browser;
    add_path(browser.folder);
    add(browser.typed);
    add(browser.new_folder.name);
    for (const FolderEntry& entry : browser.entries) add(entry.name);
    for (const std::filesystem::path& file : state.recent) add_path(file);
    for (const LostWork& work : state.lost) {
        add_path(work.cloud);
        add_path(work.session);
    }
    for (const Toast& toast : state.toasts) add(toast.notice.words);
    add(state.name_text);
    add_path(editor.opening_request.file);
    add_path(editor.opened.file);
    if (!editor.document) return;
    add_path(editor.document->session);
    for (const Handle& handle : editor.document->handles) add(handle.name);
    for (const Attribute& attribute : editor.opened.cloud->attributes) add(attribute.name);
}

} // namespace knead
