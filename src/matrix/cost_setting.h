#pragma once

#include <optional>
#include <string>
#include <vector>

#include "matrix/frame_time.h"

namespace gnomon {

/// One way to draw shadows, as it stands beside others in a study of cost.
struct CostSetting {
    std::string name{};    ///< "roettger-screen", "roettger-screen levels 3", "heidmann chip"; no two alike
    TimedWay way{};        ///< its axes may be automatic: then they are chosen for each frame
    bool isNamed = false;  ///< a row of the table of named methods as it stands there
};

/// A method's name for people: that of the named row that it equals, or of one that it differs from in one
/// axis, with that ("roettger-screen levels 3"); else methodId(). A shade other than the default is added.
std::string settingName(const Axes& axes);

/// What is compared if the user names nothing: the named methods at @p shade; some of them with other levels,
/// silhouettes and sizes of the depth map; all named ones in the chip's own arithmetic too, where it has one
/// and @p fidelity isn't named; some in its other depth formats, where it has several.
/// @param fidelities  those that were asked for; empty: OpenGL's, and the chip's where that is another
std::vector<CostSetting> costSweep(const Profile& profile, Shade shade,
                                   const std::vector<FidelityChoice>& fidelities,
                                   const std::optional<Effects>& effects);

/// @p methods at each of @p fidelities, named.
std::vector<CostSetting> costSettings(const Profile& profile, const std::vector<Axes>& methods,
                                      const std::vector<FidelityChoice>& fidelities,
                                      const std::optional<Effects>& effects);

}  // namespace gnomon
