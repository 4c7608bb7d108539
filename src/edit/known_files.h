#pragma once
// The files that an editor has read or written, as they were then, so that what somebody else makes of them
// is not overwritten unnoticed.

#include "base/whole_file.h"

#include <filesystem>
#include <map>
#include <string>

namespace knead {

struct KnownFiles {
    std::map<std::string, FileStamp> stamps; // by real_name(), and by the absolute name that was asked for
};

// The same text for one file by any name, links followed.
std::string real_name(const std::filesystem::path& file);

// Takes note of a file as it is now: before it is read, so that a change meanwhile counts as one, and after
// it was written.
void take_note(KnownFiles& known, const std::filesystem::path& file);

// The same of a file as it was earlier.
void take_note(KnownFiles& known, const std::filesystem::path& file, const FileStamp& stamp);

// Whether the file is there and is not as it was when it was noted last; not where it never was.
bool was_changed(const KnownFiles& known, const std::filesystem::path& file);

} // namespace knead
