#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "image/image.h"
#include "report/page.h"

namespace gnomon {

/// --show: a picture among the text on standard output.
struct ShowOption {
    std::string word{};
    void addTo(CLI::App& app);
    bool isGiven() const { return !word.empty(); }
    /// Refuses a picture among JSON or CSV.
    /// @throws UsageError
    void check(const Page& page) const;
    /// @p image in characters or sixels, made no larger, and no wider than the terminal; 80 characters where
    /// there is none.
    std::string text(const Image& image) const;
};

}  // namespace gnomon
