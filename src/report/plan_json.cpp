#include "report/plan_json.h"

namespace gnomon {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json toJson(const PassCounts& counts) {
    return {{"scene", counts.scene},
            {"volume", counts.volume},
            {"rectangle", counts.rectangle},
            {"copy", counts.copy}};
}

Json toJson(const WindowRect& rect) {
    const WindowRect r = rect.empty() ? WindowRect{} : rect;
    return {{"x", r.x}, {"y", r.y}, {"width", r.width}, {"height", r.height}};
}

Json toJson(const TouchedPixels& pixels) {
    return {{"clear", pixels.clear},         {"scene", pixels.scene}, {"volume", pixels.volume},
            {"rectangle", pixels.rectangle}, {"copy", pixels.copy},   {"total", pixels.total()}};
}

Json toJson(const EffectNote& note) {
    return {{"effect", name(note.effect)},
            {"light", note.light < 0 ? Json() : Json(note.light)},
            {"drawn", note.isDrawn},
            {"asked", note.isAsked},
            {"fact", note.fact}};
}

Json toJson(const std::vector<EffectNote>& notes) {
    Json all = Json::array();
    for (const EffectNote& note : notes) all.push_back(toJson(note));
    return all;
}

Json extentJson(const Plan& plan, const Pass& pass) {
    if (pass.extent == Extent::Whole || std::size_t(pass.light) >= plan.windows.size()) return {};
    const MaskWindow& window = plan.windows[std::size_t(pass.light)];
    if (pass.extent == Extent::Shadows) return toJson(window.all);
    if (pass.volume != kAllVolumes) return toJson(window.volumes[std::size_t(pass.volume)]);
    Json all = Json::array();
    for (const WindowRect& rect : window.volumes) all.push_back(toJson(rect));
    return all;
}

}  // namespace gnomon
