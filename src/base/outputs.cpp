#include "base/outputs.h"

namespace knead {

void Outputs::hand_over() {
    for (const TemporaryFolder& folder : folders_) folder.make_ready();
    for (FileInTheMaking& file : files_) file.make_ready();
    for (TemporaryFolder& folder : folders_) folder.hand_over();
    for (FileInTheMaking& file : files_) file.commit();
}

} // namespace knead
