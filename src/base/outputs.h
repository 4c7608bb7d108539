#pragma once
// Several files and folders that take their places together, or none of them does.

#include "base/temporary_folder.h"
#include "base/whole_file.h"

#include <list>

namespace knead {

// What one command writes. Destroyed before hand_over(), it leaves every target as it was.
class Outputs {
public:
    // To be written to until hand_over(); good as long as this.
    FileInTheMaking& add(FileInTheMaking file) { return files_.emplace_back(std::move(file)); }
    TemporaryFolder& add(TemporaryFolder folder) { return folders_.emplace_back(std::move(folder)); }

    // Makes all of them ready, and only then renames the first: so nothing has changed where one cannot be
    // written, unless the disk fails between two renamings. The folders come first, then the files in the
    // order in which they were added. Throws Error (output), also where two have one target. Once only.
    void hand_over();

private:
    std::list<TemporaryFolder> folders_;
    std::list<FileInTheMaking> files_;
};

} // namespace knead
