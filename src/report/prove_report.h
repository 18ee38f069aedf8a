#pragma once

#include <optional>
#include <string>
#include <vector>

#include "profile/prove.h"
#include "report/listings.h"

namespace gnomon {

/// What is proved, or refused, of one channel of one chip.
struct ProofRow {
    std::string profile{}, store{}, format{};  ///< "voodoo2", "screen", "565"
    MaskClaim claim{};
    std::optional<Evidence> grade{};  ///< for the blend unit
    std::optional<MaskProof> proof{};
    std::string refused{}, source{};  ///< what the chip lacks, and who says so; if there is no proof
};

std::string showProofs(const std::vector<ProofRow>& rows, Format format);

}  // namespace gnomon
