#include "app/path.h"

#include <fmt/format.h>

#include "report/table.h"

namespace gnomon {

std::optional<Axes> choosePath(Lab& lab, const Profile& profile, Shade shade, int width, int height,
                               int frame, std::string& words) {
    std::optional<Axes> chosen;
    for (const Lab::Candidate& candidate : lab.path(profile, width, height, frame)) {
        if (candidate.missing.empty()) {
            chosen = candidate.axes;
            chosen->shade = shade;
            words += fmt::format("{}: chosen for {}\n", methodId(candidate.axes), profile.id);
            continue;
        }
        words += fmt::format("{}: not on {}, which lacks\n", methodId(candidate.axes), profile.id);
        for (const Missing& m : candidate.missing)
            words += fmt::format("  {}\n", wrapText(fmt::format("{} [{}]", m.what, m.source), 4));
    }
    if (!chosen) words += fmt::format("{} can run none of them\n", profile.id);
    return chosen;
}

}  // namespace gnomon
