#include "method/from_words.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace gnomon {
namespace {

[[noreturn]] void bad(const std::string& flag, const std::string& word) {
    throw std::runtime_error(fmt::format("no such {} '{}'", flag, word));
}

template <class Enum>
Enum need(const std::string& flag, const std::string& word, int count) {
    const auto value = fromWord<Enum>(word, count);
    if (!value) bad(flag, word);
    return *value;
}

int whole(const std::string& flag, const std::string& word, int least, int most) {
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value < least || value > most)
        throw std::runtime_error(fmt::format("{}: '{}' is not within {} to {}", flag, word, least, most));
    return value;
}

/// @param limit  the first value that is too large
float share(const std::string& flag, const std::string& word, float limit) {
    char* end = nullptr;
    const float value = std::strtof(word.c_str(), &end);
    if (word.empty() || *end != 0 || !(value >= 0 && value < limit))
        throw std::runtime_error(fmt::format("{}: '{}' is not within 0 to {:g}", flag, word, limit));
    return value;
}

void set(Axes& axes, const std::string& flag, const std::string& word) {
    if (flag == "store")
        axes.store = need<Store>(flag, word, kStores);
    else if (flag == "arithmetic")
        axes.arithmetic = need<Arithmetic>(flag, word, kArithmetics);
    else if (flag == "levels")
        axes.levels = whole(flag, word, 1, 8);
    else if (flag == "count")
        axes.count = need<Count>(flag, word, kCounts);
    else if (flag == "silhouette")
        axes.silhouette = need<Silhouette>(flag, word, kSilhouettes);
    else if (flag == "apply")
        axes.apply = need<Apply>(flag, word, kApplies);
    else if (flag == "start")
        axes.start = need<Start>(flag, word, kStarts);
    else if (flag == "overflow")
        axes.overflow = need<Overflow>(flag, word, kOverflows);
    else if (flag == "caps")
        axes.capFaces = need<CapFaces>(flag, word, kCapFaces);
    else if (flag == "clip")
        axes.clip = need<Clip>(flag, word, kClips);
    else if (flag == "offset")
        axes.offset = share(flag, word, 1e15f);
    else if (flag == "map-size")
        axes.mapSize = whole(flag, word, 1, 8192);
    else if (flag == "map-bias")
        axes.mapBias = share(flag, word, 1);
    else if (flag == "mask-scale") {
        const auto divisor = maskDivisorOf(word);
        if (!divisor) bad(flag, word);
        axes.maskDivisor = *divisor;
    } else {
        throw std::runtime_error(fmt::format("no such axis '{}'", flag));
    }
}

}  // namespace

std::optional<int> maskDivisorOf(const std::string& word) {
    if (word == "1") return 1;
    if (word == "1/2" || word == "0.5") return 2;
    if (word == "1/4" || word == "0.25") return 4;
    return std::nullopt;
}

Axes defaultsOf(Store store) {
    Axes axes{.store = store, .levels = 0};
    if (store == Store::Alpha || store == Store::Screen) {
        axes.arithmetic = Arithmetic::Double;
        axes.count = Count::ZpassCap;
    }
    return axes;
}

Axes axesFromWords(const std::string& method, const std::map<std::string, std::string>& options) {
    const NamedMethod* named = findMethod(method);
    if (!named) bad("method", method);
    Axes axes = named->axes;
    for (const auto& [flag, word] : options) set(axes, flag, word);
    if (axes.arithmetic == Arithmetic::Double && axes.levels == 0) axes.levels = 2;
    axes = normalised(axes);
    if (const auto reason = contradiction(axes)) throw std::runtime_error(*reason);
    return axes;
}

}  // namespace gnomon
