// Table 2 and its fits for people and programs.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>

#include "report/reproduce_roettger2002_table2.h"
#include "report/table.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

struct Variant {
    const char* id;
    FreeNumbers numbers;
    bool takesTurns;
};
constexpr std::array<Variant, 5> kVariants{{{"A", FreeNumbers::Volumes, true},
                                            {"B", FreeNumbers::Volumes, false},
                                            {"C", FreeNumbers::AndHost, true},
                                            {"D", FreeNumbers::AndHost, false},
                                            {"E", FreeNumbers::AndScene, false}}};

struct Fitted {
    Variant variant{};
    Table2Fit fit{};
    std::vector<OrderLine> orders{};
};

std::vector<Fitted> fittedOf(const std::vector<Table2Cell>& cells) {
    std::vector<Fitted> all;
    for (const Variant& variant : kVariants) {
        Table2Fit fit = fitTable2(cells, variant.numbers, variant.takesTurns);
        std::vector<OrderLine> orders = orderLines(cells, fit.unknowns);
        all.push_back({variant, std::move(fit), std::move(orders)});
    }
    return all;
}

int freeNumbers(const Variant& variant) {
    return int(variant.numbers) + 1;
}

/// How much longer the model's frame takes: "+3 %", "0 %".
std::string percent(double residual) {
    const auto whole = std::lround((std::exp(residual) - 1) * 100);
    return whole == 0 ? "0 %" : fmt::format("{:+} %", whole);
}

double modelFps(const Table2Cell& cell, const Table2Fit& fit) {
    return 1000 / modelMs(cell, fit.unknowns);
}

std::string fitsText(const std::vector<Table2Cell>& cells, const std::vector<Fitted>& all,
                     std::size_t width) {
    std::vector<std::vector<std::string>> rows{{"fit", "host and chip", "free numbers", "volume fragments",
                                                "host for shadows", "host per further scene", "rms",
                                                "worst"}};
    for (const auto& [variant, fit, orders] : all) {
        const Unknowns& u = fit.unknowns;
        const auto ms = [](bool isFree, double value) {
            return isFree ? fmt::format("{:.1f} ms", value) : std::string("-");
        };
        const Table2Cell& worst = cells[fit.worst];
        rows.push_back({variant.id, variant.takesTurns ? "in turn" : "side by side",
                        fmt::format("{}", freeNumbers(variant)), fmt::format("{:.1f} x ours", u.volumes),
                        ms(variant.numbers != FreeNumbers::Volumes, u.hostVolumesMs),
                        ms(variant.numbers == FreeNumbers::AndScene, u.hostSceneMs),
                        fmt::format("{:.0f} %", (std::exp(fit.rms) - 1) * 100),
                        fmt::format("{} ({} at {})", percent(fit.residuals[fit.worst]), name(worst.column),
                                    worst.size)});
    }
    return alignColumns(rows, width);
}

std::string cellsText(const Table2& table, const std::vector<Fitted>& all, std::size_t width) {
    std::vector<std::vector<std::string>> rows{{"window", "column", "method", "published"}};
    for (const Fitted& one : all) rows[0].push_back(one.variant.id);
    if (!table.measured.empty()) rows[0].push_back("this machine");
    for (std::size_t i = 0; i < table.cells.size(); ++i) {
        const Table2Cell& cell = table.cells[i];
        rows.push_back({fmt::format("{0}x{0}", cell.size), name(cell.column), cell.method,
                        fmt::format("{:.1f}", cell.published)});
        for (const Fitted& one : all)
            rows.back().push_back(
                fmt::format("{:.1f} ({})", modelFps(cell, one.fit), percent(one.fit.residuals[i])));
        if (!table.measured.empty()) rows.back().push_back(fmt::format("{:.2f}", table.measured[i]));
    }
    return alignColumns(rows, width, 3);
}

std::string claimOf(const OrderLine& line) {
    return fmt::format("{}x{}: {} {} {}", line.size, line.size, name(line.slower),
                       line.mayBeEqual ? "<=" : "<", name(line.faster));
}

std::string verdictOf(const OrderLine& line) {
    return line.isAsPublished() ? "as published" : "NOT as published";
}

std::string ordersText(const std::vector<Fitted>& all, std::size_t width) {
    std::vector<std::vector<std::string>> rows{{"frame rates"}};
    for (const Fitted& one : all) rows[0].push_back(one.variant.id);
    for (std::size_t i = 0; i < all[0].orders.size(); ++i) {
        rows.push_back({claimOf(all[0].orders[i])});
        for (const Fitted& one : all) rows.back().push_back(verdictOf(one.orders[i]));
    }
    return alignColumns(rows, width);
}

/// Why, by the first fit, and by the last where it says otherwise.
std::string reasonsText(const std::vector<Fitted>& all, std::size_t width) {
    std::string text;
    const auto line = [&](const Fitted& one, const OrderLine& order) {
        text += fmt::format("  {}\n", wrapText(fmt::format("{}: {} {}: {}", one.variant.id, claimOf(order),
                                                           verdictOf(order), order.reason),
                                               4, width));
    };
    for (std::size_t i = 0; i < all[0].orders.size(); ++i) {
        const OrderLine &first = all.front().orders[i], &last = all.back().orders[i];
        line(all.front(), first);
        if (first.isAsPublished() != last.isAsPublished()) line(all.back(), last);
    }
    return text;
}

/// What the figures stand on, and what they can't tell.
std::vector<std::string> remarks(const Table2& table, const std::vector<Fitted>& all) {
    const Unknowns &turns = all.front().fit.unknowns, &beside = all.back().fit.unknowns;
    const double stencil = stencilFactor(table.cells, beside);
    std::vector<std::string> lines{
        fmt::format("The model: a pass takes the largest of its times at peak rates ({}); passes follow one "
                    "another.",
                    fmt::join(table.rates, "; ")),
        fmt::format(
            "Free: how many times as many fragments the paper's volumes have as ours; then the host's "
            "milliseconds for shadows, and for each further pass of the scene. Fitted by least squares "
            "of the logarithms of the {} times with shadows.",
            table.cells.size() - 3),
        fmt::format(
            "Taken from the column without shadows, not fitted: the host's work (in turn {:.1f} ms, side "
            "by side {:.1f} ms) and the scene's fragments ({:.1f} and {:.1f} times ours). That it has "
            "one rate at 256x256 and at 512x512 speaks for side by side.",
            turns.hostMs, beside.hostMs, turns.scene, beside.scene),
        "Comparable: the order of the columns, and how their times grow with the window. The methods, their "
        "passes and states are the paper's.",
        "Not comparable: the scene of the paper's Figure 6, which is not published (ours is two casters over "
        "a "
        "floor), the host, and the depths of the buffers: 32 bits are taken for colour and for depth with "
        "stencil, as destination alpha and the stencil need them.",
        fmt::format(
            "For the published stencil column at 1024x1024 its volumes would have to take {:.2f} times as "
            "long (fit E): by bytes and fill alone they take as long as alpha's, and three rectangles "
            "less are drawn. Nothing in the profile accounts for it.",
            stencil)};
    if (!table.measured.empty())
        lines.push_back(
            "This machine: time of frame 0, over that of the frame without shadows in the same "
            "round, median of 5. It is not the chip's.");
    return lines;
}

}  // namespace

std::string table2Text(const Table2& table, std::size_t width) {
    const std::vector<Fitted> all = fittedOf(table.cells);
    std::string text =
        "Roettger, Irion, Ertl 2002, Table 2: frames per second on a GeForce 2 MX, published and "
        "by the model\n\n";
    text += fitsText(table.cells, all, width);
    text += fmt::format("\n{}", cellsText(table, all, width));
    text += "\nIn brackets: how much longer the model's frame takes.\n";
    text += fmt::format("\n{}", ordersText(all, width));
    text += "\nWhy: milliseconds that the slower column takes more on the chip, by the terms of the model\n";
    text += fmt::format("{}\n", reasonsText(all, width));
    for (const std::string& line : remarks(table, all)) text += fmt::format("{}\n", wrapText(line, 2, width));
    return text;
}

std::string table2Csv(const Table2& table) {
    const std::vector<Fitted> all = fittedOf(table.cells);
    std::vector<std::string> head{"window", "column", "method", "published_fps", "this_machine_ratio"};
    for (const Fitted& one : all)
        for (const char* what : {"fps", "ln_time_ratio"})
            head.push_back(fmt::format("{}_{}", one.variant.id, what));
    std::string text = csvLine(head);
    for (std::size_t i = 0; i < table.cells.size(); ++i) {
        const Table2Cell& cell = table.cells[i];
        std::vector<std::string> fields{fmt::format("{}", cell.size), name(cell.column), cell.method,
                                        fmt::format("{}", cell.published),
                                        table.measured.empty() ? "" : fmt::format("{}", table.measured[i])};
        for (const Fitted& one : all)
            fields.insert(fields.end(), {fmt::format("{}", modelFps(cell, one.fit)),
                                         fmt::format("{}", one.fit.residuals[i])});
        text += csvLine(fields);
    }
    return text;
}

Json table2Json(const Table2& table) {
    const std::vector<Fitted> all = fittedOf(table.cells);
    Json cells = Json::array(), fits = Json::array();
    for (std::size_t i = 0; i < table.cells.size(); ++i) {
        const Table2Cell& cell = table.cells[i];
        cells.push_back({{"window", cell.size},
                         {"column", name(cell.column)},
                         {"method", cell.method},
                         {"published_fps", cell.published},
                         {"this_machine_ratio", table.measured.empty() ? Json() : Json(table.measured[i])}});
    }
    for (const auto& [variant, fit, orders] : all) {
        Json rates = Json::array(), lines = Json::array();
        for (const Table2Cell& cell : table.cells) rates.push_back(modelFps(cell, fit));
        for (const OrderLine& line : orders)
            lines.push_back({{"window", line.size},
                             {"faster", name(line.faster)},
                             {"slower", name(line.slower)},
                             {"may_be_equal", line.mayBeEqual},
                             {"faster_ms", line.fasterMs},
                             {"slower_ms", line.slowerMs},
                             {"as_published", line.isAsPublished()},
                             {"reason", line.reason}});
        fits.push_back({{"fit", variant.id},
                        {"takes_turns", variant.takesTurns},
                        {"free_numbers", freeNumbers(variant)},
                        {"volume_fragments", fit.unknowns.volumes},
                        {"scene_fragments", fit.unknowns.scene},
                        {"host_ms", fit.unknowns.hostMs},
                        {"host_shadows_ms", fit.unknowns.hostVolumesMs},
                        {"host_further_scene_ms", fit.unknowns.hostSceneMs},
                        {"rms_ln_time", fit.rms},
                        {"fps", rates},
                        {"ln_time_ratios", fit.residuals},
                        {"orders", lines}});
    }
    return {{"table", 2}, {"cells", cells}, {"fits", fits}, {"remarks", remarks(table, all)}};
}

}  // namespace gnomon
