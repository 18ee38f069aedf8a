#include "matrix/cell_json.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "matrix/digest.h"

namespace gnomon {
namespace {

/// The word of an enumeration whose values count from 0 to @p count - 1.
template <class Enum>
Enum wordOf(const std::string& word, int count) {
    for (int i = 0; i < count; ++i)
        if (name(Enum(i)) == word) return Enum(i);
    throw std::invalid_argument("no such word: " + word);
}

double rounded(double milliseconds) {
    return std::round(milliseconds * 1000) / 1000;
}

}  // namespace

nlohmann::ordered_json toJson(const Cell& c) {
    nlohmann::ordered_json missing = nlohmann::ordered_json::array();
    for (const Missing& m : c.missing)
        missing.push_back({{"capability", m.key}, {"what", m.what}, {"source", m.source}});
    nlohmann::ordered_json causes = nlohmann::ordered_json::object();
    for (const auto& [cause, pixels] : c.causes) causes[cause] = pixels;
    nlohmann::ordered_json json{
        {"cell", c.id()},
        {"profile", c.profile},
        {"method", c.method},
        {"scene", c.scene},
        {"store", name(c.axes.store)},
        {"arithmetic", name(c.axes.arithmetic)},
        {"levels", c.axes.levels},
        {"count", name(c.axes.count)},
        {"silhouette", name(c.axes.silhouette)},
        {"mask_scale", 1.0 / c.axes.maskDivisor},
        {"apply", name(c.axes.apply)},
        {"shade", name(c.axes.shade)},
        {"width", c.width},
        {"height", c.height},
        {"frame", c.frame},
        {"lights", c.lights},
        {"fidelity", c.fidelity},
        {"device", c.device},
        {"effects", toString(c.effects)},
        {"verdict", name(c.verdict)},
        {"chosen", c.chosen},
        {"missing", missing},
        {"causes", causes},
        {"passes",
         {{"scene", c.passes.scene},
          {"volume", c.passes.volume},
          {"rectangle", c.passes.rectangle},
          {"copy", c.passes.copy}}},
        {"touched",
         {{"clear", c.touched.clear},
          {"scene", c.touched.scene},
          {"volume", c.touched.volume},
          {"rectangle", c.touched.rectangle},
          {"copy", c.touched.copy}}},
        {"pixels", c.pixels},
        {"tied", {{"truth", c.tiedTruth}, {"count", c.tiedCount}}},
        {"wrong", {{"edge", c.wrongEdge}, {"interior", c.wrongInterior}}},
        {"unpredicted", c.unpredicted},
        {"nesting",
         {{"fronts", c.nesting.fronts}, {"overlap", c.nesting.overlap}, {"levels", c.nesting.levels}}},
        {"warnings", c.warnings},
        {"vertices", c.vertices},
        {"clock", c.clock},
        {"cpu_ms", rounded(c.cpuMs)},
        {"unshadowed_ms", rounded(c.unshadowedMs)},
        {"digest", c.digest},
    };
    // Options are there where they differ from what the method's row, the chip or the scene has.
    if (c.dithers) json["dither"] = "on";
    if (!c.blendUnit.empty()) json["blend_unit"] = c.blendUnit;
    if (!c.view.empty()) json["view"] = c.view;
    const Axes& a = c.axes;
    if (a.start != Start::Zero) json["start"] = name(a.start);
    if (a.overflow != Overflow::Either) json["overflow"] = name(a.overflow);
    if (a.capFaces != CapFaces::Lit) json["caps"] = name(a.capFaces);
    if (a.clip != Clip::Frustum) json["clip"] = name(a.clip);
    if (a.offset != 0) json["offset"] = a.offset;
    if (a.store == Store::DepthMap) {
        json["map_size"] = a.mapSize;
        json["map_bias"] = a.mapBias;
    }
    if (c.axes.maskDivisor == 1) json["mask_scale"] = 1;
    if (c.axes.arithmetic != Arithmetic::Double) json.erase("levels");
    if (!c.drawnBy.empty()) json["drawn_by"] = c.drawnBy, json["proof"] = name(c.proof);
    if (c.verdict == Verdict::Failed) json["error"] = c.error;
    return json;
}

nlohmann::ordered_json withoutTimes(const Cell& cell) {
    auto json = toJson(cell);
    for (const char* key : {"cpu_ms", "unshadowed_ms", "clock"}) json.erase(key);
    return json;
}

std::uint64_t contentDigest(const Cell& cell) {
    Digest digest;
    digest.add(withoutTimes(cell).dump());
    return digest.value();
}

Cell cellFromJson(const nlohmann::ordered_json& j) {
    Cell c;
    c.profile = j.at("profile"), c.method = j.at("method"), c.scene = j.at("scene");
    c.axes.store = wordOf<Store>(j.at("store"), kStores);
    c.axes.arithmetic = wordOf<Arithmetic>(j.at("arithmetic"), kArithmetics);
    c.axes.levels = j.value("levels", 0);
    c.axes.count = wordOf<Count>(j.at("count"), kCounts);
    c.axes.silhouette = wordOf<Silhouette>(j.at("silhouette"), kSilhouettes);
    c.axes.maskDivisor = int(std::lround(1 / double(j.at("mask_scale"))));
    c.axes.automatic = c.method == "auto" && !j.contains("drawn_by");
    c.axes.apply = wordOf<Apply>(j.at("apply"), 2);
    c.axes.shade = wordOf<Shade>(j.at("shade"), kShades);
    c.axes.start = wordOf<Start>(j.value("start", name(Start::Zero)), kStarts);
    c.axes.overflow = wordOf<Overflow>(j.value("overflow", name(Overflow::Either)), kOverflows);
    c.axes.capFaces = wordOf<CapFaces>(j.value("caps", name(CapFaces::Lit)), kCapFaces);
    c.axes.clip = wordOf<Clip>(j.value("clip", name(Clip::Frustum)), kClips);
    c.axes.offset = j.value("offset", 0.0f);
    c.axes.mapSize = j.value("map_size", 0);
    c.axes.mapBias = j.value("map_bias", 0.0f);
    c.lights = j.at("lights");
    c.width = j.at("width"), c.height = j.at("height"), c.frame = j.at("frame");
    c.fidelity = j.at("fidelity"), c.device = j.at("device"), c.clock = j.at("clock");
    c.effects = effectsFrom(j.at("effects")).value_or(Effects::all());
    c.dithers = j.value("dither", "off") == "on";
    c.blendUnit = j.value("blend_unit", "");
    if (j.contains("view")) c.view = j.at("view");
    c.drawnBy = j.value("drawn_by", "");
    c.proof = wordOf<Proof>(j.value("proof", name(Proof::Predicted)), kProofs);
    c.verdict = wordOf<Verdict>(j.at("verdict"), kVerdicts);
    c.chosen = j.at("chosen");
    for (const auto& m : j.at("missing"))
        c.missing.push_back({m.at("capability"), m.at("what"), m.at("source")});
    for (const auto& [cause, pixels] : j.at("causes").items()) c.causes[cause] = pixels;
    const auto& p = j.at("passes");
    c.passes = {p.at("scene"), p.at("volume"), p.at("rectangle"), p.at("copy")};
    const auto& t = j.at("touched");
    c.touched = {.clear = t.at("clear"),
                 .scene = t.at("scene"),
                 .volume = t.at("volume"),
                 .rectangle = t.at("rectangle"),
                 .copy = t.at("copy")};
    c.pixels = j.at("pixels");
    c.tiedTruth = j.at("tied").at("truth"), c.tiedCount = j.at("tied").at("count");
    c.wrongEdge = j.at("wrong").at("edge"), c.wrongInterior = j.at("wrong").at("interior");
    c.unpredicted = j.at("unpredicted");
    const auto& n = j.at("nesting");
    c.nesting = {.fronts = n.at("fronts"), .overlap = n.at("overlap"), .levels = n.at("levels")};
    c.warnings = j.at("warnings");
    c.vertices = j.at("vertices");
    c.cpuMs = j.at("cpu_ms"), c.unshadowedMs = j.at("unshadowed_ms");
    c.digest = j.at("digest");
    c.error = j.value("error", "");
    return c;
}

}  // namespace gnomon
