#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// One cell that a hard case makes a promise about, in the words of the command line. Nothing here is
/// resolved: scenes know neither chips nor methods nor causes.
struct HardCell {
    std::string method{};
    std::string profile{"ideal"};
    /// Of axes where the named method is not it: flag without dashes -> value, such as "levels" -> "4".
    std::map<std::string, std::string> options{};
    std::string fidelity{"gl"};
    bool dithers = false;
    int frame = 0;
    int width = 320, height = 240;  ///< pixels
    std::string cause{};            ///< why it must be wrong; empty where it must be exact
    std::size_t line = 0;           ///< in the scene file
};

/// What a scene file says of itself as a hard case.
struct HardCase {
    std::string family{};           ///< a word or short phrase that related cases share
    std::string what{};             ///< one line: what is hard
    std::string source{};           ///< the bug report, paper or textbook fact that it stems from
    std::vector<HardCell> fails{};  ///< these must be wrong, and for their cause
    std::vector<HardCell> exact{};  ///< these must be exact
};

/// The axes' flags that a cell of a hard case may set, without dashes.
std::span<const std::string_view> hardOptions();

/// The cell as arguments of a command: "--method carmack --profile ideal --levels 4".
std::string argumentsOf(const HardCell& cell);

}  // namespace gnomon
