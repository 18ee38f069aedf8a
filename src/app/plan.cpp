#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "app/commands.h"
#include "app/options.h"
#include "app/path.h"
#include "app/show.h"
#include "image/scale.h"
#include "matrix/choice.h"
#include "plan/chip_terms.h"
#include "report/listings.h"

namespace gnomon {
namespace {

struct PlanOptions {
    ProfileOption profiles{};
    SceneOption scenes{};
    MethodOption methods{};
    SizeOption sizes{};
    EffectsOption effects{};
    FormatOption format{};
    ShowOption show{};
    DeviceOption device{};
    int frame = 0;
    double hostMs = 0;
    bool explain = false;
};

/// What is to be listed of one method.
PlanSheet sheetOf(Lab& lab, const Profile& profile, const Size& size, const PlanOptions& options,
                  const Axes& asked) {
    const auto [width, height] = size;
    const int frame = options.frame;
    const Axes axes = chosenAxes(lab, profile, asked, width, height, frame);
    PlanSheet sheet{.method = methodId(asked),
                    .shade = name(asked.shade),
                    .profile = profile.id,
                    .scene = lab.scene().id,
                    .frame = frame};
    sheet.plan = lab.plan(profile, axes, width, height, frame);
    sheet.missing = lab.missingFor(profile, axes, sheet.plan);
    const bool isDerived = options.explain || asked.automatic || options.effects.value();
    if (isDerived && sheet.missing.empty()) {
        MinimalPlan least = lab.minimalPlan(profile, axes, width, height, frame);
        if (options.explain) {
            const std::string drawnAs = methodId(least.axes);
            sheet.notes = {
                .effects = least.notes,
                .amounts = lab.amounts(profile, least, width, height, frame),
                .full = sheet.plan,
                .fullAmount = sumOf(lab.fullAmounts(profile, axes, width, height, frame)),
                .cost = CostNotes{lab.cost(profile, least, width, height, frame, options.hostMs),
                                  lab.fullCost(profile, axes, width, height, frame, options.hostMs),
                                  modelRates(profile)},
                .drawnAs = drawnAs == sheet.method ? "" : drawnAs};
        }
        sheet.plan = std::move(least.plan);
    }
    for (const Pass& pass : sheet.plan.passes)
        sheet.chipTerms.push_back(chipTerms(pass, profile, sheet.plan));
    return sheet;
}

/// The frame as it is drawn by @p axes, and the mask beside it; nothing where the chip can't draw it.
std::string pictureText(Lab& lab, const Profile& profile, const Axes& axes, const Size& size,
                        const PlanOptions& options) {
    Pictures pictures;
    const Cell cell = lab.run(profile, axes, size.width, size.height, options.frame, &pictures);
    if (cell.verdict == Verdict::Failed)
        throw std::runtime_error(fmt::format("{}: {}", cell.id(), cell.error));
    if (cell.verdict == Verdict::Refused) return {};
    constexpr int kGap = 8;  // pixels
    return options.show.text(beside(pictures.image, pictures.mask, kGap)) + "\n";
}

int run(const PlanOptions& options) {
    const Page page = options.format.value();
    options.show.check(page);
    const std::optional<Effects> effects = options.effects.value();
    const Profile profile = theOnly("--profile", options.profiles.load({"ideal"}));
    if (options.hostMs > 0 && !options.explain)
        throw UsageError("--host-ms: the cost is part of what --explain says");
    const Size size = theOnly("--size", options.sizes.value());
    Lab lab(theOnly("--scene", options.scenes.load({"roettger"})));
    lab.drawOn(options.device.value());
    checkFrame("--frame", options.frame, lab.scene());

    std::vector<Axes> methods;
    if (options.methods.isEmpty()) {
        std::string words;
        for (const Shade shade : options.methods.shadeList())
            if (const auto axes =
                    choosePath(lab, profile, shade, size.width, size.height, options.frame, words))
                methods.push_back(*axes);
        if (page.format == Format::Text) fmt::print("{}\n", words);
    } else {
        std::string dropped;
        methods = options.methods.axes(dropped);
        if (!dropped.empty()) fmt::print(stderr, "{}\n", dropped);
    }
    lab.simulate(effects);
    std::vector<PlanSheet> sheets;
    for (const Axes& axes : methods) sheets.push_back(sheetOf(lab, profile, size, options, axes));
    if (!options.show.isGiven()) {
        fmt::print("{}", showPlans(sheets, page));
        return 0;
    }
    // What is explained is the plan with what the frame calls for.
    if (options.explain && !effects) lab.simulate(Effects::none());
    for (std::size_t i = 0; i < methods.size(); ++i)
        fmt::print("{}{}", pictureText(lab, profile, methods[i], size, options),
                   showPlans({sheets[i]}, page));
    return 0;
}

}  // namespace

void addPlan(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<PlanOptions>();
    CLI::App* command = app.add_subcommand(
        "plan", "The passes of one frame in OpenGL's terms and the chip's, and what the chip lacks for them");
    options->scenes.addTo(*command, "scene: id, scene file, mesh file (default: roettger)");
    options->profiles.addTo(*command, "chip (default: ideal)");
    options->methods.addTo(*command);
    options->sizes.addTo(*command);
    command->add_option("--frame", options->frame, "frame of the camera path")->capture_default_str();
    command->add_flag(
        "--explain", options->explain,
        "the plan with what the frame calls for: why each pass is there, what is left out and why");
    addHostMs(*command, options->hostMs);
    options->effects.addTo(*command);
    options->device.addTo(*command);
    options->format.addTo(*command);
    options->show.addTo(*command);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gnomon
