#include "gl/blend_text.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "profile/blend.h"

namespace gnomon {
namespace {

using enum BlendFactor;

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
    if (isBeyondGs(source) || isBeyondGs(destination)) refuseSetting(state, c, name(equation).c_str());

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
    if (sourceVaries && destinationVaries && f.value != g.value)
        refuseSetting(state, c, name(equation).c_str());
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
    refuseSetting(state, c, name(equation).c_str());
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
    refuseSetting(state, c, name(equation).c_str());
}

}  // namespace

void refuseSetting(const EmulatedDraw& state, int c, const char* what) {
    const auto side = std::size_t(c == kAlpha);
    throw std::runtime_error(fmt::format("blend {} {} by equation {} in the blend unit {}",
                                         name(state.source[side]), name(state.destination[side]), what,
                                         name(state.chip.unit)));
}

std::string blendText(const EmulatedDraw& state, int c) {
    const auto side = std::size_t(c == kAlpha);
    const BlendEquation equation = state.equation[side];
    const BlendUnit unit = state.chip.unit;
    const std::string s = fmt::format("s{}", c), d = fmt::format("d{}", c);
    if (isGs(unit) && c == kAlpha) return s;
    if (unit == BlendUnit::Ge && c == kAlpha) return d;
    const bool wrapsAtGl = state.chip.fidelity == Fidelity::Gl && equation == BlendEquation::AddWrap;
    if (!wrapsAtGl && !hasOperation(unit, operationOf(equation)))
        refuseSetting(state, c, name(equation).c_str());
    if (equation == BlendEquation::Min) return fmt::format("min({}, {})", s, d);
    if (equation == BlendEquation::Max) return fmt::format("max({}, {})", s, d);
    if (equation == BlendEquation::SignedAdd || equation == BlendEquation::SignedReverseSubtract) {
        if (unit != BlendUnit::Nv2a) refuseSetting(state, c, name(equation).c_str());
        const char sign = equation == BlendEquation::SignedAdd ? '+' : '-';
        return fmt::format("({} {} ({} < 128 ? {} : {} - 256))", d, sign, s, s, s);
    }
    const Factor f = factorOf(state, state.source[side], c), g = factorOf(state, state.destination[side], c);
    if (isGs(unit)) return gsSetting(state, c, f, g);
    switch (unit) {
        case BlendUnit::Virge:
        case BlendUnit::Rdp:
        case BlendUnit::Nv3:
        case BlendUnit::Ds:
        case BlendUnit::Psx:
            return fixedSetting(state, c, f, g);
        default:
            return byFactors(state, c, f, g);
    }
}

}  // namespace gnomon
