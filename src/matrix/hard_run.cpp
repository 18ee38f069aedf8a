#include "matrix/hard_run.h"

#include <fmt/format.h>

#include <stdexcept>

#include "method/from_words.h"
#include "scene/text.h"

namespace gnomon {
namespace {

Cause causeOf(const HardCell& cell) {
    const Cause cause = causeNamed(cell.cause);
    if (cause == Cause::None && !cell.cause.empty())
        throw std::runtime_error(fmt::format("no such cause '{}'", printable(cell.cause)));
    return cause;
}

}  // namespace

HardRun resolve(const HardCell& cell, const std::filesystem::path& profiles) {
    return {.profile = loadProfile(profiles / (cell.profile + ".toml")),
            .axes = axesFromWords(cell.method, cell.options),
            .fidelity = {.fidelity = cell.fidelity == "chip" ? Fidelity::Chip : Fidelity::Gl,
                         .dithers = cell.dithers},
            .cause = causeOf(cell),
            .width = cell.width,
            .height = cell.height,
            .frame = cell.frame};
}

Cell run(Lab& lab, const HardRun& what) {
    lab.use(what.fidelity);
    return lab.run(what.profile, what.axes, what.width, what.height, what.frame);
}

}  // namespace gnomon
