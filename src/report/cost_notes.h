#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cost/model.h"
#include "report/page.h"

namespace gnomon {

/// What a plan takes on a chip by the model, with what it stands on.
struct CostNotes {
    FrameCost minimal{}, full{};
    std::vector<std::string> rates{};  ///< modelRates() of the chip

    /// Whether the profile has any rate that the frame calls for.
    bool hasTimes() const { return minimal.ms() > 0; }
};

/// "0.42", milliseconds; "-" of no time.
std::string msText(double ms);

/// "fill"; "-" without a limit.
std::string limitText(const std::optional<Resource>& limit);

/// For people: time and frames per second, the limit, the rates with their sources, and what is missing.
std::string costText(const CostNotes& notes, std::size_t width = kPageColumns);

/// {"ms":...,"limit":"fill","fill_ms":...,"bandwidth_ms":...,"triangles_ms":...,"bus_ms":...,"fragments":...,
/// "passed":...,"bytes":...,"bus_bytes":...}; a limit of nothing is null.
nlohmann::ordered_json toJson(const PassCost& pass);

/// {"ms":...,"chip_ms":...,"host_ms":...,"frames_per_second":...,"limit":...,"bytes":...,"missing":[]};
/// without any rate times are null.
nlohmann::ordered_json toJson(const FrameCost& frame);

/// toJson() of the minimal plan, with its rates and the full plan's.
nlohmann::ordered_json toJson(const CostNotes& notes);

}  // namespace gnomon
