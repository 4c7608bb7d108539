// In place of Figure 5 of the paper, which nothing here describes: large clouds, far from where they were.

#include "bench/made_cloud.h"
#include "bench/page_joints.h"

namespace knead {

namespace {

constexpr int frames = 36;

JointedPose plane_pose() {
    Joint edge{
        "edge", HalfspaceRegion{Vec3d(0.95, 0, 0), Vec3d(1, 0, 0)}, Vec3d(0.05, 0, 0), -Vec3d::UnitY(), 320,
        ""};
    edge.free_part = Vec3d(0.9, 0, 0);
    return {"plane-1000k",
            "Rolled up: one edge stays, the other is led round by 320° in 36 frames. 1000 samples.",
            HalfspaceRegion{Vec3d(0.05, 0, 0), Vec3d(-1, 0, 0)},
            {edge},
            {-35, 35, UpAxis::z, usual_size, {}},
            frames};
}

JointedPose creature_pose() {
    return {"creature",
            "Bowed by 70°, the head turned by 70° on top of that; the feet stay. 1000 samples.",
            HalfspaceRegion{Vec3d(0, 0, 0.33), Vec3d(0, 0, -1)},
            {{"chest", BoxRegion{Vec3d(-0.3, -0.16, 0.8), Vec3d(0.3, 0.16, 1.0)}, Vec3d(0, 0, 0.6),
              Vec3d::UnitY(), 70, ""},
             {"head", BoxRegion{Vec3d(-0.4, -0.5, 1.25), Vec3d(0.6, 0.5, 1.85)}, Vec3d(0.03, 0, 1.15),
              Vec3d::UnitZ(), 70, "chest"}},
            {15, 10, UpAxis::z, usual_size, {}},
            frames};
}

JointedPose armadillo_pose() {
    return {
        "armadillo",
        "The back bowed by 70°, the head turned by 60° on top of that; the shins stay. 1000 samples.",
        HalfspaceRegion{Vec3d(0, -20, 0), Vec3d(0, -1, 0)},
        {{"back", BoxRegion{Vec3d(-25, 30, -60), Vec3d(25, 55, 0)}, Vec3d(0, 15, 0), Vec3d::UnitX(), 70, ""},
         {"head", BoxRegion{Vec3d(-24, 56, 8), Vec3d(24, 100, 60)}, Vec3d(0, 56, 12), Vec3d::UnitY(), 60,
          "back"}},
        {-25, 5, UpAxis::y, usual_size, {}},
        frames};
}

JointedPose bunny_pose() {
    return {"bunny",
            "The head turned by 90°, ears and all; the base stays. 1000 samples.",
            HalfspaceRegion{Vec3d(0, 0.05, 0), Vec3d(0, -1, 0)},
            {{"head", BoxRegion{Vec3d(-0.12, 0.115, -0.08), Vec3d(-0.03, 0.2, 0.08)}, Vec3d(-0.04, 0.1, 0.01),
              Vec3d::UnitY(), 90, ""}},
            {-20, 15, UpAxis::y, usual_size, {}},
            frames};
}

JointedPose dragon_pose() {
    return {"dragon",
            "The head turned by 90°, the tail laid over by 120°; the ground stays. 1000 samples.",
            HalfspaceRegion{Vec3d(0, 0.075, 0), Vec3d(0, -1, 0)},
            {{"head", BoxRegion{Vec3d(-0.12, 0.142, -0.06), Vec3d(-0.03, 0.21, 0.04)},
              Vec3d(-0.05, 0.14, -0.005), Vec3d::UnitY(), 90, ""},
             {"tail", BoxRegion{Vec3d(0.078, 0.122, -0.04), Vec3d(0.11, 0.16, 0.01)}, Vec3d(0.075, 0.1, 0),
              Vec3d::UnitZ(), -120, ""}},
            {15, 10, UpAxis::y, usual_size, {}},
            frames};
}

} // namespace

PageSection large_section(PageStudio& studio) {
    PageSection section{"In place of Figure 5: large clouds, far from rest",
                        "What Figure 5 of the paper shows is written nowhere in this project either. This is "
                        "our own reading: the paper's largest clouds, and the others, bent as far as they "
                        "go; as scanned, with their handles, and posed.",
                        {},
                        {},
                        {},
                        {}};
    section.rows.push_back(jointed_row(studio, plane_pose(), "large",
                                       made_cloud(Shape::plane, 1'000'000, studio.workers, studio.progress),
                                       {}, true));
    section.rows.push_back(jointed_row(studio, creature_pose(), "large", clean_creature(studio), {}, true));
    const JointedPose poses[] = {bunny_pose(), armadillo_pose(), dragon_pose()};
    add_posed_scans(studio, poses, "large", true, section);
    return section;
}

} // namespace knead
