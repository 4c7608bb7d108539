#pragma once
// Samples are spread over the whole cloud, whatever handles hold of it.

#include "edit/pipeline.h"

#include <string>

namespace knead {

// What the user should hear where handles, or a region of interest, leave so little of the cloud free that
// hardly any of the samples lie there: fewer than 60 and less than a fourth of them, and many points to
// each. Empty else. After prepare().
std::string words_about_few_samples(const Pipeline& pipeline);

} // namespace knead
