#include "app/show.h"

#include <unistd.h>

#include "app/options.h"
#include "app/terminal.h"
#include "image/half_blocks.h"
#include "image/scale.h"
#include "image/sixel.h"

namespace gnomon {

void ShowOption::addTo(CLI::App& app) {
    app.add_option("--show", word,
                   "the picture in the terminal: sixel, blocks (half blocks in 24-bit colour), ascii (dark "
                   "letters on a light ground), auto (sixel where the terminal has it, else "
                   "blocks; ascii where there is no terminal, or NO_COLOR is set)")
        ->check(CLI::IsMember({"auto", "sixel", "blocks", "ascii"}));
}

void ShowOption::check(const Page& page) const {
    if (isGiven() && page.format != Format::Text) throw UsageError("--show: goes with --format text only");
}

std::string ShowOption::text(const Image& image) const {
    const bool isSixel =
        word == "sixel" || (word == "auto" && takesColours(STDOUT_FILENO) && terminalHasSixel());
    if (isSixel) return sixel(fitted(image, int(windowPixels(STDOUT_FILENO)))) + "\n";
    const Image small = fitted(image, int(pictureColumns()));
    const bool isPlain = word == "auto" && !takesColours(STDOUT_FILENO);
    return word == "ascii" || isPlain ? letterPicture(small) : halfBlocks(small);
}

}  // namespace gnomon
