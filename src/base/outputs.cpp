#include "base/outputs.h"

#include "base/error.h"

#include <set>
#include <system_error>

namespace knead {

namespace {

// The second of two would take the place of the first.
void refuse_twice(std::set<std::filesystem::path>& targets, const std::filesystem::path& target) {
    std::error_code trouble;
    const auto real = std::filesystem::weakly_canonical(std::filesystem::absolute(target, trouble), trouble);
    if (!targets.insert(trouble ? target : real).second)
        throw Error(Trouble::output, target.string(),
                    "is named for two outputs; name another for one of them");
}

} // namespace

void Outputs::hand_over() {
    std::set<std::filesystem::path> targets;
    for (const TemporaryFolder& folder : folders_) refuse_twice(targets, folder.target());
    for (const FileInTheMaking& file : files_) refuse_twice(targets, file.shown());
    for (const TemporaryFolder& folder : folders_) folder.make_ready();
    for (const TemporaryFolder& folder : folders_)
        for (const std::filesystem::path& name : folder.names())
            refuse_twice(targets, folder.target() / name);
    for (FileInTheMaking& file : files_) file.make_ready();
    for (TemporaryFolder& folder : folders_) folder.put_in_place();
    for (FileInTheMaking& file : files_) file.put_in_place();
}

} // namespace knead
