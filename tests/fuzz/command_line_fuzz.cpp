// A command line, an argument in each line of the input: parsed but not run, and its choice of cells taken as
// its words are; what can't be understood is refused in one line.

#include <sstream>
#include <vector>

#include "app/command_line.h"
#include "app/matrix_options.h"
#include "fuzz.h"

namespace gnomon::fuzz {
namespace {

/// What the options of `matrix` and `check` come to, without the files that they name.
void checkChoice(const MatrixOptions& options) {
    std::string dropped;
    require(!options.methods.axes(dropped).empty() && isOneLine(dropped), "methods");
    require(!options.methods.shadeList().empty(), "shades");
    for (const Size& size : options.sizes.value())
        require(size.width >= 1 && size.width <= 8192 && size.height >= 1 && size.height <= 8192, "size");
    for (const int frame : parseFrames(options.frames)) require(frame >= 0 && frame <= 99'999, "frame");
    require(!options.fidelity.value({}).empty(), "fidelities");
    options.effects.value();
    SceneOption again;
    again.place(options.scenes.view());
    require(again.view() == options.scenes.view(), "view");
}

}  // namespace
}  // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon;
    using namespace gnomon::fuzz;
    std::vector<std::string> words{"gnomon"};
    std::istringstream lines{std::string(textOf(data, size))};
    for (std::string line; std::getline(lines, line);)
        words.push_back(line.substr(0, line.find('\0')));  // as the system would
    std::vector<const char*> arguments;
    for (const std::string& word : words) arguments.push_back(word.c_str());

    takenOrRefused<UsageError>("", [&] {
        static CommandLine commandLine;
        require(bool(commandLine.parse(int(arguments.size()), arguments.data())), "nothing to run");
    });
    takenOrRefused<UsageError>("", [&] {
        std::string line;
        for (std::size_t i = 2; i < words.size(); ++i) line += (i > 2 ? " " : "") + words[i];
        checkChoice(optionsOf(choiceFrom(line)));
    });
    return 0;
}
