#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "matrix/run_store.h"

namespace gnomon {

/// --out and what goes with it, --shard, --past: where a run is kept, and which part of it is drawn.
struct KeepOptions {
    std::string folder{}, reused{}, past{}, shard{}, pictures = "yes";
    bool retries = false;

    void addTo(CLI::App& app);
    /// Only what says which part is drawn.
    void addShardTo(CLI::App& app);
    /// Says to @p request which part it is, and where pictures go.
    /// @throws UsageError, StoreError
    void applyTo(MatrixRequest& request) const;
    /// The run that is begun or gone on with; notes about it go to standard error. Nothing without --out.
    /// @throws StoreError, UsageError
    std::unique_ptr<RunStore> open(const MatrixRequest& request) const;
};

/// "out: 378 cells, 120 of them from before; digest 0123456789abcdef".
std::string keptText(const RunStore& run);

}  // namespace gnomon
