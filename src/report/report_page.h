#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "report/run_json.h"
#include "report/run_pictures.h"

namespace gnomon {

/// The page of the report as it was built into gnomon, without data.
std::string_view bundledPage();

/// One HTML file of a page and its data: the line `<!-- gnomon:data -->` of @p page gives way to three
/// blocks: the index of the others, @p run (runJson) deflated, and the pictures' chunks.
/// @throws std::runtime_error if @p page has no such line
std::string withData(std::string_view page, const nlohmann::ordered_json& run, const RunPictures& pictures);

/// A report is larger than it may be, even without pictures.
struct ReportTooLarge : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The report as one file of at most @p limit bytes: pictures that don't fit are left out (fitted()).
/// @throws ReportTooLarge
std::string reportPage(std::string_view page, Report report, std::size_t limit);

}  // namespace gnomon
