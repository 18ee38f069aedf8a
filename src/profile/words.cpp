#include "profile/words.h"

#include <array>
#include <cassert>
#include <cctype>

namespace gnomon {

template <>
std::span<const std::string> names<BlendFactor>() {
    static const std::array<std::string, 15> kNames{"zero",
                                                    "one",
                                                    "src_color",
                                                    "one_minus_src_color",
                                                    "dst_color",
                                                    "one_minus_dst_color",
                                                    "src_alpha",
                                                    "one_minus_src_alpha",
                                                    "dst_alpha",
                                                    "one_minus_dst_alpha",
                                                    "src_alpha_saturate",
                                                    "constant_color",
                                                    "one_minus_constant_color",
                                                    "constant_alpha",
                                                    "one_minus_constant_alpha"};
    return kNames;
}

template <>
std::span<const std::string> names<BlendEquation>() {
    static const std::array<std::string, 8> kNames{
        "add", "subtract", "reverse_subtract", "min",
        "max", "add_wrap", "signed_add",       "signed_reverse_subtract"};
    return kNames;
}

template <>
std::span<const std::string> names<Compare>() {
    static const std::array<std::string, 8> kNames{"never",   "less",     "equal",  "lequal",
                                                   "greater", "notequal", "gequal", "always"};
    return kNames;
}

template <>
std::span<const std::string> names<StencilOp>() {
    static const std::array<std::string, 8> kNames{"keep", "zero",   "replace",   "incr",
                                                   "decr", "invert", "incr_wrap", "decr_wrap"};
    return kNames;
}

template <>
std::span<const std::string> names<WriteMask>() {
    static const std::array<std::string, 3> kNames{"fixed", "group", "channel"};
    return kNames;
}

template <>
std::span<const std::string> names<FrameTexture>() {
    static const std::array<std::string, 4> kNames{"none", "host", "copy", "direct"};
    return kNames;
}

template <>
std::span<const std::string> names<BlendUnit>() {
    static const std::array<std::string, 17> kNames{"ideal_round",
                                                    "ideal_floor",
                                                    "products_round",
                                                    "products_floor",
                                                    "voodoo_mame",
                                                    "voodoo_86box",
                                                    "gs",
                                                    "gs_wrap",
                                                    "powervr",
                                                    "flipper",
                                                    "rdp",
                                                    "ge",
                                                    "nv3",
                                                    "virge",
                                                    "ds",
                                                    "psx",
                                                    "nv2a"};
    return kNames;
}

template <>
std::span<const std::string> names<DitherMode>() {
    static const std::array<std::string, 11> kNames{"off",          "4x4",       "4x4_subtract", "2x2",
                                                    "2x2_subtract", "gs_4x4",    "virge_4x4",    "psx_4x4",
                                                    "rdp_magic",    "rdp_bayer", "ge_4x4"};
    return kNames;
}

template <>
std::span<const std::string> names<DepthEncoding>() {
    static const std::array<std::string, 3> kNames{"linear", "voodoo_w", "n64"};
    return kNames;
}

template <>
std::span<const std::string> names<Evidence>() {
    static const std::array<std::string, 6> kNames{"recorded", "document", "emulator",
                                                   "driver",   "derived",  "guess"};
    return kNames;
}

namespace {

template <class Word>
const std::string& nameOf(Word word) {
    const auto index = static_cast<std::size_t>(word);
    assert(index < names<Word>().size());
    return names<Word>()[index];
}

}  // namespace

const std::string& name(BlendFactor word) {
    return nameOf(word);
}
const std::string& name(BlendEquation word) {
    return nameOf(word);
}
const std::string& name(Compare word) {
    return nameOf(word);
}
const std::string& name(StencilOp word) {
    return nameOf(word);
}
const std::string& name(WriteMask word) {
    return nameOf(word);
}
const std::string& name(FrameTexture word) {
    return nameOf(word);
}

const std::string& name(BlendUnit word) {
    return nameOf(word);
}
const std::string& name(DitherMode word) {
    return nameOf(word);
}
const std::string& name(DepthEncoding word) {
    return nameOf(word);
}
const std::string& name(Evidence word) {
    return nameOf(word);
}

std::span<const ColourFormat> knownColourFormats() {
    // 1555 and 5551 differ in where the alpha bit lies, not in what they hold.
    static const std::array<ColourFormat, 9> kFormats{{{"565", 5, 6, 5, 0},
                                                       {"555", 5, 5, 5, 0},
                                                       {"1555", 5, 5, 5, 1},
                                                       {"5551", 5, 5, 5, 1},
                                                       {"4444", 4, 4, 4, 4},
                                                       {"6666", 6, 6, 6, 6},
                                                       {"6665", 6, 6, 6, 5},
                                                       {"888", 8, 8, 8, 0},
                                                       {"8888", 8, 8, 8, 8}}};
    return kFormats;
}

std::string upperCase(std::string word) {
    for (char& c : word) c = char(std::toupper(static_cast<unsigned char>(c)));
    return word;
}

}  // namespace gnomon
