#pragma once
// Choosing a file in the window: what a browser knows between two frames, and how it reads a folder. What it
// looks like is file_browser.cpp.

#include "edit/live_document.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace knead {

struct Format; // io/format.h

enum class BrowseFor { open, save_session, save_cloud, save_picture, take_handles, cloud_of_session };
// Whether the file has to be there already.
constexpr bool reads_file(BrowseFor purpose) {
    return purpose != BrowseFor::save_session && purpose != BrowseFor::save_cloud &&
           purpose != BrowseFor::save_picture;
}

struct FolderEntry {
    std::string name;
    bool is_folder = false;
    bool is_session = false;
    bool is_picture = false;
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type changed;
};

// A folder that the hand is about to make, and names where the button was.
struct NewFolder {
    bool asked_for = false;
    bool focus = false;   // the field is to have it in the next frame
    bool entered = false; // by Enter, in this frame
    bool left = false;    // the field was, in this frame
    std::string name = {};
};

struct FileBrowser {
    BrowseFor purpose = BrowseFor::open;
    bool open_now = false; // is to come up in the next frame
    bool is_open = false;
    bool close_now = false; // is to go in the next frame, if it is there
    std::filesystem::path folder;
    std::vector<FolderEntry> entries;     // folders first, by name
    std::string trouble;                  // why the folder could not be read; empty: it was
    std::filesystem::path missing_folder; // that the trouble is about, and that can be made; empty: none
    NewFolder new_folder;
    std::string typed;                    // the name, or a path
    std::string filter;                   // what was typed of a name that is looked for; empty: all is shown
    ExportOptions options;                // of an exported cloud
    bool bare_picture = false;            // of the cloud alone, without handles and ground
    std::string usual_extension = ".ply"; // of an exported cloud whose name has none
    bool every_file = false;              // also those of another kind than is looked for
    int chosen = -1;                      // among the entries
    bool scroll_to_chosen = false;
    bool focus_name = false;
    bool enter_chosen = false;         // a double click
    bool name_changed_outside = false; // `typed` was set by other means than typing
    int name_version = 0;              // counts those times
};

// Reads the folder, `entries` and `trouble` anew. Never throws.
void read_folder(FileBrowser& browser);

// What was wrong is so no longer.
void forget_trouble(FileBrowser& browser);

// The hand has typed `typed`: of a name, that is what is looked for in the folder; a path from the root or
// from home leads to its folder, and its last part is what is looked for there. Nothing while something is
// saved.
void name_typed(FileBrowser& browser);

// The entries that are shown, as numbers: those whose names have the filter somewhere, in letters of any
// case.
std::vector<int> shown_entries(const FileBrowser& browser);

// Goes to a folder, or to the folder of a file.
void go_to(FileBrowser& browser, const std::filesystem::path& place);

// Makes a folder of this name in the one that is shown, and goes there. Returns whether it could; if not,
// `trouble` says why.
bool make_folder(FileBrowser& browser, const std::string& name);

// Makes the missing folder, and those above it that are missing, too. `trouble` says why where that cannot
// be.
void make_missing_folder(FileBrowser& browser);

// The path that `typed` means: absolute, under ~, or in the folder; with the purpose's extension where it has
// none and is to be written.
std::filesystem::path typed_path(const FileBrowser& browser);

// The same; and where there is no such file and the filter leaves one entry, that one.
std::filesystem::path chosen_path(const FileBrowser& browser);

// The format in which a cloud of the typed name is exported; while that is no name of a file, the one that a
// name with no extension would mean. Null where the extension is of none that knead writes.
const Format* meant_format(const FileBrowser& browser);

// Gives the typed name the format's extension instead of its own, and so names with none that are typed
// later.
void take_format(FileBrowser& browser, const Format& format);

} // namespace knead
