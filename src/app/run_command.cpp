#include "app/run_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "app/options.h"
#include "app/shell_words.h"

namespace gnomon {
namespace {

/// Values in the order in which they first come, each once.
template <class Value, class Of>
std::vector<Value> distinct(const std::vector<Cell>& cells, const Of& of) {
    std::vector<Value> values;
    std::set<Value> known;
    for (const Cell& cell : cells)
        if (Value value = of(cell); known.insert(value).second) values.push_back(std::move(value));
    return values;
}

/// Several words as one, with commas between.
template <class Values>
std::string listWord(const Values& values) {
    return shellWord(fmt::format("{}", fmt::join(values, ",")));
}

/// " --flag a,b", unless the values are what is taken without the flag.
template <class Value>
std::string flagText(const std::string& flag, const std::vector<Value>& values,
                     const std::vector<Value>& usual) {
    return values == usual ? "" : fmt::format(" --{} {}", flag, listWord(values));
}

std::vector<std::string> usualMethods() {
    std::string dropped;
    std::vector<std::string> ids;
    for (const Axes& axes : MethodOption{}.axes(dropped)) ids.push_back(methodId(axes));
    return ids;
}

/// The methods, by name where all have one, else the product of their axes.
std::string methodsText(const std::vector<Cell>& cells) {
    const auto ids = distinct<std::string>(cells, [](const Cell& c) { return c.method; });
    const bool named = std::all_of(ids.begin(), ids.end(), [](const auto& id) { return findMethod(id); });
    if (named) return flagText("method", ids, usualMethods());
    const auto axis = [&](const char* flag, const std::string& usual, const auto& of) {
        return flagText(flag, distinct<std::string>(cells, of), {usual});
    };
    const auto text = [](auto number) { return fmt::format("{}", number); };
    const Axes u{};
    return axis("store", "", [](const Cell& c) { return name(c.axes.store); }) +
           axis("arithmetic", "", [](const Cell& c) { return name(c.axes.arithmetic); }) +
           axis("count", "", [](const Cell& c) { return name(c.axes.count); }) +
           axis("levels", text(u.levels),
                [&](const Cell& c) {
                    return text(c.axes.arithmetic == Arithmetic::Double ? c.axes.levels : u.levels);
                }) +
           axis("silhouette", name(u.silhouette), [](const Cell& c) { return name(c.axes.silhouette); }) +
           axis("mask-scale", "1", [](const Cell& c) { return maskScaleName(c.axes.maskDivisor); }) +
           axis("apply", name(u.apply), [](const Cell& c) { return name(c.axes.apply); }) +
           axis("start", name(u.start), [](const Cell& c) { return name(c.axes.start); }) +
           axis("overflow", name(u.overflow), [](const Cell& c) { return name(c.axes.overflow); }) +
           axis("caps", name(u.capFaces), [](const Cell& c) { return name(c.axes.capFaces); }) +
           axis("clip", name(u.clip), [](const Cell& c) { return name(c.axes.clip); }) +
           axis("offset", text(u.offset), [&](const Cell& c) { return text(c.axes.offset); }) +
           axis("map-size", text(u.mapSize), [&](const Cell& c) { return text(c.axes.mapSize); }) +
           axis("map-bias", text(u.mapBias), [&](const Cell& c) { return text(c.axes.mapBias); });
}

/// The frames, unless they are those that every scene gives without a choice.
std::string framesText(const std::vector<Cell>& cells, const RunSources& sources) {
    std::map<std::string, std::set<int>> byScene;
    std::set<int> all;
    for (const Cell& cell : cells) byScene[cell.scene].insert(cell.frame), all.insert(cell.frame);
    bool usual = true;
    for (const auto& [key, scene] : sources.scenes) {
        const auto frames = framesOf({}, scene);
        usual = usual && byScene[key.first] == std::set<int>(frames.begin(), frames.end());
    }
    return usual ? "" : fmt::format(" --frames {}", fmt::join(all, ","));
}

}  // namespace

std::string commandOf(const std::vector<Cell>& cells, const RunSources& sources) {
    std::string text = "gnomon matrix";
    const auto scenes = distinct<std::string>(cells, [](const Cell& c) { return c.scene; });
    if (scenes != sceneIds(dataFolder("scenes"))) text += fmt::format(" {}", listWord(scenes));
    auto known = profileIds(dataFolder("profiles"));
    std::stable_partition(known.begin(), known.end(), [](const auto& id) { return id == "ideal"; });
    text += flagText("profile", distinct<std::string>(cells, [](const Cell& c) { return c.profile; }), known);
    text += methodsText(cells);
    const auto word = [&](const char* flag, const std::string& usual, const auto& of) {
        text += flagText(flag, distinct<std::string>(cells, of), {usual});
    };
    word("shade", name(Shade::Attenuated), [](const Cell& c) { return name(c.axes.shade); });
    word("size", fmt::format("{}x{}", Size{}.width, Size{}.height),
         [](const Cell& c) { return fmt::format("{}x{}", c.width, c.height); });
    text += framesText(cells, sources);
    word("fidelity", "gl", [](const Cell& c) { return c.fidelity; });
    const Cell& first = cells.front();
    if (first.dithers) text += " --dither on";
    if (!first.blendUnit.empty()) text += " --blend-unit " + first.blendUnit;
    for (const Cell& cell : cells)
        if (cell.drawnBy.empty() && cell.effects != Effects::all()) {
            text += " --effects " + toString(cell.effects);
            break;
        }
    word("device", name(defaultDevice()), [](const Cell& c) { return c.device; });
    for (const auto& [flag, value] : first.view) text += fmt::format(" --{} {}", flag, shellWord(value));
    return text;
}

}  // namespace gnomon
