#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "app/commands.h"
#include "app/options.h"
#include "app/path.h"
#include "matrix/choice.h"
#include "plan/chip_terms.h"

namespace gnomon {
namespace {

struct Options {
    ProfileOption profiles{};
    SceneOption scenes{};
    MethodOption methods{};
    SizeOption sizes{};
    EffectsOption effects{};
    FormatOption format{};
    DeviceOption device{};
    int frame = 0;
    double hostMs = 0;
    bool explain = false;
};

/// What is to be listed of one method.
PlanSheet sheetOf(Lab& lab, const Profile& profile, const Size& size, const Options& options,
                  const Axes& asked) {
    const auto [width, height] = size;
    const int frame = options.frame;
    Axes axes = asked;
    PlanSheet sheet{.method = methodId(asked),
                    .shade = name(asked.shade),
                    .profile = profile.id,
                    .scene = lab.scene().id,
                    .frame = frame};
    if (asked.automatic) {
        const auto all = gnomon::options(lab, profile, asked.shade, width, height, frame);
        axes = choose(lab, profile, all, width, height, frame).option.axes;
    }
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

int run(const Options& options) {
    const Format format = options.format.value();
    const std::optional<Effects> effects = options.effects.value();
    const Profile profile = theOnly("--profile", options.profiles.load({"ideal"}));
    const Size size = theOnly("--size", options.sizes.value());
    Lab lab(theOnly("--scene", options.scenes.load({"roettger"})));
    lab.drawOn(options.device.value());
    if (options.frame < 0 || options.frame >= int(lab.scene().frames.size()))
        throw UsageError(
            fmt::format("--frame: {} has frames 0 to {}", lab.scene().id, lab.scene().frames.size() - 1));

    std::vector<Axes> methods;
    if (options.methods.isEmpty()) {
        std::string words;
        for (const Shade shade : options.methods.shadeList())
            if (const auto axes =
                    choosePath(lab, profile, shade, size.width, size.height, options.frame, words))
                methods.push_back(*axes);
        if (format == Format::Text) fmt::print("{}\n", words);
    } else {
        std::string dropped;
        methods = options.methods.axes(dropped);
        if (!dropped.empty()) fmt::print(stderr, "{}\n", dropped);
    }
    lab.simulate(effects);
    std::vector<PlanSheet> sheets;
    for (const Axes& axes : methods) sheets.push_back(sheetOf(lab, profile, size, options, axes));
    fmt::print("{}", showPlans(sheets, format));
    return 0;
}

}  // namespace

void addPlan(CLI::App& app, int& status) {
    const auto options = std::make_shared<Options>();
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
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gnomon
