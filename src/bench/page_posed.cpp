// Figure 1 of the paper: a creature posed by a few handles, and its likenesses.

#include "bench/page_joints.h"

namespace knead {

namespace {

JointedPose creature_pose() {
    return {"creature",
            "Head twisted 45°, one arm 90°, the other bent 30°; the feet stay. 1000 samples.",
            HalfspaceRegion{Vec3d(0, 0, 0.33), Vec3d(0, 0, -1)},
            {{"head", BoxRegion{Vec3d(-0.4, -0.5, 1.2), Vec3d(0.6, 0.5, 1.85)}, Vec3d(0.03, 0, 1.2),
              Vec3d::UnitZ(), 45, ""},
             {"left arm", BoxRegion{Vec3d(-0.3, 0.62, 0.7), Vec3d(0.4, 1.3, 1.3)}, Vec3d(0, 0.25, 0.95),
              Vec3d::UnitZ(), -90, ""},
             {"right arm", BoxRegion{Vec3d(-0.3, -1.3, 0.7), Vec3d(0.4, -0.62, 1.3)}, Vec3d(0, -0.25, 0.95),
              Vec3d::UnitX(), 30, ""}},
            {60, 15, UpAxis::z, usual_size, {}}};
}

JointedPose armadillo_pose() {
    return {
        "armadillo",
        "Head twisted 45°, one arm turned down by 90°, the other bent 30°; the shins stay. 1000 samples.",
        HalfspaceRegion{Vec3d(0, -20, 0), Vec3d(0, -1, 0)},
        {{"head", BoxRegion{Vec3d(-24, 56, 8), Vec3d(24, 100, 60)}, Vec3d(0, 56, 12), Vec3d::UnitY(), 45, ""},
         {"right arm", BoxRegion{Vec3d(-70, 35, -30), Vec3d(-42, 100, 60)}, Vec3d(-25, 58, -5),
          Vec3d::UnitZ(), 90, ""},
         {"left arm", BoxRegion{Vec3d(42, 35, -30), Vec3d(70, 100, 60)}, Vec3d(25, 58, -5), Vec3d::UnitZ(),
          -30, ""}},
        {20, 5, UpAxis::y, usual_size, {}}};
}

JointedPose bunny_pose() {
    return {"bunny",
            "It has no arms: head twisted 45°, one ear laid over by 90°, the other bent 30°; the base stays. "
            "1000 samples.",
            HalfspaceRegion{Vec3d(0, 0.06, 0), Vec3d(0, -1, 0)},
            {{"face", BoxRegion{Vec3d(-0.1, 0.112, -0.01), Vec3d(-0.055, 0.14, 0.06)},
              Vec3d(-0.06, 0.11, 0.015), Vec3d::UnitY(), 45, ""},
             {"right ear", SphereRegion{Vec3d(-0.07, 0.172, -0.05), 0.018}, Vec3d(-0.065, 0.148, -0.012),
              Vec3d::UnitZ(), 90, "face"},
             {"left ear", SphereRegion{Vec3d(-0.018, 0.178, -0.015), 0.018}, Vec3d(-0.045, 0.15, 0.0),
              Vec3d::UnitZ(), 30, "face"}},
            {-20, 15, UpAxis::y, usual_size, {}}};
}

JointedPose dragon_pose() {
    return {"dragon",
            "It has no free arms: head twisted 45°, tail bent 90°; the ground stays. 1000 samples.",
            HalfspaceRegion{Vec3d(0, 0.075, 0), Vec3d(0, -1, 0)},
            {{"head", BoxRegion{Vec3d(-0.12, 0.142, -0.06), Vec3d(-0.03, 0.21, 0.04)},
              Vec3d(-0.05, 0.14, -0.005), Vec3d::UnitY(), 45, ""},
             {"tail", BoxRegion{Vec3d(0.078, 0.122, -0.04), Vec3d(0.11, 0.16, 0.01)}, Vec3d(0.075, 0.1, 0),
              Vec3d::UnitZ(), -90, ""}},
            {15, 10, UpAxis::y, usual_size, {}}};
}

} // namespace

PageSection posed_section(PageStudio& studio) {
    PageSection section{"Figure 1: a creature, posed",
                        "A few handles, dragged in nine frames each and settled; all between them follows.",
                        {},
                        {}};
    section.rows.push_back(jointed_row(studio, creature_pose(), "posed", clean_creature(studio), {}, false));
    const JointedPose poses[] = {bunny_pose(), armadillo_pose(), dragon_pose()};
    add_posed_scans(studio, poses, "posed", false, section);
    return section;
}

} // namespace knead
