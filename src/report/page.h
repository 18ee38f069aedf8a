#pragma once

#include <cstddef>

namespace gnomon {

enum class Format { Text, Json, Csv };

/// The widest line of a text that no terminal shows, columns.
constexpr std::size_t kPageColumns = 100;

/// What a report is written for. The width and the colours are those of a text; JSON and CSV have neither.
struct Page {
    Format format = Format::Text;
    std::size_t width = kPageColumns;  ///< columns; wider only where a single word or number needs it
    bool colours = false;              ///< verdicts in colours, by escape sequences

    Page() = default;
    /// A format alone is a page of the usual width; not explicit, so that it can stand for one.
    Page(Format f) : format(f) {}
};

}  // namespace gnomon
