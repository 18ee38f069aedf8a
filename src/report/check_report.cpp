#include "report/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "report/json_csv.h"

namespace gnomon {
namespace {

constexpr std::size_t kMostShown = 20;

/// What an attribute or a text of XML 1.0 may hold.
std::string xml(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\n':
                out += c;
                break;
            default:
                out += static_cast<unsigned char>(c) < ' ' ? '?' : c;
        }
    }
    return out;
}

/// What is to be known of a cell that is not as expected, in lines.
std::string details(const CheckedCell& cell, const CommandOfCell& command, const std::string& indent) {
    std::string text = fmt::format("{0}expected: {1}\n{0}found:    {2}\n", indent, cell.expected, cell.found);
    if (!cell.why.empty()) text += fmt::format("{}why:      {}\n", indent, cell.why);
    if (cell.what != CheckClass::Missing) text += fmt::format("{}{}\n", indent, command(cell.cell));
    return text;
}

std::string sceneOf(const CheckedCell& cell) {
    return cell.place.substr(0, cell.place.find(' '));
}

std::string testCase(const CheckedCell& cell, const CommandOfCell& command) {
    const std::size_t way = cell.place.find(' ') + 1, rest = cell.place.find(' ', way) + 1;
    const std::string head =
        fmt::format("    <testcase classname=\"{}.{}\" name=\"{}\" time=\"{:.6f}\"", xml(sceneOf(cell)),
                    xml(cell.place.substr(way, rest - 1 - way)), xml(cell.place.substr(rest)),
                    (cell.cell.cpuMs + cell.cell.unshadowedMs) / 1000);
    if (cell.what == CheckClass::Expected) return head + "/>\n";
    const std::string message =
        fmt::format("{}: expected {}, found {}", name(cell.what), cell.expected, cell.found);
    return fmt::format("{}>\n      <failure type=\"{}\" message=\"{}\">{}</failure>\n    </testcase>\n", head,
                       name(cell.what), xml(message), xml(details(cell, command, "")));
}

std::size_t failures(const std::vector<const CheckedCell*>& cells) {
    return std::size_t(std::count_if(cells.begin(), cells.end(), [](const CheckedCell* cell) {
        return cell->what != CheckClass::Expected;
    }));
}

std::string checkText(const CheckResult& result, const CommandOfCell& command) {
    std::string text = fmt::format("{} cells:", result.cells.size());
    for (int c = 0; c < kCheckClasses; ++c)
        text += fmt::format("{} {} {}", c ? "," : "", result.count(CheckClass(c)), name(CheckClass(c)));
    text += "\n";
    if (result.outside > 0)
        text += fmt::format("{} line{} of the file outside of this choice\n", result.outside,
                            result.outside == 1 ? "" : "s");
    std::size_t shown = 0, left = 0;
    for (const CheckedCell& cell : result.cells) {
        if (cell.what == CheckClass::Expected) continue;
        if (shown == kMostShown) {
            ++left;
            continue;
        }
        ++shown;
        text += fmt::format("\n{}: {}\n{}", name(cell.what), cell.place, details(cell, command, "  "));
    }
    if (left > 0) text += fmt::format("\nand {} more (--format json has all)\n", left);
    return text;
}

/// A row of each cell.
nlohmann::ordered_json rowsOf(const CheckResult& result, const CommandOfCell& command) {
    auto rows = nlohmann::ordered_json::array();
    for (const CheckedCell& cell : result.cells) {
        const bool isThere = cell.what != CheckClass::Missing;
        rows.push_back({{"class", name(cell.what)},
                        {"place", cell.place},
                        {"cell", isThere ? cell.cell.id() : ""},
                        {"expected", cell.expected},
                        {"found", cell.found},
                        {"why", cell.why},
                        {"command", isThere ? command(cell.cell) : ""}});
    }
    return rows;
}

}  // namespace

std::string showCheck(const CheckResult& result, Format format, const CommandOfCell& command) {
    if (format == Format::Text) return checkText(result, command);
    const auto rows = rowsOf(result, command);
    return format == Format::Csv ? csvOf(rows) : rows.dump(1) + "\n";
}

std::string checkJUnit(const CheckResult& result, const std::string& name, const CommandOfCell& command) {
    std::vector<std::string> scenes;
    for (const CheckedCell& cell : result.cells)
        if (std::find(scenes.begin(), scenes.end(), sceneOf(cell)) == scenes.end())
            scenes.push_back(sceneOf(cell));
    std::string suites;
    std::size_t failed = 0;
    for (const std::string& scene : scenes) {
        std::vector<const CheckedCell*> cells;
        for (const CheckedCell& cell : result.cells)
            if (sceneOf(cell) == scene) cells.push_back(&cell);
        failed += failures(cells);
        suites +=
            fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\">\n",
                        xml(scene), cells.size(), failures(cells));
        for (const CheckedCell* cell : cells) suites += testCase(*cell, command);
        suites += "  </testsuite>\n";
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<testsuites name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\">\n{}</testsuites>\n",
        xml(name), result.cells.size(), failed, suites);
}

}  // namespace gnomon
