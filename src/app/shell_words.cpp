#include "app/shell_words.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string_view>

namespace gnomon {

std::string shellWord(const std::string& word) {
    const auto isPlain = [](unsigned char c) {
        return std::isalnum(c) || std::string_view("_./,:=+-").find(char(c)) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), isPlain)) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string shellLine(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + shellWord(word);
    return line;
}

std::string ownCommandLine() {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> words;
    for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
    return shellLine(words);
}

}  // namespace gnomon
