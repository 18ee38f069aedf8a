#pragma once

#include <optional>
#include <string>
#include <vector>

#include "profile/prove.h"
#include "report/page.h"

namespace gnomon {

/// What is proved, or refused, of one channel of one chip.
struct ProofRow {
    std::string profile{}, store{}, format{};  ///< "voodoo2", "screen", "565"
    MaskClaim claim{};
    std::optional<int> levels{};      ///< double from 2^-levels; none: from the best start
    std::optional<Evidence> grade{};  ///< for the blend unit
    bool isDefaultDither = false;     ///< of several modes, the one that its driver takes
    std::optional<MaskProof> proof{};
    std::string refused{}, source{};  ///< what the chip lacks, and who says so; if there is no proof
};

/// What the proof says, in words: "up to 5 open, half = 128 (127: up to 4 open)".
std::string verdictOf(const ProofRow& row);

/// As text: what holds in words, a paragraph for each chip, store and arithmetic; then the figures of the
/// best starts, a legend, and what is refused. As JSON and CSV: one row per proof.
std::string showProofs(const std::vector<ProofRow>& rows, const Page& page);

}  // namespace gnomon
