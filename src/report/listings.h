#pragma once

#include <string>
#include <vector>

#include "method/method.h"
#include "plan/plan.h"
#include "profile/profile.h"
#include "scene/scene.h"

namespace gnomon {

enum class Format { Text, Json, Csv };

/// All chips, a line each.
std::string listProfiles(const std::vector<Profile>& profiles, Format format);
/// All facts of one chip with their sources.
std::string showProfile(const Profile& profile, Format format);

std::string listMethods(const std::vector<NamedMethod>& methods, Format format);

/// All scenes with their sizes, lights and frames.
std::string listScenes(const std::vector<Scene>& scenes, Format format);

/// The passes of one frame in OpenGL's terms, and what the chip lacks for them.
std::string showPlan(const Plan& plan, const std::vector<Missing>& missing, Format format);

}  // namespace gnomon
