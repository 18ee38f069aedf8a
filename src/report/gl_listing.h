#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "plan/plan.h"

namespace gnomon {

/// The OpenGL calls of pass @p pass of @p plan as lines of C that can be copied: all state that any pass of
/// the plan depends on, then what is drawn. State that no pass turns on is left at OpenGL's default and not
/// named.
///
/// What the program must bring is called by names without "gl": drawScene(colours, light),
/// drawBackdrop(light), drawVolumes(light, first, last, parts) or drawAllVolumes(light, parts),
/// drawBlockers(light), drawSilhouettes(light), drawCasters(light, face), drawRectangle(); and the values
/// background[], blockers, maskTexture, frameTexture, mapOfFace[]. What OpenGL has no call for stands in a
/// comment.
std::string glCalls(const Pass& pass, const Plan& plan);

/// The same of all passes, in their order.
std::vector<std::string> glCalls(const Plan& plan);

/// What comes before the first pass, as lines of C.
std::string glSetup();

/// What @p plan needs beyond OpenGL 1.1, one phrase each: "blend equation REVERSE_SUBTRACT: OpenGL 1.4 or
/// GL_EXT_blend_subtract"; empty if OpenGL 1.1 is enough.
///
/// Source: the OpenGL 4.6 compatibility specification, appendices on versions, and the extension registry
std::vector<std::string> beyondOpenGl11(const Plan& plan);

/// glSetup() and all passes, each with its number and label above it and the chip's own terms where there are
/// some; of volume passes beyond the first few only how many.
/// @param chipTerms  of each pass; may be empty
std::string glListing(const Plan& plan, const std::string& profile,
                      const std::vector<std::string>& chipTerms);

}  // namespace gnomon
