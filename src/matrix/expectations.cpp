#include "matrix/expectations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "matrix/cause_reason.h"

namespace gnomon {
namespace {

/// Some two million lines.
constexpr std::uintmax_t kMostExpectationBytes = 268'435'456;

constexpr const char* kNoReason = "nobody has looked at it yet";
constexpr const char* kUsual = "attenuated gl";  ///< Cell::question() after the id, of the default choice

const std::string kChoice = "choice";

/// One word of the line.
std::string wordOf(const std::string& text) {
    std::string word;
    for (const char c : text) {
        const bool isPlain = static_cast<unsigned char>(c) > ' ' && c != '#' && c != '%';
        word += isPlain ? std::string(1, c) : fmt::format("%{:02x}", static_cast<unsigned char>(c));
    }
    return word;
}

/// @p text without what parts a line.
std::string partOf(std::string text) {
    std::replace(text.begin(), text.end(), ';', ',');
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return text;
}

/// The outcome without its numbers: a reason that holds for one holds for all that are alike in it.
std::string kindOf(const std::string& outcome) {
    std::string kind;
    for (const char c : outcome)
        if (!std::isdigit(static_cast<unsigned char>(c))) kind += c;
    return kind;
}

std::string reasonOf(const Cell& cell) {
    std::vector<std::string> reasons;
    const auto add = [&](const std::string& reason) {
        if (!reason.empty() && std::find(reasons.begin(), reasons.end(), reason) == reasons.end())
            reasons.push_back(partOf(reason));
    };
    for (const auto& cause : cell.causes) add(reasonOf(causeNamed(cause.first)));
    for (const Missing& m : cell.missing) add(m.source);
    return reasons.empty() ? kNoReason : fmt::format("{}", fmt::join(reasons, ", "));
}

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// Reads one line after the other.
class Parser {
  public:
    explicit Parser(const std::string& file) { m_out.file = file; }

    void line(const std::string& text) {
        ++m_line;
        const std::string content = trimmed(text);
        const bool isHead = m_out.choiceLine == 0 && m_out.cells.empty();
        if (content.empty() || content[0] == '#') {
            if (isHead) m_out.comments.push_back(content);
            return;
        }
        if (content == kChoice || content.starts_with(kChoice + " "))
            choice(content, isHead);
        else
            expectation(content);
    }

    Expectations take() { return std::move(m_out); }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw ExpectationError(fmt::format("{}:{}: {}", m_out.file, m_line, what));
    }

    void choice(const std::string& content, bool isHead) {
        if (!isHead) fail("the choice stands once, before all cells");
        m_out.choice = trimmed(content.substr(kChoice.size()));
        m_out.choiceLine = m_line;
    }

    void expectation(const std::string& content) {
        std::istringstream words(content);
        std::string scene, way, rest, outcome;
        words >> scene >> way >> rest;
        std::getline(words, outcome);
        const std::size_t end = outcome.find(';');
        const Expectation cell{trimmed(outcome.substr(0, end)),
                               end == std::string::npos ? "" : trimmed(outcome.substr(end + 1)), m_line};
        if (way.find('/') == std::string::npos || rest.find('/') == std::string::npos)
            fail("no 'SCENE CHIP/METHOD WxH/FRAME OUTCOME ; WHY'");
        if (!isOutcome(cell.outcome))
            fail(fmt::format("no outcome '{}' (exact, edge, wrong, refused, failed)", cell.outcome));
        if (cell.why.empty()) fail("no reason: the line ends in '; WHY'");
        const std::string place = fmt::format("{} {} {}", scene, way, rest);
        const auto [at, isNew] = m_out.cells.emplace(place, cell);
        if (!isNew) fail(fmt::format("{} a second time, first in line {}", place, at->second.line));
    }

    static bool isOutcome(const std::string& outcome) {
        const std::string word = outcome.substr(0, outcome.find_first_of(" :"));
        for (int v = 0; v <= int(Verdict::Failed); ++v)
            if (word == name(Verdict(v))) return true;
        return false;
    }

    Expectations m_out{};
    int m_line = 0;
};

}  // namespace

std::string placeOf(const Cell& cell) {
    std::string more = cell.question().substr(cell.id().size() + 1);
    std::replace(more.begin(), more.end(), ' ', '/');
    std::string usual = kUsual;
    std::replace(usual.begin(), usual.end(), ' ', '/');
    return fmt::format("{} {} {}", wordOf(cell.scene),
                       wordOf(fmt::format("{}/{}", cell.profile, cell.method)),
                       wordOf(fmt::format("{}x{}/{}{}", cell.width, cell.height, cell.frame,
                                          more == usual ? "" : fmt::format("/{}", more))));
}

std::string outcomeOf(const Cell& cell) {
    std::string text = name(cell.verdict);
    std::vector<std::string> parts;
    if (cell.verdict == Verdict::Edge) text += fmt::format(" {}", cell.wrongEdge);
    if (cell.verdict == Verdict::Wrong) text += fmt::format(" {}+{}", cell.wrongEdge, cell.wrongInterior);
    if (cell.unpredicted > 0) text += fmt::format(" unpredicted {}", cell.unpredicted);
    for (const auto& [cause, pixels] : cell.causes) parts.push_back(fmt::format("{} {}", cause, pixels));
    for (const Missing& m : cell.missing) parts.push_back(m.what);
    if (!cell.error.empty()) parts.push_back(cell.error);
    if (!parts.empty()) text += fmt::format(": {}", fmt::join(parts, ", "));
    return trimmed(partOf(text));
}

std::string Expectations::outcomeAt(const std::string& place) const {
    const auto found = cells.find(place);
    return found == cells.end() ? name(Verdict::Exact) : found->second.outcome;
}

Expectations readExpectations(const std::filesystem::path& file) {
    std::error_code none;
    std::ifstream in(file);
    if (!in || std::filesystem::is_directory(file, none))
        throw ExpectationError(fmt::format(
            "{}: {}", file.string(),
            std::filesystem::exists(file, none) ? "can't be read" : "no such file (--update writes it)"));
    if (const auto size = std::filesystem::file_size(file, none); !none && size > kMostExpectationBytes)
        throw ExpectationError(fmt::format("{}: {} bytes, more than the {} that gnomon reads", file.string(),
                                           size, kMostExpectationBytes));
    Parser parser(file.string());
    for (std::string line; std::getline(in, line);) parser.line(line);
    return parser.take();
}

Expectations updated(const Expectations& before, const std::string& choice, const std::vector<Cell>& cells) {
    Expectations after{.file = before.file, .comments = before.comments, .choice = choice};
    for (const Cell& cell : cells) {
        const std::string place = placeOf(cell), outcome = outcomeOf(cell);
        if (outcome == name(Verdict::Exact)) continue;
        const auto old = before.cells.find(place);
        const bool keeps = old != before.cells.end() && kindOf(old->second.outcome) == kindOf(outcome);
        after.cells[place] = {outcome, keeps ? old->second.why : reasonOf(cell)};
    }
    return after;
}

std::string toText(const Expectations& expectations) {
    std::string text;
    for (const std::string& comment : expectations.comments) text += fmt::format("{}\n", comment);
    text += trimmed(fmt::format("{} {}", kChoice, expectations.choice)) + '\n';
    for (const auto& [place, cell] : expectations.cells)
        text += fmt::format("{} {} ; {}\n", place, cell.outcome, cell.why);
    return text;
}

}  // namespace gnomon
