#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

#include "app/commands.h"
#include "app/options.h"
#include "report/prove_report.h"

namespace gnomon {
namespace {

struct Options {
    ProfileOption profiles{};
    std::vector<std::string> stores{"screen"}, arithmetics{}, orders{"volume"};
    std::optional<int> levels{};
    FormatOption format{};
};

template <class Word>
std::vector<Word> wordsOf(const std::string& flag, const std::vector<std::string>& words, int count) {
    std::vector<std::string> known;
    for (int i = 0; i < count; ++i) known.push_back(name(Word(i)));
    std::vector<Word> values;
    for (const std::string& word : words) {
        const auto at = std::find(known.begin(), known.end(), word);
        if (at == known.end())
            throw UsageError(
                fmt::format("{}: no such value '{}' (known: {})", flag, word, fmt::join(known, ", ")));
        const Word value = Word(at - known.begin());
        if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
    }
    if (words.empty())
        for (int i = 0; i < count; ++i) values.push_back(Word(i));
    return values;
}

/// What a chip lacks, and who says so; nothing if it lacks nothing.
struct Lack {
    std::string what{}, source{};
};

/// What @p profile lacks for blending that @p arithmetic asks of the colour channels or of alpha.
Lack lackOf(const Profile& profile, bool alpha, MaskArithmetic arithmetic, BlendUnit unit) {
    using enum BlendFactor;
    if (alpha && profile.alphaBits == 0) return {"destination alpha", profile.sourceOf("alpha_bits")};
    if (alpha && profile.alphaExcludesDepth)
        return {"destination alpha beside depth", profile.sourceOf("alpha_excludes_depth")};
    if (alpha && !profile.blendWritesAlpha)
        return {"blending of destination alpha", profile.sourceOf("blend_writes_alpha")};

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
    // The PS2's difference and the N64's wrapping sum take away without an equation.
    const bool takesAway = unit == BlendUnit::Gs || unit == BlendUnit::GsWrap || unit == BlendUnit::Rdp;
    if (arithmetic == MaskArithmetic::Count && !takesAway &&
        !profile.blendEquations.contains(BlendEquation::ReverseSubtract))
        return {"blend equation reverse_subtract", profile.sourceOf("blend_equations")};
    return {};
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

/// The driver's default and no dithering; dithering never touches alpha or eight bits.
std::vector<DitherMode> dithersOf(const Profile& profile, bool alpha, int bits) {
    std::vector<DitherMode> modes{DitherMode::Off};
    if (!alpha && (bits == 5 || bits == 6) && !profile.ditherModes.empty() &&
        profile.ditherModes.front() != DitherMode::Off)
        modes.push_back(profile.ditherModes.front());
    return modes;
}

void addRows(const Profile& profile, const std::string& store, MaskArithmetic arithmetic, DrawOrder order,
             std::optional<int> levels, std::vector<ProofRow>& rows) {
    const bool alpha = store == "alpha";
    std::optional<Evidence> grade;
    for (const Profile::Fact& fact : profile.facts)
        if (fact.key == "blend_units") grade = fact.grade;
    std::vector<BlendUnit> units = profile.blendUnits;
    if (units.empty()) units = {profile.blendUnit()};
    for (const BlendUnit unit : units) {
        ProofRow row{.profile = profile.id, .store = store, .grade = grade};
        row.claim = {{.unit = unit}, arithmetic, order};
        const Lack lack = lackOf(profile, alpha, arithmetic, unit);
        if (!lack.what.empty()) {
            row.refused = lack.what;
            row.source = lack.source;
            rows.push_back(row);
            return;  // of the other units it would be said again
        }
        const auto widths = widthsOf(profile, alpha);
        if (widths.empty()) {
            row.refused = "a channel of two bits or more";
            row.source = profile.sourceOf(alpha ? "alpha_bits" : "colour_formats");
            rows.push_back(row);
            return;
        }
        for (const auto& width : widths) {
            row.format = width.first;
            row.claim.channel = {.unit = unit, .bits = width.second};
            row.proof.reset();
            const bool tooDeep = arithmetic == MaskArithmetic::Double && levels.value_or(0) > width.second;
            if (tooDeep) {
                row.refused = fmt::format("bits for {} levels: its channel has {}", *levels, width.second);
                row.source = profile.sourceOf("colour_formats");
            } else if (!canDraw(row.claim.channel, arithmetic)) {
                row.refused = fmt::format("it in {} bits of its blend unit {}", width.second, name(unit));
                row.source = profile.sourceOf("blend_units");
            }
            if (!row.refused.empty()) {
                rows.push_back(row);
                row.refused.clear();
                row.source.clear();
                continue;
            }
            for (const DitherMode dither : dithersOf(profile, alpha, width.second)) {
                row.claim.channel.dither = dither;
                row.proof = bestProof(row.claim, startsOf(row.claim, levels));
                rows.push_back(row);
            }
        }
    }
}

int run(const Options& options) {
    for (const std::string& store : options.stores)
        if (store != "screen" && store != "alpha")
            throw UsageError(fmt::format("--store: no such value '{}' (known: screen, alpha)", store));
    const auto arithmetics = wordsOf<MaskArithmetic>("--arithmetic", options.arithmetics, kMaskArithmetics);
    const auto orders = wordsOf<DrawOrder>("--order", options.orders, kDrawOrders);
    if (options.levels && (*options.levels < 1 || *options.levels > 8))
        throw UsageError(fmt::format("--levels: {} is not within 1 to 8", *options.levels));
    std::vector<ProofRow> rows;
    for (const Profile& profile : options.profiles.load())
        for (const std::string& store : options.stores)
            for (const MaskArithmetic arithmetic : arithmetics)
                for (const DrawOrder order : orders)
                    addRows(profile, store, arithmetic, order, options.levels, rows);
    fmt::print("{}", showProofs(rows, options.format.value()));
    return 0;
}

}  // namespace

void addProve(CLI::App& app, int& status) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "prove", "Every reachable mask value of a chip's own arithmetic; a counterexample where it fails");
    options->profiles.addTo(*command, "chips (default: all)");
    command->add_option("--store", options->stores, "screen, alpha: the channel (default: screen)")
        ->delimiter(',');
    command->add_option("--arithmetic", options->arithmetics, "double, halve, parity, count (default: all)")
        ->delimiter(',');
    command->add_option("--levels", options->levels,
                        "double starts at 2^-levels, 1 to 8 (default: the best start of all codes)");
    command
        ->add_option("--order", options->orders,
                     "volume (fronts, then backs of one convex volume after the other; default), "
                     "fronts-first, per-triangle")
        ->delimiter(',');
    options->format.addTo(*command);
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gnomon
