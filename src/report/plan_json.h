#pragma once

#include <nlohmann/json.hpp>

#include "report/plan_notes.h"

namespace gnomon {

/// {"scene":2,"volume":4,"rectangle":3,"copy":0}
nlohmann::ordered_json toJson(const PassCounts& counts);

/// {"x":60,"y":40,"width":183,"height":122}; all 0 for an empty one.
nlohmann::ordered_json toJson(const WindowRect& rect);

/// {"clear":...,"scene":...,"volume":...,"rectangle":...,"copy":...,"total":...}
nlohmann::ordered_json toJson(const TouchedPixels& pixels);

/// {"effect":"near-caps","light":0,"drawn":false,"asked":false,"fact":"..."}; a note on the frame has light
/// null.
nlohmann::ordered_json toJson(const EffectNote& note);

/// What several notes say, in their order.
nlohmann::ordered_json toJson(const std::vector<EffectNote>& notes);

/// What bounds a pass: null, a rectangle, or a list of them for the volumes of one pass.
nlohmann::ordered_json extentJson(const Plan& plan, const Pass& pass);

}  // namespace gnomon
