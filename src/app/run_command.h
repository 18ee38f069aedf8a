#pragma once

#include <string>
#include <vector>

#include "report/run_pictures.h"

namespace gnomon {

/// The `gnomon matrix` command that asks for such cells, as far as the defaults leave something to say,
/// with its words as the shell takes them.
std::string commandOf(const std::vector<Cell>& cells, const RunSources& sources);

}  // namespace gnomon
