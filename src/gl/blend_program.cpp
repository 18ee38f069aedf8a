#include "gl/blend_program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <stdexcept>

#include "gl/blend_text.h"
#include "gl/pixel_words.h"
#include "gl/store_text.h"
#include "profile/blend.h"
#include "profile/pixel.h"

namespace gnomon {
namespace {

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

std::optional<std::string> blendUnitLacks(const BufferFormat& format, const ChipArithmetic& chip,
                                          const Pass& pass) {
    if (!pass.blend.enabled || pass.logicInvert || !pass.write.any() || pass.kind == PassKind::Clear)
        return {};
    EmulatedDraw draw{.format = format, .chip = chip, .channels = 0, .blends = true};
    const std::array written{pass.write.red, pass.write.green, pass.write.blue, pass.write.alpha};
    for (unsigned c = 0; c < 4; ++c)
        if (written[c]) draw.channels |= 1u << c;
    draw.source.fill(pass.blend.source), draw.destination.fill(pass.blend.destination);
    draw.equation.fill(pass.blend.equation);
    const bool isConstant = pass.kind != PassKind::Scene && pass.texture == MaskTexture::None;
    draw.from = isConstant                     ? FragmentSource::Constant
                : pass.kind == PassKind::Scene ? FragmentSource::Interpolated
                                               : FragmentSource::TextureAll;
    try {
        fragmentProgram(draw);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

bool storesAsOpenGl(const BufferFormat& format, const ChipArithmetic& chip, DitherMode dither,
                    unsigned channels, bool blends, bool isOpenGls) {
    if (!isBytes(format) || (isGs(chip.unit) && (channels & 8)) || dithers(dither, 8)) return false;
    return !blends || (chip.fidelity == Fidelity::Gl && isOpenGls);
}

bool dependsOnChip(const BufferFormat& format, const ChipArithmetic& chip, const Pass& pass) {
    if (chip.fidelity == Fidelity::Gl || pass.target == Target::DepthMap || pass.kind == PassKind::Copy)
        return false;
    if (pass.kind == PassKind::Clear) return pass.write.any() && !isBytes(format);
    if (storesOtherDepth(format, chip) && (pass.depthTest || pass.depthWrite)) return true;
    unsigned channels = 0;
    const std::array written{pass.write.red, pass.write.green, pass.write.blue, pass.write.alpha};
    for (int c = 0; c < 4; ++c)
        if (written[std::size_t(c)] && channelBits(format, c) > 0) channels |= 1u << c;
    // Masks are drawn undithered, and the rest as the chip's driver does.
    const DitherMode dither = chip.dither == DitherMode::Off ? chip.undithered : chip.dither;
    return channels != 0 &&
           !storesAsOpenGl(format, chip, dither, channels, pass.blend.enabled && !pass.logicInvert,
                           pass.blend.equation < BlendEquation::AddWrap);
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
                    : storedText(state, c, state.blends ? blendText(state, c) : fmt::format("s{}", c));
            packed += fmt::format(" | ({}) << {}", code, shift);
        }
        text += fmt::format("    word = uvec4({}, 0, 0, 0);\n", packed);
    }
    if (state.writesDepth) text += depthText(state);
    return text + "}\n";
}

}  // namespace gnomon
