#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gl/device.h"
#include "matrix/run.h"
#include "report/page.h"
#include "scene/scene.h"

namespace gnomon {

/// What `gnomon reproduce` was asked for, besides the paper. What a paper has no use for is refused.
struct ReproduceOptions {
    std::optional<int> table{};  ///< none: all of the paper's
    Page page{};
    std::optional<std::vector<Scene>> scenes{};  ///< in the place of those that come with gnomon
    std::optional<Size> size{};
    std::optional<int> frames{}, repeats{};  ///< of each scene's path; rounds
    std::vector<int> subdivide{};            ///< by scene: how often its meshes are cut in four
    std::filesystem::path plot{};            ///< where a figure goes; empty: nowhere
    bool measures = false;                   ///< times frames on this machine, too
    Device device = defaultDevice();

    bool wants(int number) const { return !table || *table == number; }
};

/// A paper whose figures are reproduced.
struct ReproducedPaper {
    std::string id{};               ///< "roettger2002"
    std::vector<int> tables{};      ///< numbers in the paper; empty: it is taken as a whole
    std::set<std::string> flags{};  ///< of "--scene", "--size"..., those that it takes
    /// Prints the figures, published beside ours.
    /// @return the exit status: 1 if a figure that must agree differs
    int (*run)(const ReproduceOptions&) = nullptr;
};

// Each in a file of its own, src/app/reproduce_<paper>.cpp.
int reproduceRoettger2002(const ReproduceOptions& options);
int reproduceKolivand2011(const ReproduceOptions& options);
int reproduceAldridge(const ReproduceOptions& options);
int reproduceUsta2019(const ReproduceOptions& options);

/// The scenes that were given, or those with these @p ids.
std::vector<Scene> scenesOf(const ReproduceOptions& options, const std::vector<std::string>& ids);

/// How the machine's figures are measured on a device: the driver, and whose time is taken.
std::string measuredOn(Device device);

}  // namespace gnomon
