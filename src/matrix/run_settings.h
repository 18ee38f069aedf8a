#pragma once

#include <string>
#include <utility>
#include <vector>

#include "matrix/run.h"
#include "matrix/run_maker.h"

namespace gnomon {

/// What all cells of a run have in common, in words: names and values, of which some are lists with commas.
using RunSettings = std::vector<std::pair<std::string, std::string>>;

/// What a run must have to go on with another: what is asked, and what answers. The processor is not in it;
/// results don't depend on it.
RunSettings settingsOf(const MatrixRequest& request, const RunMaker& maker);

/// The value of a setting; "" if there is none.
std::string settingOf(const RunSettings& settings, const std::string& name);
/// @p settings with another value of @p name.
RunSettings withSetting(RunSettings settings, const std::string& name, const std::string& value);

/// @p settings with the limits of @p other, on which no result depends but that of a failed cell.
RunSettings withLimitsOf(RunSettings settings, const RunSettings& other);

/// How @p asked differs from @p kept, in one line: "profiles: with tnt, without ps2; sizes: 64x48, there
/// 320x240". "" if they are the same.
std::string differenceOf(const RunSettings& kept, const RunSettings& asked);

/// "2/4".
std::string toText(const Shard& shard);
/// Inverse of toText(); a shard of count 0 if @p text is none.
Shard shardFrom(const std::string& text);

}  // namespace gnomon
