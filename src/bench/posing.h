#pragma once
// A deformation task carried out: opened as a document, posed in so many frames, settled. What every
// comparison of poses is made of.

#include "bench/survey.h"
#include "edit/document.h"

#include <memory>
#include <vector>

namespace knead {

// A document of the task's cloud whose handles "fixed" and "handle" are declared. `workers` and `upsampler`
// must outlive it.
std::unique_ptr<Document> open_task(const DeformationTask& task, const Settings& settings, Workers& workers,
                                    Upsampler& upsampler);

// Settings with so many samples (nothing: every point), all else at its default.
Settings with_samples(const std::optional<std::uint64_t>& samples);

// A handle's pose that does nothing else.
HandlePose shifted(const Vec3d& way);
HandlePose turned(double degrees, const Vec3d& axis); // `axis`: of length 1

// The task's own drag: its whole motion in one frame.
DragLine whole_motion(const DeformationTask& task);

struct Settling {
    std::size_t iterations = 0; // of the document so far, those of its drags included
    bool at_rest = false;       // before the iterations ran out
};

// Up to `limit` iterations at the poses as they are.
Settling settle(Document& document, unsigned limit, Progress& progress);

// The task's handles on a cloud that fits no task: both automatic handles, the upper one bent.
DeformationTask bending_task(const std::string& name, PointCloud cloud, double degrees);

} // namespace knead
