#pragma once

#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace gnomon {

/// Scene and chip/method of each line of @p name in this folder: what is known not to come out as it should.
/// @throws std::runtime_error if the file is missing
inline std::set<std::pair<std::string, std::string>> knownResults(const std::string& name) {
    const std::string path = GNOMON_SOURCE "/tests/expected/" + name;
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path + " is missing");
    std::set<std::pair<std::string, std::string>> known;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        std::string scene, way;
        words >> scene >> way;
        known.emplace(scene, way);
    }
    return known;
}

}  // namespace gnomon
