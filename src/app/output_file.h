#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gnomon {

/// Refuses a file that the user has named for an output and that could not be written, before anything is
/// drawn. An empty name is none, and passes.
/// @param endings  that it may have: ".svg"
/// @param what     the refusal of another: "a plot's name ends in .svg or .png"
/// @throws UsageError  "file: what"
void checkOutputFile(const std::string& file, const std::vector<std::string>& endings,
                     const std::string& what);

/// The same of a plot: .svg or .png.
void checkPlotFile(const std::string& file);

/// Calls @p write, whose failure is about a file that the user has chosen.
/// @throws UsageError  in place of what it throws
void writeChosen(const std::function<void()>& write);

}  // namespace gnomon
