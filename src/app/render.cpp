#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

#include "app/commands.h"
#include "app/options.h"
#include "app/output_file.h"
#include "app/path.h"
#include "app/show.h"
#include "gl/stopwatch.h"
#include "matrix/choice.h"
#include "matrix/film_strip.h"
#include "report/cause_picture.h"
#include "report/matrix_report.h"
#include "report/table.h"
#include "report/verdict_colour.h"

namespace gnomon {
namespace {

struct RenderCommandOptions {
    ProfileOption profiles{};
    SceneOption scenes{};
    MethodOption methods{};
    SizeOption sizes{};
    FidelityOption fidelity{};
    EffectsOption effects{};
    FormatOption format{};
    ShowOption show{};
    DeviceOption device{};
    int frame = 0;
    std::string image{}, mask{}, truth{}, steps{};
};

/// Writes the buffer that counts after each pass: colour, and alpha or stencil where the mask stands there.
std::function<void(Surface&, std::size_t)> stepWriter(const std::filesystem::path& folder, const Plan& plan) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw UsageError(fmt::format("--steps: {}: {}", folder.string(), error.message()));
    const MaskBuffer buffer = maskBufferOf(plan);
    return stripReader(stripPasses(plan, plan.passes.size()), buffer, [folder, buffer](StripPicture step) {
        const auto file = [&](const std::string& of) {
            return folder / fmt::format("{:03}-{}.png", step.pass + 1, of);
        };
        writeImage(file("colour"), step.colour);
        if (buffer == MaskBuffer::None) return;
        // Counts are small numbers: 0 black, 1 to 7 in steps of 32, more white.
        if (buffer == MaskBuffer::Stencil)
            for (std::uint8_t& value : step.mask.data) value = std::uint8_t(std::min(255, value * 32));
        writeImage(file(name(buffer)), step.mask);
    });
}

const char* proofText(Proof proof) {
    switch (proof) {
        case Proof::Predicted:
            return "proved exact in this frame";
        case Proof::Drawn:
            return "exact as drawn, but not proved";
        case Proof::None:
            return "the least wrong: no method is exact here";
        case Proof::Refused:
            return "though the chip can run no method";
    }
    return "";
}

std::string summary(const Cell& cell, const Page& page) {
    std::string text =
        fmt::format("{}: {}\n", cell.id(), inColour(name(cell.verdict), cell.verdict, page.colours));
    const auto line = [&](const std::string& words) {
        text += fmt::format("  {}\n", wrapText(words, 4, page.width));
    };
    if (cell.verdict == Verdict::Failed) {
        line(cell.error);
        return text;
    }
    for (const Missing& m : cell.missing) line(fmt::format("lacks {} [{}]", m.what, m.source));
    if (cell.verdict == Verdict::Refused) return text;
    line(fmt::format(
        "wrong pixels: {} at the boundary of shadows, {} away from it; tied: {} by truth, {} by count; of {}",
        cell.wrongEdge, cell.wrongInterior, cell.tiedTruth, cell.tiedCount, cell.pixels));
    for (const auto& [cause, pixels] : cell.causes) line(fmt::format("{}: {}", cause, pixels));
    line(fmt::format("unpredicted: {} untied pixels hold what exact arithmetic does not allow",
                     cell.unpredicted));
    for (const std::string& warning : cell.warnings) line(fmt::format("warning: {}", warning));
    line(fmt::format("passes: {} scene, {} volume, {} rectangle, {} copy", cell.passes.scene,
                     cell.passes.volume, cell.passes.rectangle, cell.passes.copy));
    if (!cell.drawnBy.empty()) line(fmt::format("drawn by: {}, {}", cell.drawnBy, proofText(cell.proof)));
    if (cell.effects != Effects::all()) line(fmt::format("effects: {}", toString(cell.effects)));
    line(fmt::format("cost: {} touched pixels, {} vertices, {:.2f} ms of this {} ({:.2f} ms without shadows)",
                     cell.touched.total(), cell.vertices, cell.cpuMs,
                     cell.clock == name(DrawClock::Gpu) ? "GPU" : "processor", cell.unshadowedMs));
    return text;
}

/// Writes @p image where the user wants it, if anywhere.
void writeOutput(const std::string& file, const Image& image) {
    if (!file.empty()) writeChosen([&] { writeImage(file, image); });
}

/// "mask.png" -> "mask-causes.png".
std::string causesFile(const std::string& mask) {
    if (mask.empty()) return mask;
    std::filesystem::path path(mask);
    path.replace_filename(path.stem().string() + "-causes.png");
    return path.string();
}

/// Refuses outputs that could not be written, before anything is drawn, so that all of them appear or none.
void checkOutputs(const RenderCommandOptions& options) {
    std::vector<std::filesystem::path> files;
    for (const std::string& file : {options.image, options.mask, causesFile(options.mask), options.truth}) {
        if (file.empty()) continue;
        checkOutputFile(file, {".png"}, "no .png file");
        std::error_code error;
        const std::filesystem::path whole =
            std::filesystem::weakly_canonical(std::filesystem::absolute(file), error);
        if (std::find(files.begin(), files.end(), whole) != files.end())
            throw UsageError(fmt::format("{}: named for two outputs", file));
        files.push_back(whole);
    }
}

int run(const RenderCommandOptions& options) {
    checkOutputs(options);
    const Page page = options.format.value();
    options.show.check(page);
    const Profile profile = theOnly("--profile", options.profiles.load({"ideal"}));
    const Size size = theOnly("--size", options.sizes.value());
    Lab lab(theOnly("--scene", options.scenes.load({"roettger"})));
    lab.drawOn(options.device.value());
    const FidelityChoice fidelity = theOnly("--fidelity", options.fidelity.value({profile}));
    lab.use(fidelity);
    lab.simulate(options.effects.value());
    const Scene& scene = lab.scene();
    checkFrame("--frame", options.frame, scene);
    for (const std::string& note : scene.notes) fmt::print(stderr, "{}: {}\n", scene.id, note);

    std::optional<Axes> axes;
    std::string words;
    if (options.methods.isEmpty()) {
        axes = choosePath(lab, profile, options.methods.shadeList().front(), size.width, size.height,
                          options.frame, words);
        if (page.format == Format::Text || !axes)
            fmt::print(page.format == Format::Text ? stdout : stderr, "{}", words);
    } else {
        const auto methods = options.methods.axes(words);
        if (methods.size() != 1)
            throw UsageError(fmt::format("render draws one method; these are {}", methods.size()));
        axes = methods.front();
    }
    if (!axes) return 1;

    std::function<void(Surface&, std::size_t)> steps;
    if (!options.steps.empty()) {
        // As Lab::run() draws what is chosen; its mask may stand in any buffer.
        if (axes->automatic && !lab.simulated()) lab.simulate(Effects::none());
        const Axes drawn = chosenAxes(lab, profile, *axes, size.width, size.height, options.frame);
        const Plan plan = drawnPlan(lab, profile, drawn, size.width, size.height, options.frame);
        if (lab.missingFor(profile, drawn, plan).empty()) steps = stepWriter(options.steps, plan);
    }
    Pictures pictures;
    Cell cell = lab.run(profile, *axes, size.width, size.height, options.frame, &pictures, steps);
    cell.chosen = options.methods.isEmpty();
    addQuestion(cell, fidelity, options.scenes.view());
    if (cell.verdict != Verdict::Refused && cell.verdict != Verdict::Failed) {
        writeOutput(options.image, pictures.image);
        writeOutput(options.mask, pictures.mask);
        if (!options.mask.empty())
            writeOutput(causesFile(options.mask), causePicture(pictures.mask, pictures.causes));
        writeOutput(options.truth, pictures.truth);
        if (options.show.isGiven()) fmt::print("{}", options.show.text(pictures.image));
    }
    fmt::print("{}", page.format == Format::Json  ? matrixJson({cell})
                     : page.format == Format::Csv ? matrixCsv({cell})
                                                  : summary(cell, page));
    if (cell.verdict == Verdict::Refused) return 1;
    if (cell.verdict == Verdict::Failed) return 3;
    return 0;
}

}  // namespace

void addRender(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<RenderCommandOptions>();
    CLI::App* command = app.add_subcommand("render",
                                           "One image, its mask, and the buffer after every pass. Without a "
                                           "method: the first of stencil, alpha,\n"
                                           "screen, and screen with texture that the chip can run.");
    options->scenes.addTo(*command, "scene: id, scene file, mesh file (default: roettger)");
    options->profiles.addTo(*command, "chip (default: ideal)");
    options->methods.addTo(*command);
    options->sizes.addTo(*command);
    command->add_option("--frame", options->frame, "frame of the camera path")->capture_default_str();
    command->add_option("-o,--output", options->image, "write the image here")->type_name("FILE.png");
    command
        ->add_option("--mask", options->mask, "write the shadows that it shows: white lit, black in shadow")
        ->type_name("FILE.png");
    command->add_option("--truth", options->truth, "write the exact shadows in the same way")
        ->type_name("FILE.png");
    command->add_option("--steps", options->steps, "write the buffers after every pass")->type_name("DIR");
    options->fidelity.addTo(*command);
    options->effects.addTo(*command);
    options->device.addTo(*command);
    options->format.addTo(*command);
    options->format.addColourTo(*command);
    options->show.addTo(*command);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gnomon
