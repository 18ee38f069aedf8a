#include "app/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include "app/terminal.h"
#include "app/word_values.h"
#include "matrix/hard_run.h"
#include "matrix/probe.h"
#include "profile/words.h"

namespace gnomon {
namespace {

constexpr int kLargestSide = 8192;
constexpr int kMostLights = 8;  ///< unless the user asks for more
constexpr std::size_t kMostMethods =
    10'000;                           ///< combinations of axes, those included that contradict themselves
constexpr int kMostFrames = 100'000;  ///< of a camera path

int wholeNumber(const std::string& flag, const std::string& word) {
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
        throw UsageError(fmt::format("{}: '{}' is not a whole number", flag, word));
    return value;
}

/// "x,y,z" with @p least to @p most numbers.
std::vector<float> numbers(const std::string& flag, const std::string& text, std::size_t least,
                           std::size_t most) {
    std::vector<float> values;
    std::size_t at = 0;
    while (at <= text.size()) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        const std::string word = text.substr(at, comma - at);
        char* end = nullptr;
        const float value = std::strtof(word.c_str(), &end);
        if (word.empty() || *end != 0 || !std::isfinite(value))
            throw UsageError(fmt::format("{}: '{}' is not a number", flag, word));
        values.push_back(value);
        at = comma + 1;
    }
    if (values.size() < least || values.size() > most)
        throw UsageError(fmt::format("{}: {} numbers in '{}', {} wanted", flag, values.size(), text, least));
    return values;
}

std::optional<glm::vec3> point(const std::string& flag, const std::string& text) {
    if (text.empty()) return std::nullopt;
    const auto v = numbers(flag, text, 3, 3);
    return glm::vec3(v[0], v[1], v[2]);
}

int divisorOf(const std::string& word) {
    if (const auto divisor = maskDivisorOf(word)) return *divisor;
    throw UsageError(fmt::format("--mask-scale: no such value '{}' (known: 1, 1/2, 1/4)", word));
}

/// Leaves the lights that --lights asks for.
void takeLights(Scene& scene, const std::string& word) {
    const std::size_t all = scene.lights.size();
    std::size_t wanted = all;
    if (word.empty()) {
        wanted = std::min<std::size_t>(all, kMostLights);
    } else if (word != "all") {
        const int number = wholeNumber("--lights", word);
        if (number < 1) throw UsageError(fmt::format("--lights: {} is less than 1", number));
        if (std::size_t(number) > all) throw UsageError(fmt::format("--lights: {} has {}", scene.id, all));
        wanted = std::size_t(number);
    }
    scene.lights.resize(wanted);
    if (wanted < all)
        scene.notes.push_back(fmt::format("{} of {} lights (--lights all takes them all)", wanted, all));
}

/// A caller's values, or the one that is there.
template <class T>
std::vector<T> orElse(std::vector<T> values, const T& other) {
    return values.empty() ? std::vector<T>{other} : values;
}

}  // namespace

std::filesystem::path dataFolder(const std::string& name) {
    std::error_code none;
    const auto isRoot = [&](const std::filesystem::path& folder) {
        return std::filesystem::exists(folder / "profiles/ideal.toml", none) &&
               std::filesystem::is_directory(folder / "scenes", none);
    };
    for (auto folder = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
         folder.has_relative_path(); folder = folder.parent_path())
        for (const auto& root : {folder, folder / "share/gnomon"})
            if (isRoot(root)) return root / name;
    // Built outside of the repository.
    if (isRoot(GNOMON_SOURCE)) return std::filesystem::path(GNOMON_SOURCE) / name;
    throw UsageError(fmt::format("no folder {}/ beside or above the program", name));
}

void FormatOption::addTo(CLI::App& app) {
    app.add_option("--format", word, "text, json or csv")
        ->capture_default_str()
        ->check(CLI::IsMember({"text", "json", "csv"}));
}

void FormatOption::addColourTo(CLI::App& app) {
    app.add_option("--colour", colour,
                   "verdicts in colours: auto (on a terminal, unless NO_COLOR is set), always, never")
        ->capture_default_str()
        ->check(CLI::IsMember({"auto", "always", "never"}));
}

Page FormatOption::value() const {
    Page page = word == "json" ? Format::Json : word == "csv" ? Format::Csv : Format::Text;
    page.width = textColumns();
    page.colours = colour == "always" || (colour == "auto" && takesColours(STDOUT_FILENO));
    return page;
}

void ProfileOption::addTo(CLI::App& app, const std::string& help) {
    app.add_option("--profile", ids, help)->delimiter(',')->allow_extra_args(false)->type_name("ID");
}

std::vector<Profile> ProfileOption::load(const std::vector<std::string>& fallback) const {
    const auto folder = dataFolder("profiles");
    const auto known = profileIds(folder);
    std::vector<Profile> profiles;
    for (const std::string& id : !ids.empty() ? ids : fallback.empty() ? known : fallback) {
        const bool isFile = id.ends_with(".toml");
        if (!isFile && std::find(known.begin(), known.end(), id) == known.end())
            throw UsageError(
                fmt::format("--profile: no such chip '{}' (known: {})", id, fmt::join(known, ", ")));
        Profile profile = loadProfile(isFile ? std::filesystem::path(id) : folder / (id + ".toml"));
        const bool isKnown = std::any_of(profiles.begin(), profiles.end(),
                                         [&](const Profile& p) { return p.id == profile.id; });
        if (!isKnown) profiles.push_back(std::move(profile));
    }
    // The ideal chip first: the others are read against it.
    if (ids.empty())
        std::stable_partition(profiles.begin(), profiles.end(),
                              [](const Profile& p) { return p.id == "ideal"; });
    return profiles;
}

void SceneOption::addTo(CLI::App& app, const std::string& help) {
    app.add_option("scene,--scene", ids, help)->delimiter(',')->allow_extra_args(false)->type_name("ID|FILE");
    const std::string group = "Light and camera (y up; default: from the file, else around the mesh)";
    app.add_option("--light", light, "x,y,z of a point light, or x,y,z,0 towards one at infinity")
        ->group(group);
    app.add_option(
           "--lights", lights,
           fmt::format("how many of the scene's lights: a number or all (default: at most {})", kMostLights))
        ->group(group);
    app.add_option("--eye", eye, "x,y,z")->group(group);
    app.add_option("--target", target, "x,y,z that the eye looks at")->group(group);
    app.add_option("--fov", fov, "vertical field of view, degrees")->group(group);
    app.add_option("--near", near, "distance of the near plane")->group(group);
    app.add_option("--ground", ground, "add a floor below a mesh: yes or no (default: yes, but no for glTF)")
        ->check(CLI::IsMember({"yes", "no"}))
        ->group(group);
}

namespace {

/// Refuses a hard case that promises something of what does not exist.
void checkPromises(const std::filesystem::path& file, const Scene& scene) {
    if (!scene.hard) return;
    for (const auto* cells : {&scene.hard->fails, &scene.hard->exact}) {
        for (const HardCell& cell : *cells) {
            const auto refuse = [&](const std::string& what) {
                throw SceneError(fmt::format("{}:{}: {}", file.string(), cell.line, what));
            };
            try {
                resolve(cell, dataFolder("profiles"));
            } catch (const std::runtime_error& error) {
                refuse(error.what());
            }
            if (cell.dithers && cell.fidelity != "chip") refuse("'dither' needs fidelity = \"chip\"");
            if (cell.frame >= int(scene.frames.size()))
                refuse(fmt::format("'frame' must be below {}", scene.frames.size()));
        }
    }
}

}  // namespace

std::vector<Scene> SceneOption::load(const std::vector<std::string>& fallback) const {
    SceneOverrides overrides;
    if (!light.empty()) {
        const auto v = numbers("--light", light, 3, 4);
        overrides.light = glm::vec4(v[0], v[1], v[2], v.size() == 4 ? v[3] : 1);
    }
    overrides.eye = point("--eye", eye);
    overrides.target = point("--target", target);
    if (fov) overrides.fovDegrees = float(*fov);
    if (near) overrides.nearPlane = float(*near);
    if (!ground.empty()) overrides.ground = ground == "yes";

    const auto folder = dataFolder("scenes");
    const auto shipped = sceneIds(folder), hard = hardSceneIds(folder);
    std::vector<std::string> wanted;
    for (const std::string& id : !ids.empty() ? ids : fallback.empty() ? shipped : fallback) {
        if (id == "all") wanted.insert(wanted.end(), shipped.begin(), shipped.end());
        if (id == "all" || id == "hard")
            wanted.insert(wanted.end(), hard.begin(), hard.end());
        else
            wanted.push_back(id);
    }
    std::vector<Scene> scenes;
    for (const std::string& id : wanted) {
        const bool isKnown =
            std::any_of(scenes.begin(), scenes.end(), [&](const Scene& s) { return s.id == id; });
        if (isKnown) continue;
        const auto file = findScene(id, folder);
        scenes.push_back(loadScene(file, overrides));
        checkPromises(file, scenes.back());
    }
    for (Scene& scene : scenes) takeLights(scene, lights);
    return scenes;
}

std::map<std::string, std::string> SceneOption::view() const {
    std::map<std::string, std::string> flags;
    const auto add = [&](const char* flag, const std::string& value) {
        if (!value.empty()) flags[flag] = value;
    };
    add("light", light), add("eye", eye), add("target", target), add("ground", ground), add("lights", lights);
    if (fov) flags["fov"] = fmt::format("{}", *fov);
    if (near) flags["near"] = fmt::format("{}", *near);
    return flags;
}

void SceneOption::place(const std::map<std::string, std::string>& view) {
    for (const auto& [flag, value] : view) {
        const auto number = [&, word = flag, text = value] {
            return double(numbers("--" + word, text, 1, 1).front());
        };
        if (flag == "light")
            light = value;
        else if (flag == "eye")
            eye = value;
        else if (flag == "target")
            target = value;
        else if (flag == "lights")
            lights = value;
        else if (flag == "ground" && (value == "yes" || value == "no"))
            ground = value;
        else if (flag == "fov")
            fov = number();
        else if (flag == "near")
            near = number();
        else
            throw UsageError(fmt::format("no view '{} {}'", flag, value));
    }
}

void MethodOption::addTo(CLI::App& app) {
    app.add_option("--method", ids, "named methods (gnomon methods lists them)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("ID");
    const std::string group = "Axes of a method (each a comma list; the product is taken)";
    const auto axis = [&](const std::string& flag, std::vector<std::string>& words, const std::string& help) {
        app.add_option(flag, words, help)->delimiter(',')->allow_extra_args(false)->group(group);
    };
    axis("--store", stores, listOf<Store>(kStores));
    axis("--arithmetic", arithmetics, listOf<Arithmetic>(kArithmetics));
    app.add_option("--levels", levels, "nesting depth that double resolves, 1 to 8 (default: 2)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->group(group);
    axis("--count", counts, listOf<Count>(kCounts));
    axis("--silhouette", silhouettes, listOf<Silhouette>(kSilhouettes));
    axis("--mask-scale", maskScales, "1, 1/2, 1/4");
    axis("--apply", applies, listOf<Apply>(kApplies));
    axis("--shade", shades, "black, ambient, attenuated (default)");
    axis("--start", starts,
         "where a count starts: zero (default), middle, bias (a stencil's: 1 per volume that holds the eye)");
    axis("--overflow", overflows, "of a count: either (default: wrap where the chip can), wrap, saturate");
    axis("--caps", caps, "of volumes: the lit faces (default) or those turned away");
    axis("--clip", clips, "where the host cuts volumes: frustum (default), eye (the plane through it), none");
    app.add_option("--offset", offsets, "start volumes this far behind their caster, world units (zfail)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->group(group);
    app.add_option("--map-size", mapSizes,
                   fmt::format("texels per side of a depth map (default: {})", kDefaultMapSize))
        ->delimiter(',')
        ->allow_extra_args(false)
        ->group(group);
    app.add_option(
           "--map-bias", mapBiases,
           fmt::format("of a depth map, a share of the distance to the light (default: {})", kDefaultMapBias))
        ->delimiter(',')
        ->allow_extra_args(false)
        ->group(group);
}

bool MethodOption::isEmpty() const {
    return ids.empty() && stores.empty() && arithmetics.empty() && counts.empty() && silhouettes.empty() &&
           maskScales.empty() && applies.empty() && levels.empty() && starts.empty() && overflows.empty() &&
           caps.empty() && clips.empty() && offsets.empty() && mapSizes.empty() && mapBiases.empty();
}

std::vector<Shade> MethodOption::shadeList() const {
    return orElse(wordsOf<Shade>("--shade", shades, kShades), Shade::Attenuated);
}

/// Refuses flags that mean nothing to any of @p methods.
void MethodOption::checkUsed(const std::vector<Axes>& methods) const {
    const auto need = [&](const auto& given, const char* flag, const char* what, auto uses) {
        if (!given.empty() && std::none_of(methods.begin(), methods.end(), uses))
            throw UsageError(fmt::format("{}: none of these methods {}", flag, what));
    };
    const auto isMap = [](const Axes& a) { return a.store == Store::DepthMap; };
    const auto hasVolumes = [&](const Axes& a) { return a.store != Store::None && !isMap(a); };
    need(levels, "--levels", "doubles", [](const Axes& a) { return a.arithmetic == Arithmetic::Double; });
    need(mapSizes, "--map-size", "has a depth map", isMap);
    need(mapBiases, "--map-bias", "has a depth map", isMap);
    need(counts, "--count", "has volumes", hasVolumes);
    need(silhouettes, "--silhouette", "has volumes", hasVolumes);
    need(arithmetics, "--arithmetic", "has volumes", hasVolumes);
}

std::vector<Axes> MethodOption::axes(std::string& dropped) const {
    std::vector<Axes> bases;
    for (const std::string& id : ids) {
        const NamedMethod* method = findMethod(id);
        std::vector<std::string> known;
        for (const NamedMethod& m : namedMethods()) known.push_back(m.id);
        if (!method)
            throw UsageError(
                fmt::format("--method: no such method '{}' (known: {})", id, fmt::join(known, ", ")));
        bases.push_back(method->axes);
    }
    const auto storeList = wordsOf<Store>("--store", stores, kStores);
    if (bases.empty())
        for (const Store store : storeList) bases.push_back(defaultsOf(store));
    if (bases.empty())
        // An automatic method tries all others in each frame and on each chip: it runs where it is named.
        for (const NamedMethod& m : namedMethods())
            if (!m.axes.automatic) bases.push_back(m.axes);
    for (const int level : levels)
        if (level < 1 || level > 8) throw UsageError(fmt::format("--levels: {} is not within 1 to 8", level));
    for (const int size : mapSizes)
        if (size < 1 || size > 8192)
            throw UsageError(fmt::format("--map-size: {} is not within 1 to 8192", size));
    for (const float bias : mapBiases)
        if (!(bias >= 0 && bias < 1))
            throw UsageError(fmt::format("--map-bias: {} is not within 0 to 1", bias));
    for (const float offset : offsets)
        if (!(offset >= 0 && offset < 1e15f))
            throw UsageError(fmt::format("--offset: {} is no distance", offset));

    // The product, axis by axis.
    const auto spread = [&](auto values, auto member) {
        if (values.empty()) return;
        if (bases.size() * values.size() > kMostMethods)
            throw UsageError(fmt::format(
                "more than the {} methods and combinations of axes that gnomon takes", kMostMethods));
        std::vector<Axes> product;
        for (const Axes& axes : bases) {
            for (const auto& value : values) {
                product.push_back(axes);
                product.back().*member = value;
            }
        }
        bases = std::move(product);
    };
    std::vector<int> divisors;
    for (const std::string& word : maskScales) divisors.push_back(divisorOf(word));
    if (!ids.empty()) spread(storeList, &Axes::store);
    spread(wordsOf<Arithmetic>("--arithmetic", arithmetics, kArithmetics), &Axes::arithmetic);
    for (Axes& axes : bases)
        if (axes.arithmetic == Arithmetic::Double && axes.levels == 0) axes.levels = 2;
    spread(levels, &Axes::levels);
    spread(wordsOf<Count>("--count", counts, kCounts), &Axes::count);
    spread(wordsOf<Silhouette>("--silhouette", silhouettes, kSilhouettes), &Axes::silhouette);
    spread(divisors, &Axes::maskDivisor);
    spread(wordsOf<Apply>("--apply", applies, kApplies), &Axes::apply);
    spread(shadeList(), &Axes::shade);
    spread(wordsOf<Start>("--start", starts, kStarts), &Axes::start);
    spread(wordsOf<Overflow>("--overflow", overflows, kOverflows), &Axes::overflow);
    spread(wordsOf<CapFaces>("--caps", caps, kCapFaces), &Axes::capFaces);
    spread(wordsOf<Clip>("--clip", clips, kClips), &Axes::clip);
    spread(offsets, &Axes::offset);
    for (Axes& axes : bases)
        if (axes.store == Store::DepthMap) axes = normalised(axes);
    spread(mapSizes, &Axes::mapSize);
    spread(mapBiases, &Axes::mapBias);

    std::vector<Axes> all;
    int contradictions = 0;
    std::string why;
    for (const Axes& given : bases) {
        const Axes axes = normalised(given);
        if (const auto reason = contradiction(axes)) {
            ++contradictions;
            if (why.empty()) why = *reason;
        } else if (std::find(all.begin(), all.end(), axes) == all.end()) {
            all.push_back(axes);
        }
    }
    if (all.empty()) throw UsageError("no method is left: " + why);
    checkUsed(all);
    if (contradictions)
        dropped = fmt::format("{} combinations left out that contradict themselves, such as: {}",
                              contradictions, why);
    return all;
}

void EffectsOption::addTo(CLI::App& app) {
    std::string names;
    for (int i = 0; i < kEffects; ++i) names += (i ? ", " : "") + name(Effect(i));
    app.add_option(
           "--effects", words,
           "needed: draw what the frame calls for, and no more; full: everything; or a list of what is\n"
           "drawn all the same, of " +
               names + "\n(default: named methods in full, as they are published; auto as needed)")
        ->delimiter(',')
        ->allow_extra_args(false);
}

std::optional<Effects> EffectsOption::value() const {
    if (words.empty()) return std::nullopt;
    for (const std::string& word : words) {
        const bool isWhole = word == "full" || word == "needed";
        if (isWhole && words.size() > 1)
            throw UsageError(fmt::format("--effects: '{}' stands by itself, not in a list", word));
        if (std::count(words.begin(), words.end(), word) > 1)
            throw UsageError(fmt::format("--effects: '{}' stands there twice", word));
        if (!isWhole && !effectNamed(word))
            throw UsageError(fmt::format(
                "--effects: no such effect '{}'; it is full, needed, or a list of effects", word));
    }
    return effectsFrom(fmt::format("{}", fmt::join(words, ",")));
}

void SizeOption::addTo(CLI::App& app) {
    app.add_option("--size", words, "image size in pixels (default: 320x240)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("WxH");
}

std::vector<Size> SizeOption::value() const {
    std::vector<Size> sizes;
    std::set<std::pair<int, int>> known;
    for (const std::string& word : words) {
        const std::size_t x = word.find('x');
        if (x == std::string::npos) throw UsageError(fmt::format("--size: '{}' is not WxH", word));
        const Size size{wholeNumber("--size", word.substr(0, x)), wholeNumber("--size", word.substr(x + 1))};
        for (const int side : {size.width, size.height})
            if (side < 1 || side > kLargestSide)
                throw UsageError(
                    fmt::format("--size: {} in '{}' is not within 1 to {} pixels", side, word, kLargestSide));
        if (known.emplace(size.width, size.height).second) sizes.push_back(size);
    }
    return sizes.empty() ? std::vector<Size>{{}} : sizes;
}

void addHostMs(CLI::App& app, double& hostMs) {
    app.add_option("--host-ms", hostMs,
                   "cost model: milliseconds that the machine's processor needs for a frame, beside the chip "
                   "(default: left out)")
        ->check([](const std::string& word) -> std::string {
            double value = -1;  // CLI::Range lets nan through
            const bool isNumber = CLI::detail::lexical_cast(word, value);
            return isNumber && value >= 0 && value <= 1e6 ? "" : word + " is not in 0 to 1000000";
        });
}

void checkFrame(const std::string& flag, int frame, const Scene& scene) {
    if (frame < 0 || frame >= int(scene.frames.size()))
        throw UsageError(fmt::format("{}: {} has frames 0 to {}", flag, scene.id, scene.frames.size() - 1));
}

std::vector<int> parseFrames(const std::vector<std::string>& words) {
    std::vector<int> frames;
    std::vector<bool> isTaken(kMostFrames);
    for (const std::string& word : words) {
        const std::size_t dash = word.find('-', 1);
        const int first = wholeNumber("--frames", word.substr(0, dash));
        const int last = dash == std::string::npos ? first : wholeNumber("--frames", word.substr(dash + 1));
        if (first < 0 || last < first || last >= kMostFrames)
            throw UsageError(fmt::format("--frames: '{}' is no range of frames", word));
        for (int f = first; f <= last; ++f) {
            if (!isTaken[std::size_t(f)]) frames.push_back(f);
            isTaken[std::size_t(f)] = true;
        }
    }
    return frames;
}

void FidelityOption::addTo(CLI::App& app) {
    app.add_option("--fidelity", words,
                   "gl: the host's blending in the chip's buffer formats (default); chip: the chip's own "
                   "arithmetic, bit for bit")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--dither", dither,
                   "fidelity chip: off (where the chip can do without), on (as its driver has it)")
        ->capture_default_str()
        ->check(CLI::IsMember({"off", "on"}));
    app.add_option("--blend-unit", unit,
                   "fidelity chip: another of the blend units that a profile lists, where sources disagree");
}

std::vector<FidelityChoice> FidelityOption::value(const std::vector<Profile>& profiles) const {
    FidelityChoice choice{.dithers = dither == "on"};
    if (!unit.empty()) {
        choice.unit = fromName<BlendUnit>(unit);
        if (!choice.unit)
            throw UsageError(fmt::format("--blend-unit: no such value '{}' (known: {})", unit,
                                         fmt::join(names<BlendUnit>(), ", ")));
        const bool listed = std::any_of(profiles.begin(), profiles.end(), [&](const Profile& p) {
            return std::find(p.blendUnits.begin(), p.blendUnits.end(), *choice.unit) != p.blendUnits.end();
        });
        if (!listed) throw UsageError(fmt::format("--blend-unit: no chosen profile lists {}", unit));
    }
    std::vector<FidelityChoice> choices;
    for (const std::string& word : words) {
        if (word != "gl" && word != "chip")
            throw UsageError(fmt::format("--fidelity: no such value '{}' (known: gl, chip)", word));
        choice.fidelity = word == "chip" ? Fidelity::Chip : Fidelity::Gl;
        const bool isNew = std::none_of(choices.begin(), choices.end(), [&](const FidelityChoice& c) {
            return c.fidelity == choice.fidelity;
        });
        if (isNew) choices.push_back(choice);
    }
    if (choices.empty()) choices.push_back(choice);
    const bool chip = std::any_of(choices.begin(), choices.end(),
                                  [](const FidelityChoice& c) { return c.fidelity == Fidelity::Chip; });
    if (!chip && (choice.dithers || choice.unit))
        throw UsageError("--dither and --blend-unit are of --fidelity chip");
    return choices;
}

void DeviceOption::addTo(CLI::App& app) {
    app.add_option("--device", word,
                   fmt::format("what draws: {} (default: {}; gnomon devices lists them)",
                               listOf<Device>(kDevices), name(defaultDevice())));
}

Device DeviceOption::value() const {
    const Device device = word.empty() ? defaultDevice() : wordOf<Device>("--device", word, kDevices);
    // OSMesa, where it is built in, brings its driver along.
    if (isBuilt(device) && device == Device::Osmesa) return device;
    const DriverFacts facts = probe(device);
    if (!facts.problem.empty()) throw UsageError(fmt::format("--device {}: {}", name(device), facts.problem));
    return device;
}

}  // namespace gnomon
