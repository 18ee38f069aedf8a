#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "app/commands.h"
#include "app/options.h"
#include "app/path.h"
#include "plan/chip_terms.h"

namespace gnomon {
namespace {

struct Options {
    ProfileOption profiles{};
    SceneOption scenes{};
    MethodOption methods{};
    SizeOption sizes{};
    FormatOption format{};
    int frame = 0;
};

int run(const Options& options) {
    const Format format = options.format.value();
    const Profile profile = theOnly("--profile", options.profiles.load({"ideal"}));
    const Size size = theOnly("--size", options.sizes.value());
    Lab lab(theOnly("--scene", options.scenes.load({"roettger"})));
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
    std::string separator = format == Format::Json ? "[" : "";
    std::vector<PlanSheet> sheets;
    for (const Axes& axes : methods) {
        const Plan plan = lab.plan(profile, axes, size.width, size.height, options.frame);
        std::vector<std::string> terms;
        for (const Pass& pass : plan.passes) terms.push_back(chipTerms(pass, profile, plan));
        sheets.push_back({methodId(axes), name(axes.shade), profile.id, lab.scene().id, options.frame, plan,
                          lab.missingFor(profile, axes, plan), std::move(terms)});
    }
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
    options->format.addTo(*command);
    command->callback([options, &status] { status = run(*options); });
}

}  // namespace gnomon
