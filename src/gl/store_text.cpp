#include "gl/store_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "gl/blend_text.h"
#include "gl/pixel_words.h"
#include "profile/frame_channel.h"

namespace gnomon {
namespace {

using enum BlendFactor;

/// The clamp, or the wrap, that ends a sum; PS2 and PSP add their dither cells before it.
std::string finishedText(const EmulatedDraw& state, int c, const std::string& sum) {
    const auto side = std::size_t(c == kAlpha);
    const bool wraps = state.chip.unit == BlendUnit::GsWrap ||
                       (state.blends && state.equation[side] == BlendEquation::AddWrap);
    const bool cellComesFirst = state.dither == DitherMode::Gs || state.dither == DitherMode::Ge;
    const std::string value =
        cellComesFirst && dithersChannel(state, c) ? fmt::format("({} + cell)", sum) : sum;
    return wraps ? fmt::format("({} & 255)", value) : fmt::format("clamp({}, 0, 255)", value);
}

bool readsDestinationAlpha(BlendFactor factor) {
    return factor == DstAlpha || factor == OneMinusDstAlpha || factor == SrcAlphaSaturate;
}

/// What the draw makes of each code of channel @p c; empty where that depends on more than the code.
std::vector<int> codeTable(const EmulatedDraw& state, int c) {
    const auto side = std::size_t(c == kAlpha);
    const BlendFactor source = state.source[side], destination = state.destination[side];
    const bool ownCode =
        state.constant && state.blends && state.chip.fidelity == Fidelity::Chip &&
        state.dither == DitherMode::Off && state.equation[side] <= BlendEquation::Max &&
        !(c != kAlpha && (readsDestinationAlpha(source) || readsDestinationAlpha(destination)));
    // Constant factors are left to the general form: their colour is the caller's at the draw.
    if (!ownCode || source >= ConstantColor || destination >= ConstantColor) return {};
    const BufferFormat& f = state.format;
    const FrameState frame{.unit = state.chip.unit, .format = {"", f.red, f.green, f.blue, f.alpha}};
    const BlendState blend{source, destination, BlendOperation(state.equation[side]), {}};
    std::vector<int> table;
    for (int code = 0; code <= largestCode(channelBits(f, c)); ++code) {
        Rgba codes{};
        codes[std::size_t(c)] = code;
        const auto result = blendInto(frame, blend, *state.constant, codes);
        if (!result) return {};
        table.push_back((*result)[std::size_t(c)]);
    }
    return table;
}

}  // namespace

bool dithersChannel(const EmulatedDraw& state, int c) {
    return c != kAlpha && dithers(state.dither, channelBits(state.format, c));
}

std::string cellText(DitherMode mode) {
    const bool isSigned = mode == DitherMode::Gs || mode == DitherMode::Ge || mode == DitherMode::Psx;
    const int added = isSigned ? 4 : 0;
    std::array<std::uint32_t, 2> packed{};
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            packed[std::size_t(y / 2)] |= std::uint32_t(ditherCell(mode, x, y) + added)
                                          << (16 * (y % 2) + 4 * x);
    return fmt::format("int(((row & 2) == 0 ? {}u : {}u) >> (16 * (row & 1) + 4 * (column & 3)) & 15u) - {}",
                       packed[0], packed[1], added);
}

std::string readBackText(const EmulatedDraw& state, int c) {
    const int bits = channelBits(state.format, c);
    const std::string code = fmt::format("c{}", c);
    const bool gs = isGs(state.chip.unit);
    if (bits == 0) return gs ? "128" : "255";
    if (bits == 8) return code;
    const bool shifts =
        gs || (c != kAlpha && (state.chip.unit == BlendUnit::Rdp || state.chip.unit == BlendUnit::Nv2a));
    if (shifts) return fmt::format("{} << {}", code, 8 - bits);
    if (bits == 1) return fmt::format("{} * 255", code);
    std::string text = fmt::format("({0} << {1} | {0} >> {2})", code, 8 - bits, 2 * bits - 8);
    const bool subtracts =
        state.dither == DitherMode::Matrix4x4Subtract || state.dither == DitherMode::Matrix2x2Subtract;
    if (subtracts && dithersChannel(state, c))
        text += fmt::format(" + ((15 - cell) >> {})", bits == 6 ? 2 : 1);
    return text;
}

std::string storedText(const EmulatedDraw& state, int c, const std::string& sum) {
    const int bits = channelBits(state.format, c);
    // OpenGL has no sum that wraps: of one and one it is that of the codes.
    const auto side = std::size_t(c == kAlpha);
    const bool wraps = state.blends && state.equation[side] == BlendEquation::AddWrap;
    if (state.chip.fidelity == Fidelity::Gl && wraps &&
        (state.source[side] != One || state.destination[side] != One))
        refuseSetting(state, c, "add_wrap");
    if (state.chip.fidelity == Fidelity::Gl && wraps)
        return fmt::format("(c{0} + (2 * s{0} * {1} + 255) / 510) & {1}", c, largestCode(bits));
    const std::string value = finishedText(state, c, sum);
    if (state.chip.fidelity == Fidelity::Gl && bits < 8)
        return fmt::format("(2 * {} * {} + 255) / 510", value, largestCode(bits));
    const std::string truncated = bits == 8 ? value : fmt::format("{} >> {}", value, 8 - bits);
    if (!dithersChannel(state, c)) return truncated;
    switch (state.dither) {
        case DitherMode::Virge:
            return fmt::format("virgeDithered({}, cell)", value);
        case DitherMode::RdpMagic:
        case DitherMode::RdpBayer:
            return fmt::format("rdpDithered({}, cell) >> {}", value, 8 - bits);
        case DitherMode::Off:
        case DitherMode::Gs:
        case DitherMode::Ge:
        case DitherMode::Psx:
            return truncated;
        default:
            return fmt::format("voodooDithered{}({}, cell)", bits, value);
    }
}

std::optional<std::string> shortForm(const EmulatedDraw& state, int c) {
    const std::vector<int> table = codeTable(state, c);
    if (table.empty()) return {};
    const int most = largestCode(channelBits(state.format, c));
    const auto is = [&](auto function) {
        for (int code = 0; code <= most; ++code)
            if (table[std::size_t(code)] != function(code)) return false;
        return true;
    };
    const std::string code = fmt::format("c{}", c);
    if (is([&](int v) { return std::min(2 * v, most); }))
        return fmt::format("min({0} + {0}, {1})", code, most);
    if (is([](int v) { return v >> 1; })) return fmt::format("{} >> 1", code);
    if (is([](int v) { return (v + 1) >> 1; })) return fmt::format("({} + 1) >> 1", code);
    if (is([&](int v) { return most - v; })) return fmt::format("{} - {}", most, code);
    const int added = table.front(), taken = most - table.back();
    if (is([&](int v) { return std::min(v + added, most); }))
        return fmt::format("min({} + {}, {})", code, added, most);
    if (is([&](int v) { return std::max(v - taken, 0); })) return fmt::format("max({} - {}, 0)", code, taken);
    return {};
}

}  // namespace gnomon
