#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "gl/device.h"
#include "matrix/run.h"
#include "method/method.h"
#include "profile/profile.h"
#include "report/page.h"
#include "scene/load.h"
#include "text/one_line.h"

namespace gnomon {

/// A bad argument; what() is one line, whatever the argument holds.
struct UsageError : std::runtime_error {
    explicit UsageError(const std::string& what) : std::runtime_error(oneLine(what)) {}
};

/// The one value of a flag that other commands take several of.
/// @throws UsageError if there are more
template <class T>
T theOnly(const std::string& flag, std::vector<T> values) {
    if (values.size() != 1)
        throw UsageError(flag + ": " + std::to_string(values.size()) + " given, but this command takes one");
    return std::move(values.front());
}

/// Where profiles/ or scenes/ lies: beside the program or in a folder above it, or in share/gnomon there.
/// @throws UsageError if there is none
std::filesystem::path dataFolder(const std::string& name);

/// --format, and --colour where there are verdicts.
struct FormatOption {
    std::string word = "text", colour = "auto";
    void addTo(CLI::App& app);
    void addColourTo(CLI::App& app);
    /// As wide as the terminal on standard output, kPageColumns where there is none. Colours are asked for,
    /// or the terminal has them and NO_COLOR (no-color.org) is not set.
    Page value() const;
};

/// --profile, each a comma list; file names are taken as well as ids.
struct ProfileOption {
    std::vector<std::string> ids{};
    void addTo(CLI::App& app, const std::string& help);
    /// @p fallback: the ids when none is given; empty: all
    std::vector<Profile> load(const std::vector<std::string>& fallback = {}) const;
};

/// --scene, and where light and camera stand.
struct SceneOption {
    std::vector<std::string> ids{};
    std::string light{}, eye{}, target{}, ground{}, lights{};
    std::optional<double> fov{}, near{};
    void addTo(CLI::App& app, const std::string& help);
    /// @p fallback: the ids when none is given; empty: those in scenes/ itself. The id "hard" stands for all
    /// of scenes/hard, "all" for both.
    std::vector<Scene> load(const std::vector<std::string>& fallback = {}) const;
    /// Cell::view: what was given of where light and camera stand.
    std::map<std::string, std::string> view() const;
    /// Takes a Cell::view back.
    /// @throws UsageError  an unknown flag, or a value that is no number
    void place(const std::map<std::string, std::string>& view);
};

/// --method and the axes.
struct MethodOption {
    std::vector<std::string> ids{}, stores{}, arithmetics{}, counts{}, silhouettes{}, maskScales{}, applies{},
        shades{}, starts{}, overflows{}, caps{}, clips{};
    std::vector<int> levels{}, mapSizes{};
    std::vector<float> offsets{}, mapBiases{};
    void addTo(CLI::App& app);
    bool isEmpty() const;  ///< no method and no axis but the shade
    /// The product of what is listed; axes not named keep the defaults of their method, or of the table of
    /// named methods. Combinations that contradict themselves are left out; @p dropped says how many and why.
    /// @throws UsageError for an unknown word, or if nothing is left
    std::vector<Axes> axes(std::string& dropped) const;
    std::vector<Shade> shadeList() const;

  private:
    void checkUsed(const std::vector<Axes>& methods) const;
};

/// --effects
struct EffectsOption {
    std::vector<std::string> words{};
    void addTo(CLI::App& app);
    /// Nothing if it was not given.
    /// @throws UsageError for an unknown word
    std::optional<Effects> value() const;
};

/// --size
struct SizeOption {
    std::vector<std::string> words{};
    void addTo(CLI::App& app);
    std::vector<Size> value() const;
};

/// --host-ms: what the processor of the time needs for a frame, for the cost model; finite, not negative.
void addHostMs(CLI::App& app, double& hostMs);

/// "0,15" or "0-59"; each a comma list.
std::vector<int> parseFrames(const std::vector<std::string>& words);

/// Refuses a frame that the camera path of @p scene doesn't have.
/// @param flag  that named it
/// @throws UsageError
void checkFrame(const std::string& flag, int frame, const Scene& scene);

/// --fidelity, and what decides of the chip's arithmetic where there is a choice.
struct FidelityOption {
    std::vector<std::string> words{};
    std::string dither = "off", unit{};
    void addTo(CLI::App& app);
    /// @throws UsageError for an unknown word, or a blend unit that none of @p profiles has
    std::vector<FidelityChoice> value(const std::vector<Profile>& profiles) const;
};

/// --device
struct DeviceOption {
    std::string word{};
    void addTo(CLI::App& app);
    /// @throws UsageError  no such device, gnomon was built without it, or the system has no driver for it
    Device value() const;
};

}  // namespace gnomon
