#include "report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <sstream>

namespace gnomon {
namespace {

using TableRow = std::vector<std::string>;
using TableRows = std::vector<TableRow>;

constexpr std::size_t kGap = 2;  ///< blanks between columns
/// Entries of words are broken, but not into lines shorter than this; what is short already stays in one
/// line.
constexpr std::size_t kShortest = 20, kWords = 24;

std::size_t longestWord(const std::string& text) {
    std::istringstream words(text);
    std::size_t longest = 0;
    for (std::string word; words >> word;) longest = std::max(longest, textWidth(word));
    return longest;
}

/// The largest of @p measure over each column.
std::vector<std::size_t> columnsBy(const TableRows& rows, std::size_t (*measure)(const std::string&)) {
    std::vector<std::size_t> widths;
    for (const TableRow& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], measure(row[i]));
    }
    return widths;
}

std::size_t sumOf(const std::vector<std::size_t>& widths) {
    return std::accumulate(widths.begin(), widths.end(), widths.empty() ? 0 : kGap * (widths.size() - 1));
}

/// The same of some of the columns.
std::size_t sumOf(const std::vector<std::size_t>& widths, const std::vector<std::size_t>& columns) {
    std::vector<std::size_t> some;
    for (const std::size_t i : columns) some.push_back(widths[i]);
    return sumOf(some);
}

/// One line of a table; @p widths may be longer than @p row.
std::string lineOf(const TableRow& row, const std::vector<std::size_t>& widths) {
    std::string out;
    for (std::size_t i = 0; i < row.size(); ++i) {
        const std::size_t width = textWidth(row[i]);
        out += row[i] + std::string(std::max(widths[i], width) - width + kGap, ' ');
    }
    while (!out.empty() && out.back() == ' ') out.pop_back();
    return out + "\n";
}

/// The lines of one row whose entries are broken at blanks.
std::string brokenRow(const TableRow& row, const std::vector<std::size_t>& widths) {
    TableRows lines;
    for (std::size_t i = 0; i < row.size(); ++i) {
        // Blanks at the left of an entry set it off; it is broken only where it is too wide.
        std::istringstream parts(textWidth(row[i]) <= widths[i] ? row[i] : wrapText(row[i], 0, widths[i]));
        std::size_t at = 0;
        for (std::string part; std::getline(parts, part); ++at) {
            if (at == lines.size()) lines.emplace_back(row.size());
            lines[at][i] = part;
        }
    }
    std::string text;
    for (const TableRow& line : lines) text += lineOf(line, widths);
    return lines.empty() ? "\n" : text;
}

std::string linesOf(const TableRows& rows, const std::vector<std::size_t>& widths) {
    std::string text;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        text += brokenRow(rows[r], widths);
        if (r > 0) continue;
        TableRow rules;
        for (std::size_t i = 0; i < rows[0].size(); ++i) rules.push_back(std::string(widths[i], '-'));
        text += lineOf(rules, widths);
    }
    return text;
}

/// The widths of columns that are made narrower, the widest first, until they fit; not below @p least.
std::vector<std::size_t> narrowed(std::vector<std::size_t> widths, const std::vector<std::size_t>& least,
                                  std::size_t width) {
    for (std::size_t over = sumOf(widths); over > width; --over) {
        std::size_t widest = widths.size();
        for (std::size_t i = 0; i < widths.size(); ++i)
            if (widths[i] > least[i] && (widest == widths.size() || widths[i] > widths[widest])) widest = i;
        if (widest == widths.size()) break;
        --widths[widest];
    }
    return widths;
}

/// Only these columns of each row, as far as it has them.
TableRows columnsOf(const TableRows& rows, const std::vector<std::size_t>& columns) {
    TableRows some;
    for (const TableRow& row : rows) {
        TableRow& out = some.emplace_back();
        for (const std::size_t i : columns) out.push_back(i < row.size() ? row[i] : "");
    }
    return some;
}

/// Whether the first @p keys entries tell the rows apart.
bool areTold(const TableRows& rows, std::size_t keys) {
    std::set<TableRow> firsts;
    for (const TableRow& row : rows) {
        if (row.size() < keys) return false;
        if (!firsts.insert(TableRow(row.begin(), row.begin() + std::ptrdiff_t(keys))).second) return false;
    }
    return true;
}

/// With their numbers in a first column.
TableRows numbered(TableRows rows) {
    for (std::size_t r = 0; r < rows.size(); ++r)
        rows[r].insert(rows[r].begin(), r == 0 ? "row" : std::to_string(r));
    return rows;
}

}  // namespace

std::size_t textWidth(const std::string& text) {
    std::size_t width = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\x1b') {
            i = std::min(text.find('m', i), text.size() - 1);
            continue;
        }
        width += (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80;
    }
    return width;
}

std::string alignColumns(const std::vector<std::vector<std::string>>& rows, std::size_t width,
                         std::size_t keys) {
    const std::vector<std::size_t> wanted = columnsBy(rows, textWidth);
    if (sumOf(wanted) <= width) return linesOf(rows, wanted);

    // Lines within entries.
    std::vector<std::size_t> least = columnsBy(rows, longestWord);
    for (std::size_t i = 0; i < least.size(); ++i)
        least[i] = wanted[i] < kWords ? wanted[i] : std::min(wanted[i], std::max(least[i], kShortest));
    if (sumOf(least) <= width) return linesOf(rows, narrowed(wanted, least, width));

    // Blocks; each takes as many columns as it can hold unbroken, and at least one.
    const bool isTold = areTold(rows, keys);
    const TableRows all = isTold ? rows : numbered(rows);
    const std::vector<std::size_t> widths = columnsBy(all, textWidth);
    std::vector<std::size_t> head;
    for (std::size_t i = 0; i < (isTold ? std::min(keys, widths.size()) : 1); ++i) head.push_back(i);
    std::vector<std::vector<std::size_t>> blocks;
    for (std::size_t i = head.size(); i < widths.size(); ++i) {
        std::vector<std::size_t> block = blocks.empty() ? head : blocks.back();
        block.push_back(i);
        if (blocks.empty() || sumOf(widths, block) > width) {
            blocks.push_back(head);
            blocks.back().push_back(i);
        } else {
            blocks.back() = std::move(block);
        }
    }
    if (blocks.size() < 2) return linesOf(all, narrowed(widths, columnsBy(all, longestWord), width));
    std::string text;
    for (const auto& block : blocks)
        text += fmt::format("{}{}", text.empty() ? "" : "\n",
                            alignColumns(columnsOf(all, block), width, head.size()));
    return text;
}

std::string csvLine(const std::vector<std::string>& fields) {
    std::string line;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (i > 0) line += ',';
        if (fields[i].find_first_of(",\"\r\n") == std::string::npos) {
            line += fields[i];
            continue;
        }
        line += '"';
        for (const char c : fields[i]) line += c == '"' ? std::string("\"\"") : std::string(1, c);
        line += '"';
    }
    return line + "\r\n";
}

std::string wrapText(const std::string& text, std::size_t indent, std::size_t width) {
    std::istringstream words(text);
    std::string out, line;
    for (std::string word; words >> word;) {
        if (!line.empty() && indent + textWidth(line) + 1 + textWidth(word) > width) {
            out += line + "\n" + std::string(indent, ' ');
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
    }
    return out + line;
}

}  // namespace gnomon
