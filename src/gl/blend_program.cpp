#include "gl/blend_program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "profile/frame_channel.h"

namespace gnomon {
namespace {

using enum BlendFactor;

constexpr int kAlpha = 3;

bool isGs(BlendUnit unit) {
    return unit == BlendUnit::Gs || unit == BlendUnit::GsWrap;
}

/// What an input is multiplied by, as an expression of 8 bits.
struct Factor {
    enum class Kind { Zero, One, Value, Complement };
    Kind kind = Kind::Zero;
    std::string value{};
};

/// The factor of channel @p c.
Factor factorOf(const EmulatedDraw& state, BlendFactor factor, int c) {
    using enum Factor::Kind;
    const auto own = [&](const char* name) { return fmt::format("{}{}", name, c); };
    switch (factor) {
        case BlendFactor::Zero:
            return {Zero, {}};
        case BlendFactor::One:
            return {One, {}};
        case SrcColor:
            return {Value, own("s")};
        case OneMinusSrcColor:
            return {Complement, own("s")};
        case DstColor:
            return {Value, own("d")};
        case OneMinusDstColor:
            return {Complement, own("d")};
        case SrcAlpha:
            return {Value, "s3"};
        case OneMinusSrcAlpha:
            return {Complement, "s3"};
        case DstAlpha:
            return {Value, "d3"};
        case OneMinusDstAlpha:
            return {Complement, "d3"};
        case SrcAlphaSaturate:
            if (c == kAlpha) return {One, {}};
            return {Value,
                    fmt::format("min(s3, {} - d3)", state.chip.unit == BlendUnit::VoodooMame ? 256 : 255)};
        case ConstantColor:
            return {Value, own("k")};
        case OneMinusConstantColor:
            return {Complement, own("k")};
        case ConstantAlpha:
            return {Value, "k3"};
        case OneMinusConstantAlpha:
            return {Complement, "k3"};
    }
    return {};
}

/// A factor in the chip's own terms; @p value and @p complement are formats with one place.
std::string weight(const Factor& factor, const char* one, fmt::string_view value,
                   fmt::string_view complement) {
    switch (factor.kind) {
        case Factor::Kind::Zero:
            return "0";
        case Factor::Kind::One:
            return one;
        case Factor::Kind::Value:
            return fmt::format(fmt::runtime(value), factor.value);
        case Factor::Kind::Complement:
            return fmt::format(fmt::runtime(complement), factor.value);
    }
    return "0";
}

std::string clamped(const std::string& value) {
    return fmt::format("clamp({}, 0, 255)", value);
}

[[noreturn]] void refuse(const EmulatedDraw& state, int c, const char* what) {
    const auto side = std::size_t(c == kAlpha);
    throw std::runtime_error(fmt::format("{}: blend unit {} has no {} {}", what, name(state.chip.unit),
                                         name(state.source[side]), name(state.destination[side])));
}

/// Both products, joined as the equation says.
std::string joined(BlendEquation equation, const std::string& s, const std::string& d) {
    switch (equation) {
        case BlendEquation::Subtract:
            return fmt::format("{} - {}", s, d);
        case BlendEquation::ReverseSubtract:
            return fmt::format("{} - {}", d, s);
        default:
            return fmt::format("{} + {}", s, d);
    }
}

/// Units that take any factor for either input. Their formulas stand at blend() in profile/blend.h.
std::string byFactors(const EmulatedDraw& state, int c, const Factor& f, const Factor& g) {
    const auto side = std::size_t(c == kAlpha);
    const BlendEquation equation = state.equation[side];
    const std::string s = fmt::format("s{}", c), d = fmt::format("d{}", c);
    const auto terms = [&](const char* one, fmt::string_view value, fmt::string_view complement) {
        return std::pair(fmt::format("{} * {}", s, weight(f, one, value, complement)),
                         fmt::format("{} * {}", d, weight(g, one, value, complement)));
    };
    switch (state.chip.unit) {
        case BlendUnit::VoodooMame: {
            const auto [a, b] = terms("256", "({} + 1)", "(256 - {})");
            return fmt::format("(({} + {}) >> 8)", a, b);
        }
        case BlendUnit::Voodoo86Box: {
            const auto [a, b] = terms("255", "{}", "(255 - {})");
            return fmt::format("(quotient255({}) + quotient255({}))", a, b);
        }
        case BlendUnit::Flipper:
            if (equation == BlendEquation::ReverseSubtract) return fmt::format("({} - {})", d, s);
            [[fallthrough]];
        case BlendUnit::PowerVr: {
            const auto [a, b] = terms("256", "({0} + ({0} >> 7))", "(255 - {0} + ((255 - {0}) >> 7))");
            return fmt::format("(({} + {}) >> 8)", a, b);
        }
        case BlendUnit::Ge: {
            const auto product = [&](const std::string& colour, const Factor& factor) {
                return fmt::format("((2 * {} + 1) * (2 * {} + 1) >> 10)", colour,
                                   weight(factor, "255", "{}", "max(255 - {}, 0)"));
            };
            return fmt::format("({})", joined(equation, product(s, f), product(d, g)));
        }
        case BlendUnit::ProductsRound:
        case BlendUnit::ProductsFloor: {
            const auto [a, b] = terms("255", "{}", "(255 - {})");
            const char* cut = state.chip.unit == BlendUnit::ProductsRound ? "round255" : "floor255";
            return fmt::format(
                "({})", joined(equation, fmt::format("{}({})", cut, a), fmt::format("{}({})", cut, b)));
        }
        default: {
            const auto [a, b] = terms("255", "{}", "(255 - {})");
            const bool floors = state.chip.unit == BlendUnit::IdealFloor;
            if (equation == BlendEquation::AddWrap)  // no clamp hides a sum beyond the quick quotient's range
                return fmt::format(
                    "(({}) / {})",
                    floors ? joined(equation, a, b) : fmt::format("2 * ({}) + 255", joined(equation, a, b)),
                    floors ? 255 : 510);
            const char* cut = floors ? "floor255" : "round255";
            return fmt::format("{}(max({}, 0))", cut, joined(equation, a, b));
        }
    }
}

bool isColour(BlendFactor factor) {
    switch (factor) {
        case SrcColor:
        case OneMinusSrcColor:
        case DstColor:
        case OneMinusDstColor:
        case SrcAlphaSaturate:
        case ConstantColor:
        case OneMinusConstantColor:
            return true;
        default:
            return false;
    }
}

/// The PS2: ((A - B) * C >> 7) + D. A constant source colour can go into FIX, the C of such a setting, with
/// white for Cs (hardware.md, section 2(a)).
std::string gsSetting(const EmulatedDraw& state, int c, const Factor& f, const Factor& g) {
    using enum Factor::Kind;
    const auto side = std::size_t(c == kAlpha);
    const BlendFactor source = state.source[side], destination = state.destination[side];
    const BlendEquation equation = state.equation[side];
    const std::string s = fmt::format("s{}", c), d = fmt::format("d{}", c);
    const auto sum = [&](const std::string& a, const std::string& b, const std::string& coefficient,
                         const std::string& added) {
        return fmt::format("(((({} - {}) * {}) >> 7) + {})", a, b, coefficient, added);
    };
    if (state.from == FragmentSource::Constant && equation == BlendEquation::Add) {
        const std::string fix = fmt::format("((2 * {} * 128 + 255) / 510)", s);
        const bool isWhole = g.kind == Zero || g.kind == One;
        if (source == DstColor && isWhole) return sum(d, "0", fix, g.kind == One ? d : "0");
        if (f.kind == Zero && destination == SrcColor) return sum(d, "0", fix, "0");
        if (source == OneMinusDstColor && g.kind == Zero) return sum("255", d, fix, "0");
    }
    if (isColour(source) || isColour(destination)) refuse(state, c, name(equation).c_str());

    // The first A, B and D that are what OpenGL asks for, as blend() finds them.
    struct Share {
        int ofCoefficient = 0, ofOne = 0;
        bool operator==(const Share&) const = default;
    };
    const auto shareOf = [](const Factor& factor, int sign) {
        return factor.kind == Zero    ? Share{}
               : factor.kind == One   ? Share{0, sign}
               : factor.kind == Value ? Share{sign, 0}
                                      : Share{-sign, sign};
    };
    const bool sourceVaries = f.kind == Value || f.kind == Complement;
    const bool destinationVaries = g.kind == Value || g.kind == Complement;
    if (sourceVaries && destinationVaries && f.value != g.value) refuse(state, c, name(equation).c_str());
    const bool varies = sourceVaries || destinationVaries;
    const std::string coefficient = sourceVaries ? f.value : destinationVaries ? g.value : "128";
    const Share ofSource = shareOf(f, equation == BlendEquation::ReverseSubtract ? -1 : 1);
    const Share ofDestination = shareOf(g, equation == BlendEquation::Subtract ? -1 : 1);
    const std::array<std::string, 3> inputs{s, d, "0"};
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
            for (std::size_t added = 0; added < 3; ++added) {
                const auto shareIn = [&](std::size_t input) {
                    const int times = int(a == input) - int(b == input), once = int(added == input);
                    return varies ? Share{times, once} : Share{0, times + once};
                };
                if (shareIn(0) == ofSource && shareIn(1) == ofDestination)
                    return sum(inputs[a], inputs[b], coefficient, inputs[added]);
            }
    refuse(state, c, name(equation).c_str());
}

/// The chips with fixed multiplexers. A constant colour that multiplies the destination becomes the weight of
/// black (hardware.md, section 4.1: ViRGE, RIVA 128, N64, DS, PlayStation).
std::string fixedSetting(const EmulatedDraw& state, int c, const Factor& f, const Factor& g) {
    using enum Factor::Kind;
    const auto side = std::size_t(c == kAlpha);
    const BlendFactor source = state.source[side], destination = state.destination[side];
    const BlendEquation equation = state.equation[side];
    const std::string s = fmt::format("s{}", c), d = fmt::format("d{}", c);
    const bool isAdd = equation == BlendEquation::Add, isWrap = equation == BlendEquation::AddWrap;
    const bool ones = f.kind == One && g.kind == One;
    const bool overs = f.kind == Value && g.kind == Complement && f.value == g.value;
    const std::string& weight = f.value;
    const bool isConstant = state.from == FragmentSource::Constant;
    const bool scales =
        isConstant && isAdd &&
        ((source == DstColor && g.kind == Zero) || (f.kind == Zero && destination == SrcColor));
    const bool doubles = isConstant && isAdd && source == DstColor && g.kind == One;
    switch (state.chip.unit) {
        case BlendUnit::Virge:
            if (overs && isAdd) return fmt::format("floor255({0} * {2} + {1} * (255 - {2}))", s, d, weight);
            if (scales) return fmt::format("floor255({} * {})", d, s);
            break;
        case BlendUnit::Rdp:
            if (overs && (isAdd || isWrap))
                return fmt::format("(({0} * ({2} >> 3) + {1} * (32 - ({2} >> 3))) >> 5 & 255)", s, d, weight);
            if (ones && (isAdd || isWrap)) return fmt::format("(({} * 31 + {} * 32) >> 5)", s, d);
            if (scales) return fmt::format("(({} * ((2 * {} * 32 + 255) / 510)) >> 5)", d, s);
            if (doubles) return fmt::format("((({0} * 31 + {0} * 32) >> 5) & 255)", d);
            break;
        case BlendUnit::Nv3: {
            if (ones && isAdd) return fmt::format("(min(({} >> 3) + ({} >> 3), 31) << 3)", s, d);
            const bool fits = (f.kind == Zero || f.kind == Value) &&
                              (g.kind == Zero || g.kind == Complement) &&
                              (f.kind == Zero || g.kind == Zero || f.value == g.value);
            if (!isAdd || !fits || (f.kind == Zero && g.kind == Zero)) break;
            return fmt::format("(nv3({}, {}, ({}) >> 4) << 3)", f.kind == Zero ? "0" : s + " >> 3",
                               g.kind == Zero ? "0" : d + " >> 3", f.kind == Zero ? g.value : f.value);
        }
        case BlendUnit::Ds:
            if (overs && isAdd)
                return fmt::format(
                    "(((({0} >> 2) * (({2} >> 3) + 1) + ({1} >> 2) * (31 - ({2} >> 3))) >> 5) << 2)", s, d,
                    weight);
            if (scales)
                return fmt::format("(((({} >> 2) * min((2 * {} * 32 + 255) / 510, 31)) >> 5) << 2)", d, s);
            break;
        case BlendUnit::Psx:
            if (ones && isAdd) return fmt::format("(min(({} >> 3) + ({} >> 3), 31) << 3)", s, d);
            if (ones && equation == BlendEquation::ReverseSubtract)
                return fmt::format("(max(({1} >> 3) - ({0} >> 3), 0) << 3)", s, d);
            break;
        default:
            break;
    }
    refuse(state, c, name(equation).c_str());
}

bool takesAnyFactor(BlendUnit unit) {
    switch (unit) {
        case BlendUnit::IdealRound:
        case BlendUnit::IdealFloor:
        case BlendUnit::ProductsRound:
        case BlendUnit::ProductsFloor:
        case BlendUnit::VoodooMame:
        case BlendUnit::Voodoo86Box:
        case BlendUnit::PowerVr:
        case BlendUnit::Flipper:
        case BlendUnit::Ge:
        case BlendUnit::Nv2a:
            return true;
        default:
            return false;
    }
}

/// The value of channel @p c after blending, before its clamp.
std::string blended(const EmulatedDraw& state, int c) {
    const auto side = std::size_t(c == kAlpha);
    const BlendEquation equation = state.equation[side];
    const BlendUnit unit = state.chip.unit;
    const std::string s = fmt::format("s{}", c), d = fmt::format("d{}", c);
    if (isGs(unit) && c == kAlpha) return s;
    if (unit == BlendUnit::Ge && c == kAlpha) return d;
    if (equation == BlendEquation::Min) return fmt::format("min({}, {})", s, d);
    if (equation == BlendEquation::Max) return fmt::format("max({}, {})", s, d);
    if (equation == BlendEquation::SignedAdd || equation == BlendEquation::SignedReverseSubtract) {
        if (unit != BlendUnit::Nv2a) refuse(state, c, name(equation).c_str());
        const char sign = equation == BlendEquation::SignedAdd ? '+' : '-';
        return fmt::format("({} {} ({} < 128 ? {} : {} - 256))", d, sign, s, s, s);
    }
    const Factor f = factorOf(state, state.source[side], c), g = factorOf(state, state.destination[side], c);
    if (isGs(unit)) return gsSetting(state, c, f, g);
    if (!takesAnyFactor(unit)) return fixedSetting(state, c, f, g);
    return byFactors(state, c, f, g);
}

/// The dither cell at the pixel: 16 cells of 4 bits, the first in the lowest, signed ones with 4 added.
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

bool dithersChannel(const EmulatedDraw& state, int c) {
    return c != kAlpha && dithers(state.dither, channelBits(state.format, c));
}

/// The value of 8 bits that the blend unit reads for a stored code.
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

/// The clamp, or the wrap, that ends a sum; PS2 and PSP add their dither cells before it.
std::string finishedText(const EmulatedDraw& state, int c, const std::string& sum) {
    const auto side = std::size_t(c == kAlpha);
    const bool wraps = state.chip.unit == BlendUnit::GsWrap ||
                       (state.blends && state.equation[side] == BlendEquation::AddWrap);
    const bool cellComesFirst = state.dither == DitherMode::Gs || state.dither == DitherMode::Ge;
    const std::string value =
        cellComesFirst && dithersChannel(state, c) ? fmt::format("({} + cell)", sum) : sum;
    return wraps ? fmt::format("({} & 255)", value) : clamped(value);
}

/// The code that is stored for a value of 8 bits, or for the sum before its clamp.
std::string storedText(const EmulatedDraw& state, int c, const std::string& sum) {
    const int bits = channelBits(state.format, c);
    // OpenGL has no sum that wraps: of one and one it is that of the codes.
    const auto side = std::size_t(c == kAlpha);
    const bool wraps = state.blends && state.equation[side] == BlendEquation::AddWrap;
    if (state.chip.fidelity == Fidelity::Gl && wraps &&
        (state.source[side] != One || state.destination[side] != One))
        refuse(state, c, "add_wrap");
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

/// The draw's effect on channel @p c as a short expression of its code, if there is one that is equal for all
/// codes.
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

const char* compareText(Compare function) {
    switch (function) {
        case Compare::Never:
            return "false";
        case Compare::Less:
            return "s3 < alphaReference";
        case Compare::Equal:
            return "s3 == alphaReference";
        case Compare::Lequal:
            return "s3 <= alphaReference";
        case Compare::Greater:
            return "s3 > alphaReference";
        case Compare::Notequal:
            return "s3 != alphaReference";
        case Compare::Gequal:
            return "s3 >= alphaReference";
        case Compare::Always:
            break;
    }
    return "true";
}

std::string sourceText(const EmulatedDraw& state) {
    const char* toBytes = "ivec4 source = ivec4(clamp({}, 0.0, 1.0) * 255.0 + 0.5);\n";
    std::string text;
    switch (state.from) {
        case FragmentSource::Constant:
            if (!state.constant) return "    ivec4 source = constantSource;\n";
            return fmt::format("    ivec4 source = ivec4({});\n", fmt::join(*state.constant, ", "));
        case FragmentSource::Interpolated:
            text = fmt::format(fmt::runtime(toBytes), "gl_Color");
            break;
        case FragmentSource::TextureAll:
        case FragmentSource::TextureColour:
        case FragmentSource::TextureAlpha:
            text = fmt::format(fmt::runtime(toBytes), "texture2D(image, gl_TexCoord[0].xy)");
            break;
    }
    // The constant's alpha is in the chip's terms already.
    if (isGs(state.chip.unit)) text += "    source.a = (2 * source.a * 128 + 255) / 510;\n";
    if (state.from == FragmentSource::TextureColour) text += "    source.a = constantSource.a;\n";
    if (state.from == FragmentSource::TextureAlpha) text += "    source.rgb = constantSource.rgb;\n";
    return "    " + text;
}

std::string depthText(const EmulatedDraw& state) {
    switch (state.chip.depth) {
        case DepthEncoding::Linear:
            return fmt::format(
                "    gl_FragDepth = float(linear(int(gl_FragCoord.z * 16777216.0), {})) / {}.0;\n",
                state.format.depth, (1u << state.format.depth) - 1);
        case DepthEncoding::VoodooW:
            return "    gl_FragDepth = float(voodooW(beyond * gl_FragCoord.w)) / 65535.0;\n";
        case DepthEncoding::N64:
            return "    gl_FragDepth = float(n64(min(int(gl_FragCoord.z * 262144.0), 262143))) / 16383.0;\n";
    }
    return {};
}

/// Quotients by 255, rounded down and to the nearest: exact up to 255 times 255, and at least 255 beyond,
/// where every chip clamps.
constexpr const char* kFunctions = R"(
int floor255(int v) { return (v + 1 + (v >> 8)) >> 8; }
int quotient255(int v) { return v < 0 ? -floor255(-v) : floor255(v); }
int round255(int v) { int u = v + 128; return (u + (u >> 8)) >> 8; }
int nv3(int s, int d, int f) { return f == 15 ? s : f == 0 ? d : (d * (16 - f) + s * f) >> 4; }
int voodooDithered5(int v, int cell) { return (2 * v - (v >> 4) + (v >> 7) + cell) >> 4; }
int voodooDithered6(int v, int cell) { return (4 * v - (v >> 4) + (v >> 6) + cell) >> 4; }
int virgeDithered(int v, int cell) { return v > 248 ? 31 : (v + cell) >> 3; }
int rdpDithered(int v, int cell) { return (v & 7) <= cell ? v : v > 247 ? 255 : (v & 248) + 8; }
// The nearest of 2^bits - 1 steps; z in units of 2^-24.
int linear(int z, int bits) {
    int low = z & (1 << 24 - bits) - 1;
    return (z >> 24 - bits) + ((low << bits) - z + (1 << 23) >> 24);
}
// 4 bits of exponent, 12 of mantissa: those of the float.
int voodooW(float inverse) {
    uint bits = floatBitsToUint(inverse);
    int exponent = 126 - int(bits >> 23);
    if (inverse >= 1.0) return 0;
    if (exponent >= 16) return 65535;
    return min((exponent << 12 | (4095 - int(bits >> 11 & 4095u))) + 1, 65535);
}
int n64(int z) {
    int exponent = 0;
    while (exponent < 7 && (z & 131072 >> exponent) != 0) ++exponent;
    return exponent << 11 | (z >> max(6 - exponent, 0) & 2047);
}
)";

}  // namespace

bool storesOtherDepth(const BufferFormat& format, const ChipArithmetic& chip) {
    if (format.depth == 0) return false;
    // OpenGL has a stencil beside 24 bits only.
    const bool native = format.stencil > 0 ? format.depth >= 24
                                           : format.depth == 16 || format.depth == 24 || format.depth == 32;
    return chip.depth != DepthEncoding::Linear || !native;
}

std::string vertexProgram(const EmulatedDraw& state) {
    if (!state.writesDepth || state.chip.depth != DepthEncoding::VoodooW) return {};
    // z = w - 2 * near: half of what is between them is near, of points at infinity 0.
    return R"(
#version 330 compatibility
out float beyond;
void main() {
    gl_Position = gl_Vertex;
    beyond = 0.5 * (gl_Vertex.w - gl_Vertex.z);
    gl_FrontColor = gl_Color;
    gl_BackColor = gl_Color;
    gl_TexCoord[0] = gl_MultiTexCoord0;
}
)";
}

std::string fragmentProgram(const EmulatedDraw& state) {
    const BufferFormat& format = state.format;
    const std::uint32_t all = wordMask(format, 15), written = wordMask(format, state.channels);
    const bool reads = written != 0 && (state.blends || state.inverts || written != all);
    std::string text = "#version 330 compatibility\n";
    if (reads) text += "#extension GL_EXT_shader_framebuffer_fetch : require\n";
    text +=
        "uniform ivec4 constantSource;\nuniform ivec4 blendColour;\nuniform int alphaReference;\n"
        "uniform sampler2D image;\n";
    if (!vertexProgram(state).empty()) text += "in float beyond;\n";
    if (written != 0) text += reads ? "inout uvec4 word;\n" : "out uvec4 word;\n";
    text += kFunctions;
    text += "void main() {\n";
    text += sourceText(state);
    text += "    int s3 = source.a;\n";
    if (state.alphaTest != Compare::Always)
        text += fmt::format("    if (!({})) discard;\n", compareText(state.alphaTest));
    if (written != 0) {
        text += fmt::format("    int row = {} - int(gl_FragCoord.y), column = int(gl_FragCoord.x);\n",
                            state.rows - 1);
        text += fmt::format("    int cell = {};\n", cellText(state.dither));
        if (reads) text += "    int old = int(word.r);\n";
        for (int c = 0; c < 4; ++c) {
            const int bits = channelBits(format, c);
            if (reads && bits > 0)
                text += channelShift(format, c) + bits == wordBits(format)
                            ? fmt::format("    int c{} = int(word.r >> {}u);\n", c, channelShift(format, c))
                            : fmt::format("    int c{} = old >> {} & {};\n", c, channelShift(format, c),
                                          largestCode(bits));
            else
                text += fmt::format("    int c{} = 0;\n", c);
            text += fmt::format("    int d{} = {};\n", c, readBackText(state, c));
            if (c < kAlpha) {
                const bool cuts = state.chip.unit == BlendUnit::Nv2a && bits > 0 && bits < 8 && state.blends;
                const bool dithersFirst = state.dither == DitherMode::Psx && dithersChannel(state, c);
                text += cuts ? fmt::format("    int s{0} = source[{0}] >> {1} << {1};\n", c, 8 - bits)
                        : dithersFirst
                            ? fmt::format("    int s{0} = clamp(source[{0}] + cell, 0, 255) & 248;\n", c)
                            : fmt::format("    int s{0} = source[{0}];\n", c);
            }
            text += fmt::format("    int k{0} = blendColour[{0}];\n", c);
        }
        std::string packed = reads ? fmt::format("(old & {})", std::int32_t(all & ~written)) : "0";
        for (int c = 0; c < 4; ++c) {
            const int bits = channelBits(format, c), shift = channelShift(format, c);
            if (bits == 0 || !(state.channels >> c & 1)) continue;
            const auto form = shortForm(state, c);
            const std::string code =
                form ? *form
                : state.inverts
                    ? fmt::format("{} - c{}", largestCode(bits), c)
                    : storedText(state, c, state.blends ? blended(state, c) : fmt::format("s{}", c));
            packed += fmt::format(" | ({}) << {}", code, shift);
        }
        text += fmt::format("    word = uvec4({}, 0, 0, 0);\n", packed);
    }
    if (state.writesDepth) text += depthText(state);
    return text + "}\n";
}

}  // namespace gnomon
