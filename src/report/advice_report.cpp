#include "report/advice_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "matrix/cell_json.h"
#include "report/cost_notes.h"
#include "report/device_listing.h"
#include "report/gl_listing.h"
#include "report/listings.h"
#include "report/plan_json.h"
#include "report/table.h"
#include "report/verdict_colour.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

/// Causes with their pixels, most first.
std::vector<std::pair<std::string, int>> causesOf(const Cell& cell) {
    std::vector<std::pair<std::string, int>> causes(cell.causes.begin(), cell.causes.end());
    std::stable_sort(causes.begin(), causes.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    return causes;
}

std::string causesText(const Cell& cell) {
    std::vector<std::string> words;
    for (const auto& [cause, pixels] : causesOf(cell)) words.push_back(fmt::format("{} {}", cause, pixels));
    return fmt::format("{}", fmt::join(words, ", "));
}

std::string verdictText(const AdviceRow& row, bool colours) {
    const Verdict verdict = row.cell.verdict;
    const std::string wrong = fmt::format(" {}", row.wrong());
    switch (row.cell.verdict) {
        case Verdict::Exact:
            return inColour("exact", verdict, colours) + (row.proof.empty() ? "" : ", proved");
        case Verdict::Edge:
            return inColour("edge", verdict, colours) + wrong;
        case Verdict::Wrong:
            return inColour("WRONG", verdict, colours) + wrong;
        case Verdict::Refused:
            return inColour("refused", verdict, colours);
        case Verdict::Failed:
            return inColour("FAILED", verdict, colours);
    }
    return {};
}

/// The cause of most wrong pixels.
std::string whyOf(const AdviceRow& row) {
    const auto causes = causesOf(row.cell);
    if (causes.empty()) return "";
    const std::size_t others = causes.size() - 1;
    return others == 0
               ? causes[0].first
               : fmt::format("{} and {} more {}", causes[0].first, others, others == 1 ? "cause" : "causes");
}

/// The method that is drawn, if it is not the one that was asked for.
std::string drawnAs(const AdviceRow& row) {
    const std::string id = methodId(row.minimal.axes);
    return id == row.method ? "" : id;
}

bool isTimed(const AdviceRow& row) {
    return row.cost.ms() > 0;
}

/// "2.13 ms", or pixels where the chip has no rates.
std::string costOf(const AdviceRow& row) {
    return isTimed(row) ? fmt::format("{} ms", msText(row.cost.ms()))
                        : fmt::format("{} pixels", row.amount.pixels.total());
}

/// What @p cheaper would save: the model's time, or pixels where the chip has no rates.
std::string savedText(const AdviceRow& row, const AdviceRow& cheaper) {
    return isTimed(row) ? fmt::format("take {:.2f} ms less", row.cost.ms() - cheaper.cost.ms())
                        : fmt::format("touch {} pixels less",
                                      row.amount.pixels.total() - cheaper.amount.pixels.total());
}

std::string tableText(const Advice& advice, const Page& page) {
    const bool hasTimes = std::any_of(advice.rows.begin(), advice.rows.end(), isTimed);
    std::vector<std::vector<std::string>> rows{
        {"method", "verdict", "scene", "volume", "rectangle", "copy", "vertices", "touched", "of full"}};
    if (hasTimes) rows[0].insert(rows[0].end(), {"ms", "limit"});
    rows[0].push_back("why");
    for (std::size_t i = 0; i < advice.rows.size(); ++i) {
        const AdviceRow& row = advice.rows[i];
        if (!row.isDrawn()) continue;
        const PassCounts passes = countPasses(row.minimal.plan);
        const auto number = [](auto value) { return fmt::format("{}", value); };
        rows.push_back({fmt::format("{}{}", row.method, advice.chosen == i ? "*" : ""),
                        verdictText(row, page.colours), number(passes.scene), number(passes.volume),
                        number(passes.rectangle), number(passes.copy), number(row.amount.vertices),
                        number(row.amount.pixels.total()),
                        ratioText(row.amount.pixels.total(), row.fullAmount.pixels.total())});
        if (hasTimes)
            rows.back().insert(rows.back().end(), {msText(row.cost.ms()), limitText(row.cost.limit())});
        rows.back().push_back(whyOf(row));
    }
    return rows.size() > 1 ? fmt::format("{}\n", alignColumns(rows, page.width)) : "";
}

/// What the chip lacks for a method, or how the method failed.
std::string wantOf(const Cell& cell) {
    if (cell.verdict == Verdict::Failed) return cell.error;
    std::vector<std::string> lacks;
    for (const Missing& m : cell.missing) lacks.push_back(fmt::format("{} [{}]", m.what, m.source));
    return fmt::format("{}", fmt::join(lacks, "; "));
}

/// The methods of that verdict under a head; those of which the same is said share a line.
std::string undrawnText(const char* head, const Advice& advice, Verdict verdict, std::size_t width) {
    std::vector<std::pair<std::string, std::vector<std::string>>> wants;
    for (const AdviceRow& row : advice.rows) {
        if (row.cell.verdict != verdict) continue;
        const std::string want = wantOf(row.cell);
        const auto same =
            std::find_if(wants.begin(), wants.end(), [&](const auto& other) { return other.first == want; });
        if (same == wants.end())
            wants.push_back({want, {row.method}});
        else
            same->second.push_back(row.method);
    }
    std::string text;
    for (const auto& [want, methods] : wants)
        text +=
            fmt::format("  {}\n", wrapText(fmt::format("{}: {}", fmt::join(methods, ", "), want), 4, width));
    return text.empty() ? text : fmt::format("{}\n{}\n", head, text);
}

/// "902 of 76800 pixels wrong: parity of overlapping volumes 902".
std::string wrongText(const AdviceRow& row) {
    const std::string causes = causesText(row.cell);
    return fmt::format("{} of {} pixels wrong{}{}", row.wrong(), row.cell.pixels, causes.empty() ? "" : ": ",
                       causes);
}

std::string choiceText(const Advice& advice, std::size_t width) {
    std::string text;
    const auto line = [&](const std::string& words) {
        text += fmt::format("{}\n", wrapText(words, 0, width));
    };
    if (!advice.chosen) {
        const AdviceRow* best = advice.leastWrong();
        if (!best) {
            line(fmt::format("{} can draw none of these methods.", advice.profile));
            return text;
        }
        line(fmt::format("No method is exact on {} in this frame.", advice.profile));
        line(fmt::format("The least wrong is {}: {}.", best->method, wrongText(*best)));
        return text;
    }
    const AdviceRow& row = advice.rows[*advice.chosen];
    line(
        fmt::format("{} is the cheapest that is {}exact: it touches {} pixels, {} of what its full plan "
                    "does.",
                    row.method, row.proof.empty() ? "" : "proved ", row.amount.pixels.total(),
                    ratioText(row.amount.pixels.total(), row.fullAmount.pixels.total())));
    if (isTimed(row))
        line(fmt::format(
            "By a model of peak rates, not measured, that takes at least {} ms, limited by {} ({}).",
            msText(row.cost.ms()), limitText(row.cost.limit()), fmt::join(advice.rates, "; ")));
    for (const std::string& what : row.cost.missing) line(fmt::format("Left out: {}.", what));
    if (const std::string as = drawnAs(row); !as.empty()) line(fmt::format("It is drawn as {}.", as));
    line(row.proof.empty() ? "Nothing proves it: it was drawn and compared with truth."
                           : fmt::format("Proved: {}.", row.proof));
    std::vector<std::string> unproved;
    for (const AdviceRow* other : advice.cheaperUnproved())
        unproved.push_back(fmt::format("{} ({})", other->method, costOf(*other)));
    if (!unproved.empty())
        line(fmt::format("Cheaper and exact in this frame, though nothing proves it: {}.",
                         fmt::join(unproved, ", ")));
    const AdviceRow* cheaper = advice.nextCheaper();
    if (!cheaper && !unproved.empty()) {
        line("Nothing that is cheaper is wrong here.");
    } else if (!cheaper) {
        line(fmt::format("Nothing that {} can draw is cheaper.", advice.profile));
    } else {
        line(fmt::format("The next cheaper, {}, would {} and get {}.", cheaper->method,
                         savedText(row, *cheaper), wrongText(*cheaper)));
    }
    return text;
}

std::string adviceText(const Advice& advice, const Page& page) {
    std::string text = fmt::format("{} on {} at {}x{}, frame {}{}{}\n\n", advice.scene, advice.profile,
                                   advice.width, advice.height, advice.frame,
                                   advice.fidelity == "chip" ? ", with the chip's own arithmetic" : "",
                                   deviceText(advice.device));
    text += tableText(advice, page);
    text += undrawnText("Refused for want of", advice, Verdict::Refused, page.width);
    text += undrawnText("Failed", advice, Verdict::Failed, page.width);
    text += choiceText(advice, page.width);
    if (!advice.chosen) return text;
    const AdviceRow& row = advice.rows[*advice.chosen];
    text += effectsText(row.minimal.notes, page.width);
    text += fmt::format("\nIts passes as OpenGL calls\n\n{}",
                        glListing(row.minimal.plan, advice.profile, row.chipTerms));
    return text;
}

Json rowJson(const Advice& advice, std::size_t index) {
    const AdviceRow& row = advice.rows[index];
    Json json = toJson(row.cell);
    json["method"] = row.method;
    json["drawn_as"] = methodId(row.minimal.axes);
    json["chosen"] = advice.chosen == index;
    json["proof"] = row.proof;
    json["planned_passes"] = toJson(countPasses(row.minimal.plan));
    Json windows = Json::array();
    for (const MaskWindow& window : row.minimal.plan.windows) windows.push_back(toJson(window.all));
    json["windows"] = windows;
    json["drawn_vertices"] = row.amount.vertices;
    json["touched"] = toJson(row.amount.pixels);
    json["full"] = {{"drawn_vertices", row.fullAmount.vertices}, {"touched", toJson(row.fullAmount.pixels)}};
    json["model"] = row.cost.passes.empty() ? Json() : toJson(row.cost);
    json["effects"] = toJson(row.minimal.notes);
    return json;
}

Json shortJson(const AdviceRow* row) {
    if (!row) return {};
    Json causes = Json::object();
    for (const auto& [cause, pixels] : causesOf(row->cell)) causes[cause] = pixels;
    return {{"method", row->method},
            {"touched", row->amount.pixels.total()},
            {"wrong", row->wrong()},
            {"causes", causes}};
}

Json planJson(const AdviceRow& row) {
    const Plan& plan = row.minimal.plan;
    Json passes = Json::array();
    const std::vector<std::string> calls = glCalls(plan);
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        const Pass& pass = plan.passes[i];
        passes.push_back({{"kind", kindName(pass.kind)},
                          {"label", pass.label},
                          {"state", describeState(pass, row.minimal.plan.windows)},
                          {"chip_terms", i < row.chipTerms.size() ? row.chipTerms[i] : ""},
                          {"reason", reasonFor(plan, i, row.minimal.notes)},
                          {"scissor", extentJson(plan, pass)},
                          {"gl", calls[i]}});
    }
    return {{"beyond_opengl_1_1", beyondOpenGl11(plan)}, {"gl_setup", glSetup()}, {"passes", passes}};
}

Json adviceJson(const Advice& advice) {
    Json unproved = Json::array();
    for (const AdviceRow* row : advice.cheaperUnproved()) unproved.push_back(row->method);
    Json rows = Json::array();
    for (std::size_t i = 0; i < advice.rows.size(); ++i) rows.push_back(rowJson(advice, i));
    const AdviceRow* chosen = advice.chosen ? &advice.rows[*advice.chosen] : nullptr;
    return {{"profile", advice.profile},
            {"scene", advice.scene},
            {"width", advice.width},
            {"height", advice.height},
            {"frame", advice.frame},
            {"fidelity", advice.fidelity},
            {"rates", advice.rates},
            {"device", advice.device},
            {"chosen", chosen ? Json(chosen->method) : Json()},
            {"next_cheaper", shortJson(advice.nextCheaper())},
            {"cheaper_unproved", unproved},
            {"least_wrong", shortJson(advice.leastWrong())},
            {"methods", rows},
            {"plan", chosen ? planJson(*chosen) : Json()}};
}

std::string adviceCsv(const Advice& advice) {
    std::string text =
        csvLine({"profile",        "scene",         "width",         "height",           "frame",
                 "fidelity",       "device",        "method",        "drawn_as",         "chosen",
                 "verdict",        "proof",         "missing",       "causes",           "wrong_edge",
                 "wrong_interior", "passes_scene",  "passes_volume", "passes_rectangle", "passes_copy",
                 "vertices",       "touched_clear", "touched_scene", "touched_volume",   "touched_rectangle",
                 "touched_copy",   "touched",       "full_vertices", "full_touched",     "model_ms",
                 "model_limit"});
    for (std::size_t i = 0; i < advice.rows.size(); ++i) {
        const AdviceRow& row = advice.rows[i];
        const PassCounts passes = countPasses(row.minimal.plan);
        const TouchedPixels& p = row.amount.pixels;
        const auto number = [](auto value) { return fmt::format("{}", value); };
        std::vector<std::string> lacks, causes;
        for (const Missing& m : row.cell.missing) lacks.push_back(m.what);
        for (const auto& [cause, pixels] : causesOf(row.cell))
            causes.push_back(fmt::format("{} {}", cause, pixels));
        text += csvLine({advice.profile,
                         advice.scene,
                         number(advice.width),
                         number(advice.height),
                         number(advice.frame),
                         advice.fidelity,
                         advice.device,
                         row.method,
                         methodId(row.minimal.axes),
                         advice.chosen == i ? "true" : "false",
                         name(row.cell.verdict),
                         row.proof,
                         fmt::format("{}", fmt::join(lacks, "; ")),
                         fmt::format("{}", fmt::join(causes, "; ")),
                         number(row.cell.wrongEdge),
                         number(row.cell.wrongInterior),
                         number(passes.scene),
                         number(passes.volume),
                         number(passes.rectangle),
                         number(passes.copy),
                         number(row.amount.vertices),
                         number(p.clear),
                         number(p.scene),
                         number(p.volume),
                         number(p.rectangle),
                         number(p.copy),
                         number(p.total()),
                         number(row.fullAmount.vertices),
                         number(row.fullAmount.pixels.total()),
                         isTimed(row) ? number(row.cost.ms()) : "",
                         isTimed(row) ? limitText(row.cost.limit()) : ""});
    }
    return text;
}

}  // namespace

std::string showAdvice(const Advice& advice, const Page& page) {
    switch (page.format) {
        case Format::Json:
            return fmt::format("{}\n", Json::array({adviceJson(advice)}).dump(2));
        case Format::Csv:
            return adviceCsv(advice);
        case Format::Text:
            break;
    }
    return adviceText(advice, page);
}

}  // namespace gnomon
