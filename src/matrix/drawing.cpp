#include "matrix/drawing.h"

#include <algorithm>
#include <utility>

#include "volume/blockers.h"

namespace gnomon {
namespace {

LightFrame lightFrame(FrameScene& frame, const Profile& profile, const Drawing& drawing, int index) {
    if (frame.lights() == 0) return {};
    const Axes& axes = drawing.axes;
    const Plan& plan = drawing.plan;
    const auto draws = [&](auto predicate) {
        return std::any_of(plan.passes.begin(), plan.passes.end(), predicate);
    };
    LightFrame one{.colours = frame.coloursOf(index)};
    const Light& light = frame.light(index);
    if (draws([](const Pass& p) { return p.kind == PassKind::Volume && p.drawn == Drawn::Volumes; }))
        one.volumes = drawnVolumes(frame, profile, drawing, index);
    if (draws([](const Pass& p) { return p.drawn == Drawn::Blockers; }))
        one.blockers = eyeBlockers(frame.scene(), frame.litOf(index, axes.silhouette, axes.capFaces),
                                   light.position, frame.view().eye);
    if (draws([](const Pass& p) { return p.drawn == Drawn::Silhouettes; }))
        one.silhouettes = silhouetteMesh(frame.scene(), light.position, frame.view());
    if (draws([](const Pass& p) { return p.target == Target::DepthMap; }))
        one.depthMap = depthMapFrame(frame.scene(), light, frame.surfacesOf());
    return one;
}

}  // namespace

Drawing drawingOf(MinimalPlan plan) {
    return {.axes = plan.axes,
            .plan = std::move(plan.plan),
            .isFull = plan.isFull,
            .volumes = std::move(plan.volumes),
            .notes = std::move(plan.notes)};
}

std::shared_ptr<const FrameVolumes> drawnVolumes(FrameScene& frame, const Profile& profile,
                                                 const Drawing& drawing, int index) {
    const auto all = frame.volumesOf(index, frame.volumeKey(profile, drawing.axes, index));
    if (drawing.isFull) return all;
    return std::make_shared<const FrameVolumes>(only(*all, drawing.volumes[std::size_t(index)]));
}

LightFrames lightFrames(FrameScene& frame, const Profile& profile, const Drawing& drawing) {
    return [&frame, &profile, &drawing, last = -1,
            current = LightFrame{}](int index) mutable -> const LightFrame& {
        if (index != last) current = lightFrame(frame, profile, drawing, index);
        last = index;
        return current;
    };
}

std::vector<DrawnAmount> amountsOf(FrameScene& frame, const Profile& profile, const Drawing& drawing) {
    const auto frames = [&, last = -1, current = LightFrame{}](int index) mutable -> const LightFrame& {
        if (index != last) {
            current = lightFrame(frame, profile, drawing, index);
            if (drawing.axes.count == Count::AtomicZp && !current.volumes && frame.lights() > 0)
                current.volumes =
                    frame.volumesOf(index, {drawing.axes.silhouette, drawing.axes.capFaces,
                                            partsOf(Count::Zpass), cutStyleOf(drawing.axes, false)});
        }
        last = index;
        return current;
    };
    return drawnAmounts(drawing.plan, frame.surfacesOf(), frames);
}

}  // namespace gnomon
