#pragma once
// Poses of the evaluation's page: a cloud stands on what stays, and handles turn about joints.

#include "bench/page_studio.h"

#include <span>
#include <string>
#include <vector>

namespace knead {

// A handle that turns about an axis through a pivot; a part that hangs on another goes with it.
struct Joint {
    std::string name;
    Region region;
    Vec3d pivot, axis;
    double degrees = 0;
    std::string hangs_on; // the name of a joint before; empty: none
    // Not zero: the free part from the pivot to the handle, straight at rest, becomes an arc of the same
    // length while the handle turns. Across the axis, in the file's units.
    Vec3d free_part = Vec3d::Zero();
};

struct JointedPose {
    std::string name; // of the cloud: "armadillo"
    std::string words;
    Region fixed;
    std::vector<Joint> joints;
    PageView view;
    int frames = 9; // of every joint's drag
};

// The handles, a drag of each through all frames, and a settling.
std::vector<SessionAction> acts_of(const JointedPose& pose);

// Carries the pose out with 1000 samples and draws the cloud at rest, with its handles, and as posed. The
// files are called after the cloud and `suffix`. `cloud_file`: where the cloud came from; empty: it is
// written. `plain_first`: one picture more, of the cloud without its handles.
PageRow jointed_row(PageStudio& studio, const JointedPose& pose, const std::string& suffix, PointCloud cloud,
                    const std::filesystem::path& cloud_file, bool plain_first);

// The poses of those scans of the paper that there are, in its order; what is missing is said in the section.
void add_posed_scans(PageStudio& studio, std::span<const JointedPose> poses, const std::string& suffix,
                     bool plain_first, PageSection& section);

} // namespace knead
