#include <fmt/format.h>

#include <cstdio>

#include "app/commands.h"
#include "app/options.h"
#include "app/terminal.h"
#include "matrix/advice.h"
#include "report/advice_report.h"

namespace gnomon {
namespace {

struct AdviseOptions {
    ProfileOption profiles{};
    SceneOption scenes{};
    SizeOption sizes{};
    FidelityOption fidelity{};
    FormatOption format{};
    DeviceOption device{};
    int frame = 0;
};

int run(const AdviseOptions& options) {
    const Page page = options.format.value();
    const Profile profile = theOnly("--profile", options.profiles.load({"ideal"}));
    const Size size = theOnly("--size", options.sizes.value());
    Lab lab(theOnly("--scene", options.scenes.load({"roettger"})));
    lab.drawOn(options.device.value());
    const FidelityChoice fidelity = theOnly("--fidelity", options.fidelity.value({profile}));
    lab.use(fidelity);
    const Scene& scene = lab.scene();
    checkFrame("--frame", options.frame, scene);
    for (const std::string& note : scene.notes) fmt::print(stderr, "{}: {}\n", scene.id, note);

    TerminalProgress bar("methods");
    const Advice advice = advise(lab, profile, size.width, size.height, options.frame,
                                 [&](const Progress& at) { bar.show(at); });
    bar.clear();
    fmt::print("{}", showAdvice(advice, page));
    return advice.chosen ? 0 : 1;
}

}  // namespace

void addAdvise(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<AdviseOptions>();
    CLI::App* command = app.add_subcommand(
        "advise",
        "For a scene and a chip: the methods that are exact, cheapest first; what the next cheaper one gets\n"
        "wrong and why; and the passes of the cheapest as OpenGL calls to copy.");
    options->scenes.addTo(*command, "scene: id, scene file, mesh file (default: roettger)");
    options->profiles.addTo(*command, "chip (default: ideal)");
    options->sizes.addTo(*command);
    command->add_option("--frame", options->frame, "frame of the camera path")->capture_default_str();
    options->fidelity.addTo(*command);
    options->device.addTo(*command);
    options->format.addTo(*command);
    options->format.addColourTo(*command);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gnomon
