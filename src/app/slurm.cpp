#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/commands.h"
#include "app/matrix_options.h"
#include "app/shell_words.h"
#include "matrix/cell_list.h"

namespace gnomon {
namespace {

struct SlurmOptions {
    MatrixOptions choice{};
    std::vector<CLI::Option*> choiceFlags{};
    WorkerOptions workers{};
    std::vector<CLI::Option*> workerFlags{};
    std::string folder{}, past{}, pictures = "yes";
    int shards = 2;
};

/// The script: each task of the array is a shard, which goes on where it was when it is queued again; the
/// first submits the job that waits for all of them.
///
/// @param program  this one's file
/// @param words    of gnomon matrix, but --out, --shard and --jobs
/// @param jobs     workers of a task
std::string scriptOf(const std::string& program, const std::string& words, const SlurmOptions& options,
                     int jobs) {
    return fmt::format(
        R"(#!/bin/bash
# A run of gnomon in {shards} shards, on as many machines as there are: sbatch THIS-FILE
# Flags of sbatch, such as --time, can be given there, or here; for the job that comes after, too, as variables that sbatch
# knows, such as SBATCH_TIMELIMIT. Account, partition and quality of service are handed on.
#SBATCH --job-name=gnomon
#SBATCH --array=1-{shards}
#SBATCH --cpus-per-task={jobs}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=gnomon-%A_%a.log
set -euo pipefail
gnomon=${{GNOMON:-{program}}}
out={out}
mkdir -p -- "$out"

# What comes after all shards, and looks whether they are whole. The marker comes last: twice is better than never.
export gnomon out
submitted=$out/merge-$SLURM_ARRAY_JOB_ID
if [ "$SLURM_ARRAY_TASK_ID" = "$SLURM_ARRAY_TASK_MIN" ] && [ ! -e "$submitted" ]; then
    SBATCH_ACCOUNT=${{SLURM_JOB_ACCOUNT:-}} SBATCH_PARTITION=${{SLURM_JOB_PARTITION:-}} SBATCH_QOS=${{SLURM_JOB_QOS:-}}
    for name in SBATCH_ACCOUNT SBATCH_PARTITION SBATCH_QOS; do [ -z "${{!name}}" ] || export "${{name?}}"; done
    if sbatch --dependency="afterany:$SLURM_ARRAY_JOB_ID" --job-name=gnomon-merge --open-mode=append \
        --output="gnomon-${{SLURM_ARRAY_JOB_ID}}_merge.log" <<'MERGE'
#!/bin/bash
set -u
shards=()
for i in $(seq 1 {shards}); do shards+=("$out/shard-$i"); done
"$gnomon" merge "${{shards[@]}}" --out "$out/whole"
merged=$?
# A failed cell is a result, too: status 3 with all cells there.
[ $merged -eq 0 ] || [ $merged -eq 3 ] || exit $merged
"$gnomon" report "$out/whole" -o "$out/report.html"
reported=$?
exit $((merged > reported ? merged : reported))
MERGE
    then touch -- "$submitted"
    else echo "no job could be submitted from here; after all shards: gnomon merge $out/shard-* --out $out/whole" >&2
    fi
fi

exec "$gnomon" matrix{words} \
    --jobs {jobs} --shard "$SLURM_ARRAY_TASK_ID/{shards}" --out "$out/shard-$SLURM_ARRAY_TASK_ID"
)",
        fmt::arg("shards", options.shards), fmt::arg("jobs", jobs), fmt::arg("program", shellWord(program)),
        fmt::arg("out", shellWord(options.folder)), fmt::arg("words", words));
}

int run(const SlurmOptions& options) {
    // What can be refused is refused here, not on every machine.
    const MatrixRequest request = options.choice.load();
    if (const std::size_t cells = CellList(request).count(); cells < std::size_t(options.shards))
        throw UsageError(fmt::format("--shards: {} for {} cells", options.shards, cells));
    std::string words;
    ChoiceWords all = choiceOf(options.choiceFlags);
    for (auto& word : choiceOf(options.workerFlags))
        if (word.first != "--jobs") all.push_back(std::move(word));
    if (!options.past.empty()) all.emplace_back("--past", options.past);
    if (options.pictures == "no") all.emplace_back("--pictures", "no");
    for (const auto& [flag, value] : all) words += fmt::format(" {} {}", flag, shellWord(value));
    const bool hasJobs =
        std::any_of(options.workerFlags.begin(), options.workerFlags.end(),
                    [](const CLI::Option* o) { return o->check_lname("jobs") && o->count() > 0; });
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    fmt::print("{}", scriptOf(error ? "gnomon" : program.string(), words, options,
                              hasJobs ? options.workers.jobs : 1));
    return 0;
}

}  // namespace

void addSlurm(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<SlurmOptions>();
    CLI::App* command = app.add_subcommand(
        "slurm",
        "Prints a script for sbatch that does a run on a cluster: an array of tasks, each a shard, and a "
        "job\n"
        "after them that merges the shards into DIR/whole and writes DIR/report.html. A task that is killed\n"
        "and queued again goes on where it was.");
    const auto addedBy = [&](auto& some) {
        const std::size_t before = command->get_options().size();
        some.addTo(*command);
        const auto flags = command->get_options();
        return std::vector<CLI::Option*>(flags.begin() + std::ptrdiff_t(before), flags.end());
    };
    options->choiceFlags = addedBy(options->choice);
    options->workerFlags = addedBy(options->workers);
    command->add_option("--shards", options->shards, "tasks of the array")
        ->required()
        ->check(CLI::Range(1, 1'000'000));
    command->add_option("--out", options->folder, "where all goes, on a disk that all machines see")
        ->required()
        ->type_name("DIR");
    command
        ->add_option("--pictures", options->pictures, "keep image and mask of each cell, too (default: yes)")
        ->check(CLI::IsMember({"yes", "no"}));
    command
        ->add_option("--past", options->past, "an earlier run there, by whose times the shards are balanced")
        ->type_name("DIR");
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gnomon
