#pragma once

#include <string>
#include <vector>

namespace gnomon {

/// A word as the shell takes it.
std::string shellWord(const std::string& word);

/// A command as the shell takes it.
std::string shellLine(const std::vector<std::string>& words);

/// The command line of this process, as the shell takes it; "" if the system doesn't say.
std::string ownCommandLine();

}  // namespace gnomon
