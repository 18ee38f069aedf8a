#include "report/verdict_colour.h"

#include <fmt/format.h>

namespace gnomon {
namespace {

/// The parameter of the sequence "ESC [ n m".
int codeOf(Verdict verdict) {
    switch (verdict) {
        case Verdict::Exact:
            return 32;
        case Verdict::Edge:
            return 33;
        case Verdict::Wrong:
        case Verdict::Failed:
            return 31;
        case Verdict::Refused:
            return 2;
    }
    return 0;
}

}  // namespace

std::string inColour(const std::string& text, Verdict verdict, bool colours) {
    return colours ? fmt::format("\x1b[{}m{}\x1b[0m", codeOf(verdict), text) : text;
}

}  // namespace gnomon
