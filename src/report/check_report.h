#pragma once

#include <functional>
#include <string>

#include "matrix/check.h"
#include "report/page.h"

namespace gnomon {

/// The command line that draws a cell again.
using CommandOfCell = std::function<std::string(const Cell&)>;

/// For people: how many cells are of which class, and the first of those that are not as expected, each with
/// the command that draws it. JSON and CSV have every cell.
std::string showCheck(const CheckResult& result, Format format, const CommandOfCell& command);

/// The same of every cell in JUnit's XML: a suite for each scene, a test case for each cell.
/// @param name  of the whole: the file of expectations
std::string checkJUnit(const CheckResult& result, const std::string& name, const CommandOfCell& command);

}  // namespace gnomon
