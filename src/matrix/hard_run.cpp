#include "matrix/hard_run.h"

#include "method/from_words.h"

namespace gnomon {

HardRun resolve(const HardCell& cell, const std::filesystem::path& profiles) {
    return {.profile = loadProfile(profiles / (cell.profile + ".toml")),
            .axes = axesFromWords(cell.method, cell.options),
            .fidelity = {.fidelity = cell.fidelity == "chip" ? Fidelity::Chip : Fidelity::Gl,
                         .dithers = cell.dithers},
            .width = cell.width,
            .height = cell.height,
            .frame = cell.frame};
}

Cell run(Lab& lab, const HardRun& what) {
    lab.use(what.fidelity);
    return lab.run(what.profile, what.axes, what.width, what.height, what.frame);
}

}  // namespace gnomon
