#pragma once

#include <optional>
#include <string>
#include <vector>

#include "method/method.h"
#include "plan/plan.h"
#include "profile/profile.h"
#include "report/page.h"
#include "report/plan_notes.h"
#include "scene/scene.h"

namespace gnomon {

/// Rows under a head, in any format; JSON objects take the head's words as keys.
std::string listing(const std::vector<std::vector<std::string>>& rows, const Page& page);

/// All chips, a line each, with the evidence for their blend units; the text has shorter words for the
/// equations.
std::string listProfiles(const std::vector<Profile>& profiles, const Page& page);
/// All facts of one chip with their sources and the grade of evidence of each.
std::string showProfile(const Profile& profile, const Page& page);

std::string listMethods(const std::vector<NamedMethod>& methods, const Page& page);

/// The counting rules and silhouettes with their papers.
std::string listAxisValues(const Page& page);

/// All scenes with their sizes, lights and frames; in the text the hard cases follow under a heading of their
/// own, with what is hard. One hard case alone comes with its promises.
std::string listScenes(const std::vector<Scene>& scenes, const Page& page);

/// "clear", "scene", "volume", "rectangle", "copy".
std::string kindName(PassKind kind);

/// The plan of one frame, with what it is a plan of.
struct PlanSheet {
    std::string method{}, shade{}, profile{}, scene{};
    int frame = 0;
    Plan plan{};
    std::vector<Missing> missing{};
    std::vector<std::string> chipTerms{};  ///< of each pass (chip_terms.h); "" where there are none
    std::optional<PlanNotes> notes{};      ///< of a plan that is to be explained
};

/// The passes of frames in OpenGL's terms and the chip's own, and what the chip lacks for them; of plans with
/// notes why each pass is there, what it touches, what is left out and why, and the full plan beside it.
std::string showPlans(const std::vector<PlanSheet>& sheets, const Page& page);

}  // namespace gnomon
