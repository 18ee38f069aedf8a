#include "report/listings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "report/table.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

/// Rows under a head, in any format; JSON objects take the head's words as keys.
std::string listing(const std::vector<std::vector<std::string>>& rows, Format format) {
    if (format == Format::Text) return alignColumns(rows);
    if (format == Format::Csv) {
        std::string text;
        for (const auto& row : rows) text += csvLine(row);
        return text;
    }
    Json all = Json::array();
    for (std::size_t r = 1; r < rows.size(); ++r) {
        Json object;
        for (std::size_t i = 0; i < rows[r].size(); ++i) object[rows[0][i]] = rows[r][i];
        all.push_back(object);
    }
    return all.dump(2) + "\n";
}

std::string formatsOf(const Profile& p) {
    std::vector<std::string> names;
    for (const ColourFormat& f : p.colourFormats) names.push_back(f.name);
    return fmt::format("{}", fmt::join(names, " "));
}

/// The equations in the profile's words, or in @p shortly ones with the logic operations among them.
std::string equationsOf(const Profile& p, bool shortly) {
    const auto shortName = [](BlendEquation equation) -> std::string {
        switch (equation) {
            case BlendEquation::Subtract:
                return "sub";
            case BlendEquation::ReverseSubtract:
                return "rev";
            case BlendEquation::AddWrap:
                return "wrap";
            case BlendEquation::SignedAdd:
                return "sadd";
            case BlendEquation::SignedReverseSubtract:
                return "srev";
            default:
                return name(equation);
        }
    };
    std::vector<std::string> words;
    for (const BlendEquation e : p.blendEquations) words.push_back(shortly ? shortName(e) : name(e));
    if (shortly && p.logicOps) words.push_back("logic");
    return fmt::format("{}", fmt::join(words, " "));
}

std::string kindName(PassKind kind) {
    switch (kind) {
        case PassKind::Clear:
            return "clear";
        case PassKind::Scene:
            return "scene";
        case PassKind::Volume:
            return "volume";
        case PassKind::Rectangle:
            return "rectangle";
        case PassKind::Copy:
            return "copy";
    }
    return {};
}

/// Volume passes beyond these are folded in the text: a level has thousands.
constexpr std::size_t kShownVolumes = 8;

std::string counted(int number, const char* one, const char* many) {
    return fmt::format("{} {}", number, number == 1 ? one : many);
}

/// Of pass @p i, in the chip's own terms.
std::string termsOf(const PlanSheet& sheet, std::size_t i) {
    return i < sheet.chipTerms.size() ? sheet.chipTerms[i] : "";
}

std::string planText(const PlanSheet& sheet) {
    const Plan& plan = sheet.plan;
    std::vector<std::vector<std::string>> rows{{"pass", "draws", "what", "state"}};
    std::size_t volumes = 0;
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        const Pass& pass = plan.passes[i];
        if (pass.kind == PassKind::Volume && ++volumes > kShownVolumes) {
            if (volumes == kShownVolumes + 1) rows.push_back({"...", "volume", "", ""});
            continue;
        }
        rows.push_back(
            {fmt::format("{}", i + 1), kindName(pass.kind), pass.label, describeState(pass, plan.windows)});
        if (const std::string terms = termsOf(sheet, i); !terms.empty())
            rows.push_back({"", "", "", fmt::format("{}: {}", sheet.profile, terms)});
    }
    for (auto& row : rows)
        if (row[0] == "...")
            row[2] = fmt::format("{} more, front and back faces in turn", volumes - kShownVolumes);
    std::string text = fmt::format("{} ({}) on {}: {} at {}x{}, frame {}\n\n", sheet.method, sheet.shade,
                                   sheet.profile, sheet.scene, plan.width, plan.height, sheet.frame);
    text += alignColumns(rows);
    const PassCounts counts = countPasses(plan);
    text += fmt::format("\n{}, {}, {}, {}\n", counted(counts.scene, "scene pass", "scene passes"),
                        counted(counts.volume, "volume pass", "volume passes"),
                        counted(counts.rectangle, "rectangle", "rectangles"),
                        counted(counts.copy, "copy", "copies"));
    for (const Missing& m : sheet.missing)
        text += wrapText(fmt::format("refused: the chip lacks {} [{}]", m.what, m.source), 9) + "\n";
    return text;
}

Json planJson(const PlanSheet& sheet) {
    const PassCounts counts = countPasses(sheet.plan);
    Json passes = Json::array();
    for (std::size_t i = 0; i < sheet.plan.passes.size(); ++i) {
        const Pass& pass = sheet.plan.passes[i];
        passes.push_back({{"kind", kindName(pass.kind)},
                          {"label", pass.label},
                          {"state", describeState(pass, sheet.plan.windows)},
                          {"chip_terms", termsOf(sheet, i)}});
    }
    Json lacks = Json::array();
    for (const Missing& m : sheet.missing)
        lacks.push_back({{"capability", m.key}, {"what", m.what}, {"source", m.source}});
    return Json{{"method", sheet.method},
                {"shade", sheet.shade},
                {"profile", sheet.profile},
                {"scene", sheet.scene},
                {"width", sheet.plan.width},
                {"height", sheet.plan.height},
                {"frame", sheet.frame},
                {"passes", passes},
                {"counts",
                 {{"scene", counts.scene},
                  {"volume", counts.volume},
                  {"rectangle", counts.rectangle},
                  {"copy", counts.copy}}},
                {"missing", lacks}};
}

/// What a hard case is about, and what must come of it as commands that show it.
std::string promisesOf(const Scene& scene) {
    const HardCase& hard = *scene.hard;
    std::string text = fmt::format("family: {}\nwhat:   {}\nsource: {}\n", hard.family,
                                   wrapText(hard.what, 8), wrapText(hard.source, 8));
    if (!hard.fails.empty()) text += "\nmust be wrong\n";
    for (const HardCell& cell : hard.fails)
        text += fmt::format("  gnomon render {} {}\n    {}\n", scene.id, argumentsOf(cell), cell.cause);
    if (!hard.exact.empty()) text += "\nmust be exact\n";
    for (const HardCell& cell : hard.exact)
        text += fmt::format("  gnomon render {} {}\n", scene.id, argumentsOf(cell));
    return text;
}

std::string scenesJson(const std::vector<Scene>& scenes) {
    const auto cells = [](const std::vector<HardCell>& all) {
        Json list = Json::array();
        for (const HardCell& cell : all) {
            list.push_back({{"arguments", argumentsOf(cell)}});
            if (!cell.cause.empty()) list.back()["cause"] = cell.cause;
        }
        return list;
    };
    Json all = Json::array();
    for (const Scene& s : scenes) {
        Json object{{"scene", s.id},
                    {"objects", fmt::format("{}", s.objects.size())},
                    {"triangles", fmt::format("{}", triangleCount(s))},
                    {"lights", fmt::format("{}", s.lights.size())},
                    {"frames", fmt::format("{}", s.frames.size())},
                    {"title", s.title}};
        if (s.hard) {
            object["family"] = s.hard->family, object["what"] = s.hard->what;
            object["source"] = s.hard->source;
            object["fails"] = cells(s.hard->fails), object["exact"] = cells(s.hard->exact);
        }
        all.push_back(object);
    }
    return all.dump(2) + "\n";
}

}  // namespace

std::string listProfiles(const std::vector<Profile>& profiles, Format format) {
    const bool text = format == Format::Text;
    std::vector<std::vector<std::string>> rows{
        {"profile", "title", "year", "colour", "alpha", "depth", "stencil", "equations"}};
    if (!text) rows[0].push_back("logic_ops");
    rows[0].insert(rows[0].end(), {"textures", "largest", text ? "blend unit" : "blend_unit", "evidence"});
    for (const Profile& p : profiles) {
        const std::string alpha =
            p.alphaBits == 0 ? "-"
                             : fmt::format("{}{}", p.alphaBits, p.alphaExcludesDepth ? " or depth" : "");
        rows.push_back({p.id, p.title, p.year ? fmt::format("{}", p.year) : "", formatsOf(p), alpha,
                        p.depth ? fmt::format("{}", fmt::join(p.depthBits, " ")) : "-",
                        p.stencilBits ? fmt::format("{}", p.stencilBits) : "-", equationsOf(p, text)});
        if (!text) rows.back().push_back(p.logicOps ? "true" : "false");
        const auto further = p.blendUnits.size() > 1 ? fmt::format(" +{}", p.blendUnits.size() - 1) : "";
        const bool known = !p.blendUnits.empty();
        rows.back().insert(rows.back().end(),
                           {p.textureUnits ? fmt::format("{}x{}", p.textureUnits, p.maxTextureSize) : "-",
                            p.maxWidth ? fmt::format("{}x{}", p.maxWidth, p.maxHeight) : "any",
                            known ? name(p.blendUnit()) + (text ? further : "") : "-",
                            known ? name(p.gradeOf("blend_units")) : "-"});
    }
    std::string list = listing(rows, format);
    if (text)
        list +=
            "\nequations: sub, rev: source minus destination, destination minus source; wrap: sums keep "
            "their low "
            "bits;\nlogic: logic operations. textures: at a time, largest side. blend unit: the chip's own "
            "arithmetic "
            "(+1:\nanother one where sources disagree or nobody knows); evidence: what stands behind it.\n";
    return list;
}

std::string showProfile(const Profile& profile, Format format) {
    if (format == Format::Json) {
        Json facts = Json::array(), sources = Json::array();
        for (const auto& fact : profile.facts)
            facts.push_back({{"key", fact.key},
                             {"value", fact.value},
                             {"source", fact.source},
                             {"grade", name(fact.grade)}});
        for (const auto& s : profile.sources)
            sources.push_back({{"key", s.key}, {"grade", name(s.grade)}, {"document", s.document}});
        return Json::array({Json{{"profile", profile.id},
                                 {"title", profile.title},
                                 {"year", profile.year},
                                 {"facts", facts},
                                 {"sources", sources}}})
                   .dump(2) +
               "\n";
    }
    if (format == Format::Csv) {
        std::vector<std::vector<std::string>> rows{{"fact", "value", "source", "grade"}};
        for (const auto& fact : profile.facts)
            rows.push_back({fact.key, fact.value, fact.source, name(fact.grade)});
        return listing(rows, format);
    }
    std::string text = fmt::format("{}: {}\n\n", profile.id, profile.title);
    const auto line = [&](const std::string& key, const std::string& grade, const std::string& value) {
        text += fmt::format("{:<26}{:<10}{}\n", key, grade, wrapText(value, 36));
    };
    line("fact", "evidence", "value [source]");
    line(std::string(24, '-'), std::string(8, '-'), std::string(14, '-'));
    for (const auto& fact : profile.facts) {
        line(fact.key, name(fact.grade), fact.value);
        text += fmt::format("{:36}[{}]\n", "", wrapText(fact.source, 37));
    }
    text += "\nA capability that is not listed is absent.\n";
    if (profile.blendUnits.empty()) text += "Its blend arithmetic is not known: ideal rounding stands in.\n";
    if (!profile.sources.empty()) text += "\nSources\n";
    for (const auto& s : profile.sources)
        text += "  " + wrapText(fmt::format("{} [{}]: {}", s.key, name(s.grade), s.document), 4) + "\n";
    return text;
}

std::string listMethods(const std::vector<NamedMethod>& methods, Format format) {
    std::vector<std::vector<std::string>> rows{
        {"method", "store", "arithmetic", "count", "mask_scale", "apply", "source", "summary"}};
    for (const NamedMethod& m : methods) {
        const bool none = m.axes.store == Store::None || m.axes.store == Store::DepthMap;
        rows.push_back({m.id, name(m.axes.store), none ? "-" : name(m.axes.arithmetic),
                        none ? "-" : name(m.axes.count), none ? "-" : maskScaleName(m.axes.maskDivisor),
                        none ? "-" : name(m.axes.apply), m.source, m.summary});
    }
    return listing(rows, format);
}

std::string listAxisValues(Format format) {
    std::vector<std::vector<std::string>> rows{{"axis", "value", "source", "summary"}};
    for (const AxisValue& v : axisValues()) rows.push_back({v.axis, v.value, v.source, v.summary});
    return listing(rows, format);
}

std::string listScenes(const std::vector<Scene>& scenes, Format format) {
    if (format == Format::Json) return scenesJson(scenes);
    const bool text = format == Format::Text;
    std::vector<std::vector<std::string>> rows{
        {"scene", "objects", "triangles", "lights", "frames", "title"}};
    if (!text) rows[0].insert(rows[0].end(), {"family", "what"});
    std::vector<std::vector<std::string>> hard{{"hard case", "family", "what is hard"}};
    for (const Scene& s : scenes) {
        if (text && s.hard && scenes.size() > 1) {
            hard.push_back({s.id, s.hard->family, s.hard->what});
            continue;
        }
        rows.push_back({s.id, fmt::format("{}", s.objects.size()), fmt::format("{}", triangleCount(s)),
                        fmt::format("{}", s.lights.size()), fmt::format("{}", s.frames.size()), s.title});
        if (text) continue;
        rows.back().push_back(s.hard ? s.hard->family : "");
        rows.back().push_back(s.hard ? s.hard->what : "");
    }
    std::string list = rows.size() > 1 ? listing(rows, format) : "";
    if (hard.size() > 1) list += fmt::format("{}{}", list.empty() ? "" : "\n", listing(hard, format));
    if (text && scenes.size() == 1 && scenes.front().hard)
        list += fmt::format("\n{}", promisesOf(scenes.front()));
    return list;
}

std::string showPlans(const std::vector<PlanSheet>& sheets, Format format) {
    if (format == Format::Json) {
        Json all = Json::array();
        for (const PlanSheet& sheet : sheets) all.push_back(planJson(sheet));
        return all.dump(2) + "\n";
    }
    if (format == Format::Csv) {
        std::string text = csvLine(
            {"method", "shade", "profile", "scene", "frame", "pass", "draws", "what", "state", "chip_terms"});
        for (const PlanSheet& s : sheets)
            for (std::size_t i = 0; i < s.plan.passes.size(); ++i)
                text += csvLine({s.method, s.shade, s.profile, s.scene, fmt::format("{}", s.frame),
                                 fmt::format("{}", i + 1), kindName(s.plan.passes[i].kind),
                                 s.plan.passes[i].label, describeState(s.plan.passes[i], s.plan.windows),
                                 termsOf(s, i)});
        return text;
    }
    std::string text;
    for (const PlanSheet& sheet : sheets) text += planText(sheet) + "\n";
    return text;
}

}  // namespace gnomon
