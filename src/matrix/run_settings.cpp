#include "matrix/run_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "matrix/cell_list.h"
#include "matrix/digest.h"

namespace gnomon {
namespace {

template <class Values, class Of>
std::string joined(const Values& values, const Of& of) {
    std::vector<std::string> words;
    for (const auto& value : values) words.push_back(of(value));
    return fmt::format("{}", fmt::join(words, ","));
}

/// A method with what its id doesn't say.
std::string wordsOfMethod(const Axes& axes) {
    return fmt::format("{}{}", methodId(axes),
                       axes.shade == Shade::Attenuated ? "" : " shade " + name(axes.shade));
}

std::string wordsOfFidelity(const FidelityChoice& choice) {
    return fmt::format("{}{}{}", name(choice.fidelity), choice.dithers ? " dithered" : "",
                       choice.unit ? " " + name(*choice.unit) : "");
}

std::string digestOf(const PastCosts& past) {
    if (past.empty()) return "";
    Digest digest;
    for (const auto& [key, seconds] : past) {
        const auto& [scene, width, height, frame, profile] = key;
        digest.add(scene), digest.add(profile);
        for (const int number : {width, height, frame}) digest.add(std::int64_t(number));
        digest.add(float(seconds));
    }
    return digest.text();
}

std::vector<std::string> itemsOf(const std::string& list) {
    std::vector<std::string> items;
    for (std::size_t at = 0; at <= list.size();) {
        const std::size_t end = std::min(list.find(',', at), list.size());
        items.push_back(list.substr(at, end - at));
        at = end + 1;
    }
    return items;
}

/// What of @p items is not in @p others; long lists are cut.
std::string onlyIn(const std::vector<std::string>& items, const std::vector<std::string>& others) {
    constexpr std::size_t kMost = 6;
    std::vector<std::string> only;
    for (const std::string& item : items)
        if (std::find(others.begin(), others.end(), item) == others.end()) only.push_back(item);
    const std::size_t more = only.size() > kMost ? only.size() - kMost : 0;
    if (more) only.resize(kMost);
    return fmt::format("{}{}", fmt::join(only, ", "), more ? fmt::format(" and {} more", more) : "");
}

std::string differenceOf(const std::string& name, const std::string& kept, const std::string& asked) {
    static const std::set<std::string> kLists{"scenes", "profiles", "methods", "sizes", "frames", "fidelity"};
    const auto there = itemsOf(kept), here = itemsOf(asked);
    if (!kLists.contains(name) || there.size() == 1 || here.size() == 1)
        return fmt::format("{}, there {}", asked.empty() ? "none" : asked, kept.empty() ? "none" : kept);
    const std::string with = onlyIn(here, there), without = onlyIn(there, here);
    if (with.empty() && without.empty()) return "in another order";
    return fmt::format("{}{}{}{}{}", with.empty() ? "" : "with ", with,
                       with.empty() || without.empty() ? "" : ", ", without.empty() ? "" : "without ",
                       without);
}

}  // namespace

std::string toText(const Shard& shard) {
    return fmt::format("{}/{}", shard.index, shard.count);
}

Shard shardFrom(const std::string& text) {
    Shard shard{0, 0};
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, shard.index);
    if (first.ec != std::errc{} || first.ptr == end || *first.ptr != '/') return {0, 0};
    const auto second = std::from_chars(first.ptr + 1, end, shard.count);
    const bool isGood =
        second.ec == std::errc{} && second.ptr == end && shard.index >= 1 && shard.index <= shard.count;
    return isGood ? shard : Shard{0, 0};
}

RunSettings settingsOf(const MatrixRequest& r, const RunMaker& maker) {
    RunSettings settings{
        {"version", maker.version},
        {"compiler", maker.compiler},
        {"program", fmt::format("{:016x}", maker.program)},
        {"OpenGL", maker.driver},
        {"device", name(r.device)},
        {"scenes", joined(r.scenes, [](const Scene& s) { return s.id; })},
        {"profiles", joined(r.profiles, [](const Profile& p) { return p.id; })},
        {"methods", joined(r.methods, wordsOfMethod)},
        {"sizes", joined(r.sizes, [](const Size& s) { return fmt::format("{}x{}", s.width, s.height); })},
        {"frames", r.frames.empty() ? "twelve of each scene" : fmt::format("{}", fmt::join(r.frames, ","))},
        {"fidelity", joined(r.fidelities, wordsOfFidelity)},
        {"effects", r.effects ? toString(*r.effects) : "as published"},
        {"view", joined(r.view, [](const auto& v) { return fmt::format("--{} {}", v.first, v.second); })},
        {"timeout", fmt::format("{} s", r.limits.seconds)},
        {"memory", r.limits.megabytes ? fmt::format("{} MB", r.limits.megabytes) : ""},
        {"shard", toText(r.shard)},
        {"past", digestOf(r.past)},
        {"cells", fmt::format("{}", placesOf(CellList(r), r.shard, r.past).size())},
        {"pictures", r.pictureFolder.empty() ? "no" : "yes"},
    };
    return settings;
}

std::string settingOf(const RunSettings& settings, const std::string& name) {
    for (const auto& [key, value] : settings)
        if (key == name) return value;
    return "";
}

RunSettings withSetting(RunSettings settings, const std::string& name, const std::string& value) {
    for (auto& setting : settings)
        if (setting.first == name) setting.second = value;
    return settings;
}

RunSettings withLimitsOf(RunSettings settings, const RunSettings& other) {
    for (const char* limit : {"timeout", "memory"})
        settings = withSetting(std::move(settings), limit, settingOf(other, limit));
    return settings;
}

std::string differenceOf(const RunSettings& kept, const RunSettings& asked) {
    std::vector<std::string> differences;
    for (const auto& [name, value] : asked)
        if (const std::string there = settingOf(kept, name); there != value)
            differences.push_back(fmt::format("{}: {}", name, differenceOf(name, there, value)));
    return fmt::format("{}", fmt::join(differences, "; "));
}

}  // namespace gnomon
