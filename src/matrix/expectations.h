#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "matrix/cell.h"

namespace gnomon {

/// A file of expectations that can't be used. what() is one line, "file:line: what" or "file: what".
struct ExpectationError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Where a cell stands in a file of expectations, three words: scene, chip/method, WxH/frame with what else
/// was asked for ("320x240/0/ambient/chip") where that is not the default.
std::string placeOf(const Cell& cell);

/// What came of a cell, in one line: "exact", "edge 5: low mask resolution 5", "wrong 2+7: mask clamps 9" (at
/// the boundary of shadows, and away from it), "refused: stencil", "failed: crashed: signal 11".
std::string outcomeOf(const Cell& cell);

/// One line of the file.
struct Expectation {
    std::string outcome{};  ///< outcomeOf()
    std::string why{};      ///< for people
    int line = 0;
};

/// What is known of the cells of a choice: those that are not listed must be exact.
struct Expectations {
    std::string file{};
    std::vector<std::string> comments{};  ///< lines before the choice
    std::string choice{};                 ///< words of a command line; "": the whole matrix
    int choiceLine = 0;
    std::map<std::string, Expectation> cells{};  ///< by place

    /// What is expected at @p place.
    std::string outcomeAt(const std::string& place) const;
};

/// Reads lines "SCENE CHIP/METHOD WxH/FRAME OUTCOME ; WHY", after a line "choice WORDS"; '#' begins a
/// comment.
/// @throws ExpectationError
Expectations readExpectations(const std::filesystem::path& file);

/// The expectations that @p cells meet. A line keeps its reason as long as its outcome has the same verdict
/// and causes; a new one gets the reason of its cause, or for a refusal its source.
Expectations updated(const Expectations& before, const std::string& choice, const std::vector<Cell>& cells);

/// The file's content.
std::string toText(const Expectations& expectations);

}  // namespace gnomon
