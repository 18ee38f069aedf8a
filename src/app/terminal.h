#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "report/progress_bar.h"

namespace gnomon {

/// Whether what is written to @p file goes to a terminal that understands more than plain lines: TERM is set,
/// and not "dumb".
bool isTerminal(int file);

/// Whether colours are welcome there: it is a terminal, and NO_COLOR (no-color.org) is not set.
bool takesColours(int file);

/// Columns of the terminal behind @p file now, from the system; 80 where it does not say.
std::size_t windowColumns(int file);

/// Columns for texts on standard output: those of a terminal, or COLUMNS where it is set to a number; where
/// it is no terminal, kPageColumns.
std::size_t textColumns();

/// Columns for a picture on standard output: as textColumns(), but 80 where it is no terminal.
std::size_t pictureColumns();

/// Pixels across the terminal behind @p file; 8 a column where it does not say.
std::size_t windowPixels(int file);

/// Whether the answer to the question for primary device attributes (ECMA-48's DA, "ESC [ c") has sixel
/// graphics among them: "ESC [ ? n ; ... ; 4 ; ... c".
bool namesSixel(const std::string& answer);

/// Asks the terminal on standard output whether it has sixel graphics; false if there is none, or if it does
/// not answer within 200 ms.
bool terminalHasSixel();

/// A progress bar on standard error; nothing at all where that is no terminal. It is taken away when this
/// object goes.
class TerminalProgress {
  public:
    /// @param unit  of a step, in the plural: "cells"
    explicit TerminalProgress(const std::string& unit);
    ~TerminalProgress() { clear(); }
    TerminalProgress(const TerminalProgress&) = delete;
    TerminalProgress& operator=(const TerminalProgress&) = delete;

    void show(const Progress& progress);
    void clear();

  private:
    bool m_isShown = false;
    std::chrono::steady_clock::time_point m_start{};
    ProgressBar m_bar;
};

}  // namespace gnomon
