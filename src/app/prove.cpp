#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "app/commands.h"
#include "app/options.h"
#include "app/word_values.h"
#include "report/prove_report.h"

namespace gnomon {
namespace {

struct ProveOptions {
    ProfileOption profiles{};
    std::vector<std::string> stores{"screen"}, arithmetics{}, orders{};
    std::optional<int> levels{};
    FormatOption format{};
};

/// What a chip lacks, and who says so; nothing if it lacks nothing.
struct Lack {
    std::string what{}, source{};
};

/// What @p profile lacks for a mask in alpha.
Lack lackOfAlpha(const Profile& profile) {
    if (profile.alphaBits == 0) return {"destination alpha", profile.sourceOf("alpha_bits")};
    if (profile.alphaExcludesDepth)
        return {"destination alpha beside depth", profile.sourceOf("alpha_excludes_depth")};
    if (!profile.blendWritesAlpha)
        return {"blending of destination alpha", profile.sourceOf("blend_writes_alpha")};
    return {};
}

/// What @p profile lacks of the blend factors that @p arithmetic asks of the colour channels or of alpha.
Lack lackOf(const Profile& profile, bool alpha, MaskArithmetic arithmetic) {
    using enum BlendFactor;
    // A profile that says so; one that says nothing of depth is of arithmetic alone.
    const bool saysNoDepth = std::any_of(profile.facts.begin(), profile.facts.end(), [&](const auto& fact) {
        return fact.key == "depth_bits" && !profile.depth;
    });
    if (saysNoDepth) return {"a depth buffer", profile.sourceOf("depth_bits")};
    if (alpha)
        if (Lack lack = lackOfAlpha(profile); !lack.what.empty()) return lack;

    std::vector<BlendPair> pairs;
    if (arithmetic == MaskArithmetic::Double || arithmetic == MaskArithmetic::Halve)
        pairs = {{DstColor, One}, {DstColor, Zero}};
    else if (arithmetic == MaskArithmetic::Parity)
        pairs = {{OneMinusDstColor, Zero}};
    else
        pairs = {{One, One}};
    for (const auto& [source, destination] : pairs) {
        const bool has = alpha ? profile.alphaSourceFactors.contains(source) &&
                                     profile.alphaDestinationFactors.contains(destination)
                               : profile.allowsBlendWithConstantSource(source, destination);
        if (has) continue;
        const char* key = alpha                           ? "alpha_source_factors"
                          : profile.sourceFactors.empty() ? "blend_pairs"
                                                          : "source_factors";
        return {fmt::format("blend {} {}", name(source), name(destination)), profile.sourceOf(key)};
    }
    return {};
}

/// By what @p profile can draw @p arithmetic on @p unit, or what it lacks for all of it.
struct Ways {
    std::vector<MaskMeans> means{};
    Lack lack{};
};

Ways waysOf(const Profile& profile, bool alpha, MaskArithmetic arithmetic, BlendUnit unit) {
    const auto hasEquation = [&](BlendEquation equation) {
        return profile.blendEquations.contains(equation);
    };
    const Lack lack = lackOf(profile, alpha, arithmetic);
    Ways ways;
    if (arithmetic == MaskArithmetic::Parity) {
        const Lack alphaLack = alpha ? lackOfAlpha(profile) : Lack{};
        if (lack.what.empty()) ways.means.push_back(MaskMeans::Blend);
        if (profile.logicOps && alphaLack.what.empty()) ways.means.push_back(MaskMeans::LogicOp);
        if (ways.means.empty()) ways.lack = lack;
        return ways;
    }
    if (!lack.what.empty()) return {{}, lack};
    if (arithmetic != MaskArithmetic::Count) return {{MaskMeans::Blend}, {}};

    // The N64's sum and the PS2's with COLCLAMP 0 take away by wrapping; with COLCLAMP 1 the PS2 takes away
    // by its difference.
    const bool gsBesides = std::find(profile.blendUnits.begin(), profile.blendUnits.end(), BlendUnit::Gs) !=
                           profile.blendUnits.end();
    const bool onlyWraps = unit == BlendUnit::GsWrap || unit == BlendUnit::Rdp;
    const bool wraps = hasEquation(BlendEquation::AddWrap);
    if (!onlyWraps && (hasEquation(BlendEquation::ReverseSubtract) || unit == BlendUnit::Gs))
        ways.means.push_back(MaskMeans::Blend);
    // gs_wrap beside gs is COLCLAMP 0 by another name.
    if (wraps ? !(unit == BlendUnit::GsWrap && gsBesides) : onlyWraps)
        ways.means.push_back(MaskMeans::AddWrap);
    if (ways.means.empty() && !onlyWraps)
        ways.lack = {"blend equation reverse_subtract or add_wrap", profile.sourceOf("blend_equations")};
    return ways;
}

/// The channels of different widths that may hold the mask, each with its format.
std::vector<std::pair<std::string, int>> widthsOf(const Profile& profile, bool alpha) {
    std::vector<std::pair<std::string, int>> widths;
    for (const ColourFormat& f : profile.colourFormats) {
        const std::vector<int> bits = alpha ? std::vector<int>{f.alpha == profile.alphaBits ? f.alpha : 0}
                                            : std::vector<int>{f.red, f.green};
        for (const int b : bits) {
            const bool isNew =
                std::none_of(widths.begin(), widths.end(), [&](const auto& w) { return w.second == b; });
            if (b > 1 && isNew) widths.emplace_back(f.name, b);
        }
    }
    return widths;
}

/// The modes that the profile lists, its driver's default first; off where none touches these bits. Dithering
/// never touches alpha.
std::vector<DitherMode> dithersOf(const Profile& profile, bool alpha, int bits) {
    std::vector<DitherMode> modes;
    for (const DitherMode mode : profile.ditherModes)
        if (mode == DitherMode::Off || (!alpha && dithers(mode, bits))) modes.push_back(mode);
    const bool dithersAtAll =
        std::any_of(modes.begin(), modes.end(), [](DitherMode mode) { return mode != DitherMode::Off; });
    if (!dithersAtAll) return {DitherMode::Off};
    return modes;
}

/// Proofs that several chips share.
using Proofs = std::map<std::pair<MaskClaim, std::optional<int>>, MaskProof>;

const MaskProof& proofOf(const MaskClaim& claim, std::optional<int> levels, Proofs& proofs) {
    const std::pair key(claim, levels);
    const auto at = proofs.find(key);
    if (at != proofs.end()) return at->second;
    return proofs.emplace(key, bestProof(claim, startsOf(claim, levels))).first->second;
}

/// What double starts from: the best code, and then each level that the bits hold, unless one is @p asked
/// for.
std::vector<std::optional<int>> levelsOf(const MaskClaim& claim, std::optional<int> asked) {
    if (claim.arithmetic != MaskArithmetic::Double) return {std::nullopt};
    if (asked) return {asked};
    std::vector<std::optional<int>> all{std::nullopt};
    for (int levels = 1; levels <= claim.channel.bits; ++levels) all.emplace_back(levels);
    return all;
}

/// The channel's unit at @p bits: what it can't draw.
std::string lackOfUnit(const MaskClaim& claim, std::optional<int> levels) {
    const int bits = claim.channel.bits;
    if (claim.arithmetic == MaskArithmetic::Double && levels.value_or(0) > bits)
        return fmt::format("bits for {} levels: its channel has {}", *levels, bits);
    if (!canDraw(claim.channel, claim.arithmetic, claim.means))
        return fmt::format("it in {} bits of its blend unit {}", bits, name(claim.channel.unit));
    return "";
}

void addRows(const Profile& profile, const std::string& store, MaskArithmetic arithmetic, DrawOrder order,
             std::optional<int> levels, Proofs& proofs, std::vector<ProofRow>& rows) {
    const bool alpha = store == "alpha";
    std::optional<Evidence> grade;
    for (const Profile::Fact& fact : profile.facts)
        if (fact.key == "blend_units") grade = fact.grade;
    std::vector<BlendUnit> units = profile.blendUnits;
    if (units.empty()) units = {profile.blendUnit()};
    for (const BlendUnit unit : units) {
        ProofRow row{.profile = profile.id, .store = store, .grade = grade};
        row.claim = {{.unit = unit}, arithmetic, order};
        if (!profile.colourFormats.empty()) {
            const ColourFormat& format = profile.colourFormats.front();
            row.format = format.name;
            row.claim.channel.bits = alpha ? format.alpha : format.red;
        }
        const auto refuse = [&](const std::string& what, const std::string& source) {
            row.refused = what;
            row.source = source;
            rows.push_back(row);
            row.refused.clear();
            row.source.clear();
        };
        const Ways ways = waysOf(profile, alpha, arithmetic, unit);
        // Of the other units it would be said again.
        if (!ways.lack.what.empty()) return refuse(ways.lack.what, ways.lack.source);
        const auto widths = widthsOf(profile, alpha);
        if (widths.empty())
            return refuse("a channel of two bits or more",
                          profile.sourceOf(alpha ? "alpha_bits" : "colour_formats"));
        for (const MaskMeans means : ways.means)
            for (const auto& width : widths) {
                row.format = width.first;
                row.claim.channel = {.unit = unit, .bits = width.second};
                row.claim.means = means;
                row.proof.reset();
                row.isDefaultDither = false;
                if (const std::string lack = lackOfUnit(row.claim, levels); !lack.empty()) {
                    const bool tooDeep = lack.starts_with("bits");
                    refuse(lack, profile.sourceOf(tooDeep ? "colour_formats" : "blend_units"));
                    continue;
                }
                const auto dithers = dithersOf(profile, alpha, width.second);
                for (const DitherMode dither : dithers) {
                    row.claim.channel.dither = dither;
                    row.isDefaultDither = dithers.size() > 1 && dither == profile.ditherModes.front();
                    for (const std::optional<int> from : levelsOf(row.claim, levels)) {
                        row.levels = from;
                        row.proof = proofOf(row.claim, from, proofs);
                        rows.push_back(row);
                    }
                    row.levels.reset();
                }
            }
    }
}

/// All orders; the one of z-fail without a farther test for the chips that need it.
std::vector<DrawOrder> ordersOf(const Profile& profile) {
    std::vector<DrawOrder> orders{DrawOrder::Volume, DrawOrder::FrontsFirst, DrawOrder::PerTriangle};
    const bool farther =
        profile.depthFunctions.contains(Compare::Greater) && profile.depthFunctions.contains(Compare::Gequal);
    if (!farther && profile.depthFunctions.contains(Compare::Always)) orders.push_back(DrawOrder::NearerOnly);
    return orders;
}

int run(const ProveOptions& options) {
    for (const std::string& store : options.stores)
        if (store != "screen" && store != "alpha")
            throw UsageError(fmt::format("--store: no such value '{}' (known: screen, alpha)", store));
    auto arithmetics = wordsOf<MaskArithmetic>("--arithmetic", options.arithmetics, kMaskArithmetics);
    for (int i = 0; options.arithmetics.empty() && i < kMaskArithmetics; ++i)
        arithmetics.push_back(MaskArithmetic(i));
    const auto chosen = wordsOf<DrawOrder>("--order", options.orders, kDrawOrders);
    if (options.levels && (*options.levels < 1 || *options.levels > 8))
        throw UsageError(fmt::format("--levels: {} is not within 1 to 8", *options.levels));
    std::vector<ProofRow> rows;
    Proofs proofs;
    for (const Profile& profile : options.profiles.load())
        for (const std::string& store : options.stores)
            for (const MaskArithmetic arithmetic : arithmetics)
                for (const DrawOrder order : options.orders.empty() ? ordersOf(profile) : chosen)
                    addRows(profile, store, arithmetic, order, options.levels, proofs, rows);
    fmt::print("{}", showProofs(rows, options.format.value()));
    return 0;
}

}  // namespace

void addProve(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<ProveOptions>();
    CLI::App* command = app.add_subcommand(
        "prove", "Every reachable mask value of a chip's own arithmetic; a counterexample where it fails");
    options->profiles.addTo(*command, "chips (default: all)");
    command->add_option("--store", options->stores, "screen, alpha: the channel (default: screen)")
        ->delimiter(',');
    command->add_option("--arithmetic", options->arithmetics, "double, halve, parity, count (default: all)")
        ->delimiter(',');
    command->add_option(
        "--levels", options->levels,
        "double starts at 2^-levels, 1 to 8 (default: the best start of all codes, then each)");
    command
        ->add_option("--order", options->orders,
                     "volume (fronts, then backs of one convex volume after the other), fronts-first, "
                     "per-triangle, nearer-only (zfail where no farther fragment passes) (default: all; "
                     "nearer-only for chips that need it)")
        ->delimiter(',');
    options->format.addTo(*command);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gnomon
