#include "report/listings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "report/plan_json.h"
#include "report/table.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

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

std::string counted(int number, const char* one, const char* many) {
    return fmt::format("{} {}", number, number == 1 ? one : many);
}

/// Of pass @p i, in the chip's own terms.
std::string termsOf(const PlanSheet& sheet, std::size_t i) {
    return i < sheet.chipTerms.size() ? sheet.chipTerms[i] : "";
}

/// The passes of a plan by what a text shows of them: volume passes beyond the first few are folded into one
/// line.
struct ShownPasses {
    std::vector<std::size_t> before{}, folded{}, after{};
};
ShownPasses shownPasses(const Plan& plan) {
    ShownPasses shown;
    std::size_t volumes = 0;
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        const bool folds = plan.passes[i].kind == PassKind::Volume && ++volumes > kShownVolumes;
        (folds ? shown.folded : shown.folded.empty() ? shown.before : shown.after).push_back(i);
    }
    return shown;
}

std::string foldedLabel(const ShownPasses& shown) {
    return fmt::format("{} more, front and back faces in turn", shown.folded.size());
}

std::string passTable(const PlanSheet& sheet, std::size_t width) {
    const ShownPasses shown = shownPasses(sheet.plan);
    std::vector<std::vector<std::string>> rows{{"pass", "draws", "what", "state"}};
    const auto add = [&](std::size_t i) {
        const Pass& pass = sheet.plan.passes[i];
        rows.push_back({fmt::format("{}", i + 1), kindName(pass.kind), pass.label,
                        describeState(pass, sheet.plan.windows)});
        if (const std::string terms = termsOf(sheet, i); !terms.empty())
            rows.push_back({"", "", "", fmt::format("{}: {}", sheet.profile, terms)});
    };
    for (const std::size_t i : shown.before) add(i);
    if (!shown.folded.empty()) rows.push_back({"...", "volume", foldedLabel(shown), ""});
    for (const std::size_t i : shown.after) add(i);
    return alignColumns(rows, width);
}

/// With state, chip's terms and reason beneath each pass.
std::string explainedTable(const PlanSheet& sheet, std::size_t width) {
    const ShownPasses shown = shownPasses(sheet.plan);
    const PlanNotes& notes = *sheet.notes;
    const CostNotes* cost = notes.cost && notes.cost->hasTimes() ? &*notes.cost : nullptr;
    std::vector<std::vector<std::string>> rows{{"pass", "draws", "touches"}};
    if (cost) rows[0].insert(rows[0].end(), {"ms", "limit"});
    rows[0].push_back("what");
    std::vector<std::string> beneath{"", ""};  // the head and its rule
    const auto add = [&](std::size_t i) {
        const Pass& pass = sheet.plan.passes[i];
        rows.push_back({fmt::format("{}", i + 1), kindName(pass.kind),
                        fmt::format("{}", notes.amounts[i].pixels.total())});
        if (cost) {
            const PassCost& took = cost->minimal.passes[i];
            rows.back().insert(rows.back().end(), {msText(took.ms()), limitText(took.limit())});
        }
        rows.back().push_back(pass.label);
        std::string& lines = beneath.emplace_back();
        const auto line = [&](const std::string& text) {
            lines += fmt::format("      {}\n", wrapText(text, 8, width));
        };
        line(describeState(pass, sheet.plan.windows));
        if (const std::string terms = termsOf(sheet, i); !terms.empty())
            line(fmt::format("{}: {}", sheet.profile, terms));
        line(fmt::format("why: {}", reasonFor(sheet.plan, i, notes.effects)));
    };
    for (const std::size_t i : shown.before) add(i);
    if (!shown.folded.empty()) {
        std::int64_t touched = 0;
        double ms = 0;
        for (const std::size_t i : shown.folded) {
            touched += notes.amounts[i].pixels.total();
            if (cost) ms += cost->minimal.passes[i].ms();
        }
        rows.push_back({"...", "volume", fmt::format("{}", touched)});
        if (cost) rows.back().insert(rows.back().end(), {msText(ms), ""});
        rows.back().push_back(foldedLabel(shown));
        beneath.emplace_back();
    }
    for (const std::size_t i : shown.after) add(i);
    // A line each, whatever the width: what is beneath belongs to its row.
    std::istringstream table(alignColumns(rows, std::string::npos));
    std::string text, line;
    for (const std::string& lines : beneath) {
        std::getline(table, line);
        text += fmt::format("{}\n{}", line, lines);
    }
    return text;
}

std::string planText(const PlanSheet& sheet, std::size_t width) {
    const Plan& plan = sheet.plan;
    std::string text = fmt::format("{} ({}) on {}: {} at {}x{}, frame {}\n\n", sheet.method, sheet.shade,
                                   sheet.profile, sheet.scene, plan.width, plan.height, sheet.frame);
    text += sheet.notes ? explainedTable(sheet, width) : passTable(sheet, width);
    const PassCounts counts = countPasses(plan);
    text += fmt::format("\n{}, {}, {}, {}\n", counted(counts.scene, "scene pass", "scene passes"),
                        counted(counts.volume, "volume pass", "volume passes"),
                        counted(counts.rectangle, "rectangle", "rectangles"),
                        counted(counts.copy, "copy", "copies"));
    if (sheet.notes) text += notesText(plan, *sheet.notes, width);
    for (const Missing& m : sheet.missing)
        text += wrapText(fmt::format("refused: the chip lacks {} [{}]", m.what, m.source), 9, width) + "\n";
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
        if (!sheet.notes) continue;
        passes.back()["reason"] = reasonFor(sheet.plan, i, sheet.notes->effects);
        passes.back()["scissor"] = extentJson(sheet.plan, pass);
        passes.back()["vertices"] = sheet.notes->amounts[i].vertices;
        passes.back()["touched"] = sheet.notes->amounts[i].pixels.total();
        if (sheet.notes->cost) passes.back()["model"] = toJson(sheet.notes->cost->minimal.passes[i]);
    }
    Json lacks = Json::array();
    for (const Missing& m : sheet.missing)
        lacks.push_back({{"capability", m.key}, {"what", m.what}, {"source", m.source}});
    Json json{{"method", sheet.method}, {"shade", sheet.shade},      {"profile", sheet.profile},
              {"scene", sheet.scene},   {"width", sheet.plan.width}, {"height", sheet.plan.height},
              {"frame", sheet.frame},   {"passes", passes},          {"counts", toJson(counts)},
              {"missing", lacks}};
    if (!sheet.notes) return json;
    const DrawnAmount amount = sumOf(sheet.notes->amounts), &full = sheet.notes->fullAmount;
    json["drawn_as"] = sheet.notes->drawnAs.empty() ? sheet.method : sheet.notes->drawnAs;
    json["effects"] = toJson(sheet.notes->effects);
    json["vertices"] = amount.vertices;
    json["touched"] = toJson(amount.pixels);
    json["full"] = {{"counts", toJson(countPasses(sheet.notes->full))},
                    {"vertices", full.vertices},
                    {"touched", toJson(full.pixels)}};
    if (sheet.notes->cost) json["model"] = toJson(*sheet.notes->cost);
    return json;
}

/// A line per pass; with notes, a line per effect follows them.
std::string plansCsv(const std::vector<PlanSheet>& sheets) {
    const bool explains =
        std::any_of(sheets.begin(), sheets.end(), [](const PlanSheet& s) { return s.notes; });
    std::vector<std::string> head{"method", "shade", "profile", "scene", "frame",
                                  "pass",   "draws", "what",    "state", "chip_terms"};
    if (explains) head.insert(head.end(), {"reason", "vertices", "touched", "model_ms", "model_limit"});
    std::string text = csvLine(head);
    for (const PlanSheet& s : sheets) {
        const std::vector<std::string> of{s.method, s.shade, s.profile, s.scene, fmt::format("{}", s.frame)};
        const auto line = [&](const std::vector<std::string>& rest) {
            std::vector<std::string> fields = of;
            fields.insert(fields.end(), rest.begin(), rest.end());
            fields.resize(head.size());
            text += csvLine(fields);
        };
        for (std::size_t i = 0; i < s.plan.passes.size(); ++i) {
            const Pass& pass = s.plan.passes[i];
            std::vector<std::string> fields{fmt::format("{}", i + 1), kindName(pass.kind), pass.label,
                                            describeState(pass, s.plan.windows), termsOf(s, i)};
            if (s.notes)
                fields.insert(fields.end(), {reasonFor(s.plan, i, s.notes->effects),
                                             fmt::format("{}", s.notes->amounts[i].vertices),
                                             fmt::format("{}", s.notes->amounts[i].pixels.total())});
            if (s.notes && s.notes->cost) {
                const PassCost& took = s.notes->cost->minimal.passes[i];
                fields.insert(fields.end(), {fmt::format("{}", took.ms()), limitText(took.limit())});
            }
            line(fields);
        }
        if (!s.notes) continue;
        for (const EffectNote& note : s.notes->effects)
            line({"",
                  !note.isDrawn  ? "left out"
                  : note.isAsked ? "asked for"
                                 : "called for",
                  note.light < 0 ? name(note.effect)
                                 : fmt::format("{} of light {}", name(note.effect), note.light),
                  "", "", note.fact});
    }
    return text;
}

/// What a hard case is about, and what must come of it as commands that show it.
std::string promisesOf(const Scene& scene, std::size_t width) {
    const HardCase& hard = *scene.hard;
    std::string text = fmt::format("family: {}\nwhat:   {}\nsource: {}\n", hard.family,
                                   wrapText(hard.what, 8, width), wrapText(hard.source, 8, width));
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

std::string listing(const std::vector<std::vector<std::string>>& rows, const Page& page) {
    if (page.format == Format::Text) return alignColumns(rows, page.width);
    if (page.format == Format::Csv) {
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

std::string listProfiles(const std::vector<Profile>& profiles, const Page& page) {
    const bool text = page.format == Format::Text;
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
    std::string list = listing(rows, page);
    if (text)
        list += fmt::format(
            "\n{}\n",
            wrapText(
                "equations: sub, rev: source minus destination, destination minus source; wrap: sums keep "
                "their low bits; logic: logic operations. textures: at a time, largest side. blend unit: "
                "the chip's own arithmetic (+1: another one where sources disagree or nobody knows); "
                "evidence: what stands behind it.",
                0, page.width));
    return list;
}

std::string showProfile(const Profile& profile, const Page& page) {
    if (page.format == Format::Json) {
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
    if (page.format == Format::Csv) {
        std::vector<std::vector<std::string>> rows{{"fact", "value", "source", "grade"}};
        for (const auto& fact : profile.facts)
            rows.push_back({fact.key, fact.value, fact.source, name(fact.grade)});
        return listing(rows, page);
    }
    std::string text = fmt::format("{}: {}\n\n", profile.id, profile.title);
    const auto line = [&](const std::string& key, const std::string& grade, const std::string& value) {
        text += fmt::format("{:<26}{:<10}{}\n", key, grade, wrapText(value, 36, page.width));
    };
    line("fact", "evidence", "value [source]");
    line(std::string(24, '-'), std::string(8, '-'), std::string(14, '-'));
    for (const auto& fact : profile.facts) {
        line(fact.key, name(fact.grade), fact.value);
        text += fmt::format("{:36}[{}]\n", "", wrapText(fact.source, 37, page.width - 1));
    }
    text += "\nA capability that is not listed is absent.\n";
    if (profile.blendUnits.empty()) text += "Its blend arithmetic is not known: ideal rounding stands in.\n";
    if (!profile.sources.empty()) text += "\nSources\n";
    for (const auto& s : profile.sources)
        text += "  " + wrapText(fmt::format("{} [{}]: {}", s.key, name(s.grade), s.document), 4, page.width) +
                "\n";
    return text;
}

std::string listMethods(const std::vector<NamedMethod>& methods, const Page& page) {
    std::vector<std::vector<std::string>> rows{
        {"method", "store", "arithmetic", "count", "mask_scale", "apply", "source", "summary"}};
    for (const NamedMethod& m : methods) {
        const bool none = m.axes.store == Store::None || m.axes.store == Store::DepthMap || m.axes.automatic;
        rows.push_back({m.id, m.axes.automatic ? "-" : name(m.axes.store),
                        none ? "-" : name(m.axes.arithmetic), none ? "-" : name(m.axes.count),
                        none ? "-" : maskScaleName(m.axes.maskDivisor), none ? "-" : name(m.axes.apply),
                        m.source, m.summary});
    }
    return listing(rows, page);
}

std::string listAxisValues(const Page& page) {
    std::vector<std::vector<std::string>> rows{{"axis", "value", "source", "summary"}};
    for (const AxisValue& v : axisValues()) rows.push_back({v.axis, v.value, v.source, v.summary});
    return listing(rows, page);
}

std::string listScenes(const std::vector<Scene>& scenes, const Page& page) {
    if (page.format == Format::Json) return scenesJson(scenes);
    const bool text = page.format == Format::Text;
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
    std::string list = rows.size() > 1 ? listing(rows, page) : "";
    if (hard.size() > 1) list += fmt::format("{}{}", list.empty() ? "" : "\n", listing(hard, page));
    if (text && scenes.size() == 1 && scenes.front().hard)
        list += fmt::format("\n{}", promisesOf(scenes.front(), page.width));
    return list;
}

std::string showPlans(const std::vector<PlanSheet>& sheets, const Page& page) {
    if (page.format == Format::Json) {
        Json all = Json::array();
        for (const PlanSheet& sheet : sheets) all.push_back(planJson(sheet));
        return all.dump(2) + "\n";
    }
    if (page.format == Format::Csv) return plansCsv(sheets);
    std::string text;
    for (const PlanSheet& sheet : sheets) text += planText(sheet, page.width) + "\n";
    return text;
}

}  // namespace gnomon
