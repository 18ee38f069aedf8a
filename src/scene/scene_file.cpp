#include "scene/scene_file.h"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <initializer_list>
#include <limits>
#include <numeric>

#include "scene/mesh_file.h"
#include "scene/primitives.h"
#include "scene/text.h"
#include "scene/weld.h"
#include "text/deep_key.h"
#include "text/one_line.h"

namespace gnomon {
namespace {

constexpr double kLargest = kMaxCoordinate;

/// One table of the file, with errors that name its lines.
class Table {
  public:
    Table(const std::filesystem::path& file, const toml::table& table) : m_file(file), m_table(table) {}

    [[noreturn]] void bad(const toml::node& node, std::string_view what) const {
        fail(m_file, node.source().begin.line, what);
    }
    [[noreturn]] void bad(std::string_view what) const {
        // The root table of an empty file has no line.
        fail(m_file, std::max(m_table.source().begin.line, toml::source_index(1)), what);
    }

    bool has(std::string_view key) const { return m_table.contains(key); }
    const std::filesystem::path& file() const { return m_file; }

    void allow(const std::vector<std::string_view>& keys, std::string_view where) const {
        for (const auto& [key, value] : m_table)
            if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
                fail(m_file, key.source().begin.line,
                     fmt::format("unknown key '{}' in {}", printable(key.str()), where));
    }

    const toml::node& need(std::string_view key) const {
        const toml::node* node = m_table.get(key);
        if (node == nullptr) bad(fmt::format("'{}' is missing", key));
        return *node;
    }

    double number(std::string_view key, double least, double most) const {
        return numberOf(need(key), key, least, most);
    }
    double number(std::string_view key, double least, double most, double otherwise) const {
        return has(key) ? number(key, least, most) : otherwise;
    }

    int integer(std::string_view key, int least, int most, int otherwise) const {
        if (!has(key)) return otherwise;
        const toml::node& node = need(key);
        const auto value = node.as_integer();
        if (value == nullptr || value->get() < least || value->get() > most)
            bad(node, fmt::format("'{}' must be a whole number from {} to {}", key, least, most));
        return int(value->get());
    }

    std::string text(std::string_view key) const {
        const auto value = need(key).as_string();
        if (value == nullptr) bad(need(key), fmt::format("'{}' must be a string", key));
        if (!isOneLine(value->get())) bad(need(key), fmt::format("'{}' must be one line", key));
        return value->get();
    }
    std::string text(std::string_view key, const std::string& otherwise) const {
        return has(key) ? text(key) : otherwise;
    }

    bool flag(std::string_view key, bool otherwise) const {
        if (!has(key)) return otherwise;
        const auto value = need(key).as_boolean();
        if (value == nullptr) bad(need(key), fmt::format("'{}' must be true or false", key));
        return value->get();
    }

    template <std::size_t N>
    std::array<double, N> numbers(std::string_view key, double least = -kLargest,
                                  double most = kLargest) const {
        const toml::node& node = need(key);
        const toml::array* values = node.as_array();
        if (values == nullptr || values->size() != N)
            bad(node, fmt::format("'{}' must be an array of {} numbers", key, N));
        std::array<double, N> out{};
        for (std::size_t k = 0; k < N; ++k) out[k] = numberOf((*values)[k], key, least, most);
        return out;
    }
    glm::dvec3 vector(std::string_view key, double least = -kLargest, double most = kLargest) const {
        const auto v = numbers<3>(key, least, most);
        return {v[0], v[1], v[2]};
    }
    glm::dvec3 vector(std::string_view key, const glm::dvec3& otherwise) const {
        return has(key) ? vector(key) : otherwise;
    }
    glm::vec3 colour(std::string_view key, const glm::vec3& otherwise) const {
        return has(key) ? glm::vec3(vector(key, 0, 1)) : otherwise;
    }

    Table table(std::string_view key) const {
        const toml::table* inner = need(key).as_table();
        if (inner == nullptr) bad(need(key), fmt::format("'{}' must be a table", key));
        return {m_file, *inner};
    }
    /// Of a list of lists of @p N numbers each, such as points.
    template <std::size_t N>
    std::vector<std::array<double, N>> rows(std::string_view key, double least, double most) const {
        const toml::array* list = need(key).as_array();
        if (list == nullptr) bad(need(key), fmt::format("'{}' must be an array of arrays", key));
        std::vector<std::array<double, N>> out;
        for (const toml::node& row : *list) {
            const toml::array* values = row.as_array();
            if (values == nullptr || values->size() != N)
                bad(row, fmt::format("'{}' must be arrays of {} numbers", key, N));
            for (std::size_t k = 0; k < N; ++k) {
                if (k == 0) out.emplace_back();
                out.back()[k] = numberOf((*values)[k], key, least, most);
            }
        }
        return out;
    }

    /// A string, number or truth value as the command line would have it.
    std::string word(std::string_view key) const {
        const toml::node& node = need(key);
        if (node.is_string()) return text(key);
        if (const auto value = node.as_integer()) return fmt::format("{}", value->get());
        if (const auto value = node.as_floating_point()) return fmt::format("{}", value->get());
        bad(node, fmt::format("'{}' must be a string or a number", key));
    }
    std::size_t line() const { return m_table.source().begin.line; }

    /// The tables of an array; it may have none.
    std::vector<Table> tables(std::string_view key) const {
        std::vector<Table> out;
        const toml::array* array = need(key).as_array();
        if (array == nullptr || (!array->empty() && !array->is_homogeneous<toml::table>()))
            bad(need(key), fmt::format("'{}' must be tables: [[{}]]", key, key));
        for (const toml::node& node : *array) out.emplace_back(m_file, *node.as_table());
        return out;
    }

  private:
    double numberOf(const toml::node& node, std::string_view key, double least, double most) const {
        const auto value = node.is_number() ? node.value<double>() : std::nullopt;
        if (!value) bad(node, fmt::format("'{}' must be a number", key));
        if (!(*value >= least && *value <= most)) {
            if (most == kLargest && least > 0) bad(node, fmt::format("'{}' must be positive", key));
            bad(node, fmt::format("'{}' must be from {:g} to {:g}", key, least, most));
        }
        return *value;
    }

    const std::filesystem::path& m_file;
    const toml::table& m_table;
};

constexpr double kTiny = 1e-18;  // "positive", "not zero": float has room for the square

Light readLight(const Table& table) {
    table.allow({"position", "direction", "colour"}, "a light");
    if (table.has("position") == table.has("direction"))
        table.bad("a light needs either position or direction");
    Light light{.colour = table.colour("colour", glm::vec3(1))};
    if (table.has("position")) {
        light.position = glm::vec4(glm::vec3(table.vector("position")), 1);
        return light;
    }
    const glm::dvec3 direction = table.vector("direction");
    if (glm::length(direction) < kTiny) table.bad(table.need("direction"), "'direction' must not be zero");
    light.position = glm::vec4(glm::vec3(glm::normalize(direction)), 0);
    return light;
}

std::vector<Camera> readCamera(const Table& table) {
    table.allow({"eye", "target", "up", "fov", "near", "orbit"}, "[camera]");
    const glm::dvec3 eye = table.vector("eye"), target = table.vector("target", glm::dvec3(0));
    const glm::dvec3 up = table.vector("up", glm::dvec3(0, 1, 0));
    Camera camera{.eye = glm::vec3(eye), .target = glm::vec3(target), .up = glm::vec3(up)};
    if (camera.eye == camera.target) table.bad(table.need("eye"), "'eye' must differ from 'target'");
    if (glm::length(up) < kTiny) table.bad(table.need("up"), "'up' must not be zero");
    camera.fovDegrees = float(table.number("fov", 0.01, 179, 45));
    camera.nearPlane = float(table.number("near", kTiny, kLargest, 0.1));
    if (!table.has("orbit")) return {camera};

    const Table orbit = table.table("orbit");
    orbit.allow({"frames", "axis"}, "orbit");
    const int frames = orbit.integer("frames", 1, 100000, 60);
    const glm::dvec3 axis = orbit.vector("axis", glm::dvec3(0, 1, 0));
    if (glm::length(axis) < kTiny) orbit.bad(orbit.need("axis"), "'axis' must not be zero");
    std::vector<Camera> path;
    for (int f = 0; f < frames; ++f) {
        const glm::dmat3 turn(glm::rotate(glm::dmat4(1), glm::radians(360.0 * f / frames), axis));
        path.push_back(camera);
        path.back().eye = glm::vec3(target + turn * (eye - target));
        path.back().up = glm::vec3(turn * up);
        if (path.back().eye == camera.target)
            table.bad(table.need("eye"),
                      fmt::format("'eye' must differ from 'target', but doesn't in frame {}", f));
    }
    return path;
}

/// Triangles as the file lists them; welding is left to the caller.
Mesh readTriangles(const Table& table) {
    Mesh mesh;
    for (const auto& v : table.rows<3>("vertices", -kLargest, kLargest))
        mesh.positions.emplace_back(glm::dvec3(v[0], v[1], v[2]));
    if (mesh.positions.empty()) table.bad(table.need("vertices"), "'vertices' must not be empty");
    const double last = double(mesh.positions.size()) - 1;
    for (const auto& t : table.rows<3>("triangles", 0, last)) {
        for (const double corner : t)
            if (corner != std::floor(corner))
                table.bad(table.need("triangles"), "'triangles' must be whole numbers");
        mesh.triangles.emplace_back(glm::dvec3(t[0], t[1], t[2]));
    }
    if (mesh.triangles.empty()) table.bad(table.need("triangles"), "'triangles' must not be empty");
    return mesh;
}

/// What a scene may still ask for.
class Budget {
  public:
    explicit Budget(const SceneLimits& limits) : m_limits(limits) {}

    const SceneLimits& limits() const { return m_limits; }

    /// Takes what @p table asks for, before it is made.
    void take(const Table& table, std::uint64_t objects, std::uint64_t triangles) {
        m_objects += objects, m_triangles += triangles;
        if (m_objects > m_limits.objects) table.bad(moreThan(m_limits.objects, "objects"));
        if (m_triangles > m_limits.triangles) table.bad(moreThan(m_limits.triangles, "triangles"));
    }

  private:
    SceneLimits m_limits;
    std::uint64_t m_objects = 0, m_triangles = 0;
};

/// The parameters of all shapes; each allows its own beside the common ones.
/// @param times  that it is repeated
std::vector<Object> readShape(const Table& table, int times, Budget& budget, std::vector<std::string>& notes,
                              Dropped& dropped) {
    const std::string shape = table.text("shape");
    const auto allow = [&](std::initializer_list<std::string_view> own) {
        std::vector<std::string_view> keys{"name",  "shape",  "at",    "rotate",
                                           "scale", "colour", "casts", "two_sided"};
        keys.push_back("repeat");
        keys.insert(keys.end(), own);
        table.allow(keys, "shape \"" + shape + "\"");
    };
    const auto positive = [&](std::string_view key, double otherwise) {
        return table.number(key, kTiny, kLargest, otherwise);
    };
    constexpr int kMostSegments = 100000;
    const auto segments = [&](std::string_view key, int least, int otherwise) {
        return table.integer(key, least, kMostSegments, otherwise);
    };
    const auto take = [&](std::uint64_t objects, std::uint64_t triangles) {
        budget.take(table, std::uint64_t(times) * objects, std::uint64_t(times) * triangles);
    };
    const auto one = [](Mesh mesh) {
        std::vector<Object> objects(1);
        objects[0].mesh = std::move(mesh);
        return objects;
    };
    if (shape == "box") {
        allow({"size"});
        take(1, 12);
        return one(box(table.has("size") ? table.vector("size", kTiny, kLargest) : glm::dvec3(1)));
    }
    if (shape == "rectangle") {
        allow({"size"});
        take(1, 2);
        const auto size = table.has("size") ? table.numbers<2>("size", kTiny) : std::array{1.0, 1.0};
        return one(rectangle({size[0], size[1]}));
    }
    if (shape == "cylinder") {
        allow({"radius", "height", "segments"});
        const int around = segments("segments", 3, 32);
        take(1, 4 * std::uint64_t(around));
        return one(cylinder(positive("radius", 0.5), positive("height", 1), around));
    }
    if (shape == "sphere") {
        allow({"radius", "segments", "rings"});
        const int around = segments("segments", 3, 32);
        const int rings = segments("rings", 2, std::max(2, around / 2));
        take(1, 2 * std::uint64_t(around) * std::uint64_t(rings - 1));
        return one(sphere(positive("radius", 0.5), around, rings));
    }
    if (shape == "torus") {
        allow({"radius", "tube", "segments", "sides"});
        const double radius = positive("radius", 1), tube = positive("tube", 0.3);
        if (tube >= radius) table.bad("'tube' must be less than 'radius'");
        const int around = segments("segments", 3, 32), sides = segments("sides", 3, 16);
        take(1, 2 * std::uint64_t(around) * std::uint64_t(sides));
        return one(torus(radius, tube, around, sides));
    }
    if (shape == "knot") {
        allow({"p", "q", "radius", "minor", "tube", "segments", "sides"});
        KnotShape knot;
        knot.p = table.integer("p", 1, 1000, knot.p);
        knot.q = table.integer("q", 1, 1000, knot.q);
        if (std::gcd(knot.p, knot.q) != 1) table.bad("'p' and 'q' must have no common divisor");
        knot.radius = positive("radius", knot.radius);
        knot.minor = positive("minor", knot.minor);
        knot.tube = positive("tube", knot.tube);
        if (knot.minor >= knot.radius) table.bad("'minor' must be less than 'radius'");
        knot.segments = segments("segments", 3, knot.segments);
        knot.sides = segments("sides", 3, knot.sides);
        take(1, 2 * std::uint64_t(knot.segments) * std::uint64_t(knot.sides));
        return one(torusKnot(knot));
    }
    if (shape == "triangles") {
        allow({"vertices", "triangles"});
        Mesh mesh = readTriangles(table);
        take(1, mesh.triangles.size());
        return one(std::move(mesh));
    }
    if (shape == "mesh") {
        allow({"file"});
        const std::filesystem::path file = table.file().parent_path() / table.text("file");
        if (!isMeshFile(file))
            table.bad(table.need("file"), "'file' must be .obj, .ply, .stl, .gltf or .glb");
        MeshFile mesh;
        try {
            mesh = loadMeshFile(file, budget.limits());
        } catch (const SceneError& error) {
            table.bad(table.need("file"), error.what());
        }
        for (const std::string& note : mesh.notes)
            notes.push_back(fmt::format("{}: {}", printable(table.text("file")), note));
        std::uint64_t triangles = mesh.dropped.repeatedVertex + mesh.dropped.flat.size();
        for (const Object& object : mesh.objects) triangles += object.mesh.triangles.size();
        take(mesh.objects.size(), triangles);
        dropped = std::move(mesh.dropped);
        return std::move(mesh.objects);
    }
    table.bad(table.need("shape"), fmt::format("unknown shape '{}'", printable(shape)));
}

/// How often an object stands there, each moved on from the one before.
struct Repeat {
    int count = 1;
    glm::dvec3 step{0};
};

Repeat readRepeat(const Table& table) {
    if (!table.has("repeat")) return {};
    const Table repeat = table.table("repeat");
    repeat.allow({"count", "step"}, "repeat");
    repeat.need("count");
    return {.count = repeat.integer("count", 1, 10000, 1), .step = repeat.vector("step")};
}

/// @param at  where it stands
void addObject(const Table& table, std::vector<Object> parts, Dropped unmoved, const std::string& name,
               const glm::dvec3& at, Scene& scene) {
    const double scale = table.number("scale", kTiny, kLargest, 1);
    glm::dmat4 turn(1);
    if (table.has("rotate")) {
        const auto r = table.numbers<4>("rotate");
        const glm::dvec3 axis(r[0], r[1], r[2]);
        if (glm::length(axis) < kTiny)
            table.bad(table.need("rotate"), "'rotate' needs an axis that isn't zero");
        turn = glm::rotate(glm::dmat4(1), glm::radians(r[3]), axis);
    }
    const auto move = [&](glm::vec3& p) {
        const glm::dvec3 moved = at + glm::dmat3(turn) * (scale * glm::dvec3(p));
        for (int k = 0; k < 3; ++k)
            if (const std::string fault = coordinateFault(moved[k]); !fault.empty()) table.bad(fault);
        p = glm::vec3(moved);
    };
    const bool casts = table.flag("casts", true);
    if (!casts) unmoved = {};
    scene.dropped.repeatedVertex += unmoved.repeatedVertex;
    for (auto corners : unmoved.flat) {
        for (glm::vec3& p : corners) move(p);
        scene.dropped.flat.push_back(corners);
    }
    for (Object& part : parts) {
        part.name = parts.size() == 1 ? name : name + "/" + part.name;
        part.colour = table.colour("colour", part.colour);
        part.casts = casts;
        part.twoSided = table.flag("two_sided", part.twoSided);
        for (glm::vec3& p : part.mesh.positions) move(p);
        // Moved vertices are rounded: some may coincide now.
        Dropped dropped;
        part.mesh = weld(part.mesh.positions, part.mesh.triangles, dropped);
        if (const std::string what = describe(dropped); !what.empty())
            scene.notes.push_back(fmt::format("{}: {}", part.name, what));
        if (!casts) dropped = {};
        scene.dropped.repeatedVertex += dropped.repeatedVertex;
        scene.dropped.flat.insert(scene.dropped.flat.end(), dropped.flat.begin(), dropped.flat.end());
        if (!part.mesh.triangles.empty()) scene.objects.push_back(std::move(part));
    }
}

void readObject(const Table& table, Budget& budget, Scene& scene) {
    Dropped unmoved;
    const Repeat repeat = readRepeat(table);
    const std::vector<Object> parts = readShape(table, repeat.count, budget, scene.notes, unmoved);
    const std::string name = table.text("name", table.text("shape"));
    const glm::dvec3 at = table.vector("at", glm::dvec3(0));
    for (int i = 0; i < repeat.count; ++i)
        addObject(table, parts, unmoved, repeat.count == 1 ? name : fmt::format("{} {}", name, i + 1),
                  at + double(i) * repeat.step, scene);
}

/// The key of a flag of the command line.
std::string keyOf(std::string_view flag) {
    std::string key(flag);
    std::replace(key.begin(), key.end(), '-', '_');
    return key;
}

HardCell readHardCell(const Table& table, bool fails) {
    std::vector<std::string> optionKeys;
    for (const std::string_view flag : hardOptions()) optionKeys.push_back(keyOf(flag));
    std::vector<std::string_view> keys{"method", "profile", "fidelity", "dither", "frame", "size"};
    if (fails) keys.push_back("cause");
    keys.insert(keys.end(), optionKeys.begin(), optionKeys.end());
    table.allow(keys, fails ? "a cell of 'fails'" : "a cell of 'exact'");

    HardCell cell{.method = table.text("method"), .line = table.line()};
    cell.profile = table.text("profile", cell.profile);
    cell.fidelity = table.text("fidelity", cell.fidelity);
    if (cell.fidelity != "gl" && cell.fidelity != "chip")
        table.bad(table.need("fidelity"), "'fidelity' must be gl or chip");
    cell.dithers = table.flag("dither", false);
    cell.frame = table.integer("frame", 0, 99'999, 0);
    if (table.has("size")) {
        const auto size = table.numbers<2>("size", 1, 8192);
        cell.width = int(size[0]), cell.height = int(size[1]);
    }
    for (const std::string_view flag : hardOptions())
        if (const std::string key = keyOf(flag); table.has(key)) cell.options.emplace(flag, table.word(key));
    if (!fails) return cell;
    cell.cause = table.text("cause");
    if (cell.cause.empty()) table.bad(table.need("cause"), "'cause' must not be empty");
    return cell;
}

HardCase readHardCase(const Table& table) {
    table.allow({"family", "what", "source", "fails", "exact"}, "[hard]");
    HardCase hard;
    const auto line = [&](std::string_view key) {
        std::string text = table.text(key);
        if (text.empty()) table.bad(table.need(key), fmt::format("'{}' must be one line", key));
        return text;
    };
    hard.family = line("family"), hard.what = line("what"), hard.source = line("source");
    for (const Table& cell : table.tables("fails")) hard.fails.push_back(readHardCell(cell, true));
    for (const Table& cell : table.tables("exact")) hard.exact.push_back(readHardCell(cell, false));
    return hard;
}

Scene readScene(const std::filesystem::path& file, const toml::table& root, const SceneLimits& limits) {
    const Table table(file, root);
    table.allow({"title", "ambient", "background", "light", "lights", "camera", "objects", "hard"},
                "a scene");
    Scene scene;
    scene.id = sceneIdOf(file);
    scene.title = table.text("title", scene.id);
    scene.ambient = float(table.number("ambient", 0, 1, scene.ambient));
    scene.background = table.colour("background", scene.background);
    if (table.has("light") == table.has("lights")) table.bad("a scene needs either [light] or [[lights]]");
    if (table.has("light")) scene.lights.push_back(readLight(table.table("light")));
    if (table.has("lights"))
        for (const Table& light : table.tables("lights")) scene.lights.push_back(readLight(light));
    scene.frames = readCamera(table.table("camera"));
    const std::vector<Table> objects = table.tables("objects");
    Budget budget(limits);
    for (const Table& object : objects) readObject(object, budget, scene);
    if (scene.objects.empty() && !objects.empty()) table.bad("no triangle left");
    if (table.has("hard")) scene.hard = readHardCase(table.table("hard"));
    return scene;
}

}  // namespace

Scene loadSceneFile(const std::filesystem::path& file, const SceneLimits& limits) {
    const std::string text = readWhole(file, limits.tomlBytes);
    if (const std::size_t line = lineOfDeepKey(text); line > 0)
        fail(file, line, fmt::format("a key of more than {} parts", kMostKeyParts));
    toml::table root;
    try {
        root = toml::parse(text);
    } catch (const toml::parse_error& error) {
        fail(file, error.source().begin.line, printable(error.description()));
    }
    return readScene(file, root, limits);
}

}  // namespace gnomon
