#include "report/reproduce_roettger2002.h"

#include <fmt/format.h>

#include <cassert>

#include "report/table.h"

namespace gnomon {

bool Comparison::agrees() const {
    return counted == planned && counted.scene == publishedScene && counted.rectangle == publishedRectangles;
}

std::vector<Comparison> roettgerTable1() {
    std::vector<Comparison> rows;
    const auto add = [&](Store store, Shade shade, bool maximum, int scene, int rectangles) {
        Axes axes = findMethod(store == Store::Alpha ? (maximum ? "roettger-alpha-max" : "roettger-alpha")
                                                     : (maximum ? "roettger-screen-max" : "roettger-screen"))
                        ->axes;
        axes.shade = shade;
        rows.push_back({name(store), name(shade), maximum, scene, rectangles, axes, {}, {}});
    };
    add(Store::Alpha, Shade::Black, false, 1, 4);
    add(Store::Alpha, Shade::Ambient, false, 2, 4);
    add(Store::Alpha, Shade::Attenuated, false, 1, 4);
    add(Store::Alpha, Shade::Attenuated, true, 1, 2);
    add(Store::Screen, Shade::Black, false, 2, 3);
    add(Store::Screen, Shade::Ambient, false, 3, 3);
    add(Store::Screen, Shade::Attenuated, false, 2, 3);
    add(Store::Screen, Shade::Attenuated, true, 2, 1);
    return rows;
}

nlohmann::ordered_json comparisonsJson(const std::vector<Comparison>& rows) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    const auto pair = [](int scene, int rectangles) {
        return nlohmann::ordered_json{{"scene", scene}, {"rectangle", rectangles}};
    };
    for (const Comparison& r : rows)
        all.push_back({{"buffer", r.buffer},
                       {"shade", r.shade},
                       {"maximum", r.maximum},
                       {"method", methodId(r.axes)},
                       {"published", pair(r.publishedScene, r.publishedRectangles)},
                       {"counted", pair(r.counted.scene, r.counted.rectangle)},
                       {"planned", pair(r.planned.scene, r.planned.rectangle)},
                       {"agrees", r.agrees()}});
    return all;
}

std::string showRoettger2002(const std::optional<std::vector<Comparison>>& table1,
                             const std::optional<Table2>& table2, const Page& page) {
    if (page.format == Format::Json) {
        nlohmann::ordered_json all = comparisonsJson(table1.value_or(std::vector<Comparison>{}));
        if (table2) all.push_back(table2Json(*table2));
        return all.dump(2) + "\n";
    }
    assert(page.format == Format::Text || !table1 || !table2);
    std::string text = table1 ? showComparisons(*table1, page) : "";
    if (table1 && table2) text += "\n";
    if (table2) text += page.format == Format::Csv ? table2Csv(*table2) : table2Text(*table2, page.width);
    return text;
}

static std::string comparisonsCsv(const std::vector<Comparison>& rows) {
    std::string text =
        csvLine({"buffer", "shade", "blend_equation", "method", "published_scene", "published_rectangle",
                 "counted_scene", "counted_rectangle", "plan_scene", "plan_rectangle", "agrees"});
    for (const Comparison& r : rows) {
        std::vector<std::string> fields{r.buffer, r.shade, r.maximum ? "maximum" : "add", methodId(r.axes)};
        for (const int passes : {r.publishedScene, r.publishedRectangles, r.counted.scene,
                                 r.counted.rectangle, r.planned.scene, r.planned.rectangle})
            fields.push_back(fmt::format("{}", passes));
        fields.push_back(r.agrees() ? "1" : "0");
        text += csvLine(fields);
    }
    return text;
}

std::string showComparisons(const std::vector<Comparison>& rows, const Page& page) {
    if (page.format == Format::Json) return comparisonsJson(rows).dump(2) + "\n";
    if (page.format == Format::Csv) return comparisonsCsv(rows);
    std::vector<std::vector<std::string>> table{
        {"buffer", "shade", "blend equation", "method", "published", "counted", "plan", ""}};
    for (const Comparison& r : rows)
        table.push_back({r.buffer, r.shade, r.maximum ? "maximum" : "add", methodId(r.axes),
                         fmt::format("{}/{}", r.publishedScene, r.publishedRectangles),
                         fmt::format("{}/{}", r.counted.scene, r.counted.rectangle),
                         fmt::format("{}/{}", r.planned.scene, r.planned.rectangle),
                         r.agrees() ? "agrees" : "DIFFERS"});
    return "Roettger, Irion, Ertl 2002, Table 1: scene passes / rectangles over the window\n\n" +
           alignColumns(table, page.width);
}

}  // namespace gnomon
