#include "text/one_line.h"

#include <algorithm>

namespace gnomon {
namespace {

bool breaksLine(char c) {
    return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f;
}

}  // namespace

bool isOneLine(std::string_view text) {
    return std::none_of(text.begin(), text.end(), breaksLine);
}

std::string oneLine(std::string text) {
    std::replace_if(text.begin(), text.end(), breaksLine, ' ');
    return text;
}

}  // namespace gnomon
