#include "scene/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <set>

#include "scene/text.h"
#include "scene/weld.h"

// glTF 2.0 specification (Khronos, 2021): https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html; section
// numbers below are its.

namespace gnomon {
namespace {

using nlohmann::json;

// Recursive readers run out of stack beyond some depth.
constexpr std::size_t kDeepestJson = 200;
constexpr int kDeepestNode = 1000;

std::uint32_t wordAt(std::string_view data, std::size_t offset) {
    std::uint32_t word = 0;
    for (int k = 3; k >= 0; --k) word = word << 8 | static_cast<unsigned char>(data[offset + std::size_t(k)]);
    return word;
}

struct Container {
    std::string_view text{};
    std::optional<std::string_view> binary{};
};

/// Section 4.4, GLB file format.
Container openGlb(const std::filesystem::path& file, std::string_view data) {
    constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
    if (data.size() < 12 || !data.starts_with("glTF"))
        fail(file, "no GLB file, it doesn't start with \"glTF\"");
    if (wordAt(data, 4) != 2) fail(file, fmt::format("glTF version {}, not 2", wordAt(data, 4)));
    if (wordAt(data, 8) > data.size())
        fail(file, fmt::format("truncated: announces {} bytes, has {}", wordAt(data, 8), data.size()));
    data = data.substr(0, wordAt(data, 8));

    Container container;
    for (std::size_t at = 12, chunk = 0; at < data.size(); ++chunk) {
        if (data.size() - at < 8) fail(file, fmt::format("chunk {} ends in its header", chunk));
        const std::size_t length = wordAt(data, at);
        const std::uint32_t type = wordAt(data, at + 4);
        if (length > data.size() - at - 8)
            fail(file, fmt::format("chunk {} announces {} bytes, the file has {} left", chunk, length,
                                   data.size() - at - 8));
        const std::string_view content = data.substr(at + 8, length);
        if (chunk == 0 && type != kJson) fail(file, "the first chunk is no JSON");
        if (chunk == 0) container.text = content;
        if (chunk == 1 && type == kBinary) container.binary = content;
        at += 8 + (length + 3) / 4 * 4;
    }
    if (container.text.empty()) fail(file, "no JSON chunk");
    return container;
}

/// Looks through a JSON text, and remembers what it has too much of. json::parse() can be told to do that,
/// too, but then takes time with the square of an array's length.
class JsonShape : public nlohmann::json_sax<json> {
  public:
    explicit JsonShape(std::uint64_t mostValues) : m_mostValues(mostValues) {}

    const std::string& fault() const { return m_fault; }

    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t&) override { return value(); }
    bool string(string_t&) override { return value(); }
    bool binary(binary_t&) override { return value(); }
    bool start_array(std::size_t) override { return begin(); }
    bool end_array() override { return end(); }
    bool start_object(std::size_t) override { return begin(); }
    bool end_object() override { return end(); }
    bool key(string_t& name) override {
        // Parsers do not agree on which of them counts.
        if (!m_keys.back().insert(name).second)
            return refuse(fmt::format("the JSON has a key '{}' twice", printable(name)));
        return value();
    }
    bool parse_error(std::size_t, const std::string&, const json::exception&) override {
        return false;  // json::parse() comes to it, too
    }

  private:
    bool refuse(std::string fault) {
        m_fault = std::move(fault);
        return false;
    }
    bool value() { return ++m_values <= m_mostValues || refuse(moreThan(m_mostValues, "JSON values")); }
    bool begin() {
        m_keys.emplace_back();
        if (m_keys.size() > kDeepestJson)
            return refuse(fmt::format("JSON nested deeper than {}", kDeepestJson));
        return value();
    }
    bool end() {
        m_keys.pop_back();
        return true;
    }

    std::uint64_t m_mostValues, m_values = 0;
    std::vector<std::set<std::string>> m_keys{};  ///< of the objects that are open; arrays have none
    std::string m_fault{};
};

json parseJson(const std::filesystem::path& file, std::string_view text, bool hasLines,
               std::uint64_t mostValues) {
    JsonShape shape(mostValues);
    json::sax_parse(text, &shape);
    if (!shape.fault().empty()) fail(file, shape.fault());
    try {
        return json::parse(text);
    } catch (const json::parse_error& error) {
        if (!hasLines) fail(file, fmt::format("bad JSON at byte {} of its chunk", error.byte));
        const auto end = text.begin() + std::ptrdiff_t(std::min(error.byte, text.size()));
        const auto line = 1 + std::count(text.begin(), end, '\n');
        fail(file, std::size_t(line), fmt::format("bad JSON at byte {}", error.byte));
    }
}

std::string decodeBase64(std::string_view text) {
    std::string out;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        int value = -1;
        if (c >= 'A' && c <= 'Z') value = c - 'A';
        if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
        if (c >= '0' && c <= '9') value = c - '0' + 52;
        if (c == '+' || c == '-') value = 62;
        if (c == '/' || c == '_') value = 63;
        if (value < 0) continue;
        bits = bits << 6 | std::uint32_t(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        out += char(bits >> count & 0xff);
    }
    return out;
}

std::string decodePercent(std::string_view uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned code = 0;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(uri.data() + i + 1, uri.data() + i + 3, code, 16).ptr == uri.data() + i + 3) {
            out += char(code);
            i += 2;
        } else {
            out += uri[i];
        }
    }
    return out;
}

/// The file as a graph whose references have been checked.
class Document {
  public:
    Document(const std::filesystem::path& file, std::string_view data, const SceneLimits& limits)
        : m_file(file), m_limits(limits) {
        const bool binary = data.starts_with("glTF") || file.extension() == ".glb";
        const Container container = binary ? openGlb(file, data) : Container{.text = data};
        m_root = parseJson(file, container.text, !binary, limits.jsonValues);
        if (!m_root.is_object()) fail(file, "the JSON is no object");
        const std::string version = m_root.contains("asset") ? m_root["asset"].value("version", "") : "";
        if (!version.starts_with("2.")) fail(file, "asset.version isn't 2.x");
        checkExtensions();
        loadBuffers(container);
        checkViews();
        checkAccessors();
        checkMeshes();
        checkLights();
        checkCameras();
        checkNodes();
    }

    GltfFacts facts() {
        m_facts.materials = array(m_root, "materials").size();
        const json& scenes = array(m_root, "scenes");
        if (scenes.empty()) fail(m_file, "no scene, so nothing to show");
        const std::size_t scene = index(m_root, "scene", scenes.size(), "the file").value_or(0);
        std::vector<bool> isRoot(array(m_root, "nodes").size());
        for (const json& node : array(scenes[scene], "nodes")) {
            const std::size_t root = checked(node, isRoot.size(), "scene", "node");
            if (isRoot[root]) bad(fmt::format("scene names node {} twice", root));
            if (m_isChild[root]) bad(fmt::format("scene names node {}, which is no root", root));
            isRoot[root] = true;
            walk(root, glm::dmat4(1));
        }
        if (m_orthographic > 0)
            m_facts.notes.push_back(fmt::format("{} orthographic camera{} skipped", m_orthographic,
                                                m_orthographic == 1 ? "" : "s"));
        if (m_spots > 0)
            m_facts.notes.push_back(fmt::format("{} spot light{} taken as point light{}", m_spots,
                                                m_spots == 1 ? "" : "s", m_spots == 1 ? "" : "s"));
        if (!array(m_root, "animations").empty()) m_facts.notes.push_back("animations ignored");
        if (!array(m_root, "skins").empty()) m_facts.notes.push_back("skins ignored");
        return m_facts;
    }

  private:
    struct CountedMesh {
        MeshFacts facts{};
        std::uint64_t corners = 0;
    };

    [[noreturn]] void bad(std::string_view what) const { fail(m_file, what); }

    const json& array(const json& object, const char* key) const {
        static const json kEmpty = json::array();
        const auto found = object.find(key);
        if (found == object.end()) return kEmpty;
        if (!found->is_array()) bad(fmt::format("'{}' is no array", key));
        return *found;
    }

    std::size_t checked(const json& value, std::size_t count, std::string_view who,
                        std::string_view key) const {
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
            bad(fmt::format("{} names {} {}, of {}", who, key, printable(value.dump()), count));
        return value.get<std::size_t>();
    }

    std::optional<std::size_t> index(const json& object, const char* key, std::size_t count,
                                     std::string_view who) const {
        const auto found = object.find(key);
        if (found == object.end()) return {};
        return checked(*found, count, who, key);
    }

    std::uint64_t amount(const json& object, const char* key, std::string_view who,
                         std::optional<std::uint64_t> otherwise = {}) const {
        const auto found = object.find(key);
        if (found == object.end() && otherwise) return *otherwise;
        if (found == object.end() || !found->is_number_unsigned())
            bad(fmt::format("{} has no valid {}", who, key));
        return found->get<std::uint64_t>();
    }

    void checkExtensions() const {
        for (const json& name : array(m_root, "extensionsRequired")) {
            const std::string text = name.get<std::string>();
            if (text == "KHR_lights_punctual" || text.starts_with("KHR_materials_") ||
                text.starts_with("KHR_texture_"))
                continue;
            bad(fmt::format("needs the extension {}, unknown here", printable(text)));
        }
    }

    void loadBuffers(const Container& container) {
        const json& buffers = array(m_root, "buffers");
        std::uint64_t room = m_limits.meshBytes;
        for (std::size_t b = 0; b < buffers.size(); ++b) {
            const std::string who = fmt::format("buffer {}", b);
            const std::uint64_t length = amount(buffers[b], "byteLength", who);
            const std::string uri = buffers[b].value("uri", "");
            std::string bytes;
            if (uri.empty()) {
                if (b != 0 || !container.binary) bad(who + " has neither a uri nor a binary chunk");
                bytes = *container.binary;
            } else if (uri.starts_with("data:")) {
                const std::size_t comma = uri.find(',');
                if (comma == std::string::npos) bad(who + " has a bad data uri");
                bytes = decodeBase64(std::string_view(uri).substr(comma + 1));
            } else {
                const std::string name = decodePercent(uri);
                const auto file = m_file.parent_path() / name;
                std::error_code error;
                const std::uint64_t size = std::filesystem::file_size(file, error);
                if (!error && size > room)
                    bad(fmt::format("{} of {} bytes, with which the buffers have {}", who, size,
                                    moreThan(m_limits.meshBytes, "bytes")));
                try {
                    bytes = readWhole(file, room);
                } catch (const SceneError&) {
                    bad(fmt::format("buffer file '{}' is missing or can't be read", printable(name)));
                }
            }
            if (bytes.size() < length)
                bad(fmt::format("{} announces {} bytes, has {}", who, length, bytes.size()));
            bytes.resize(length);
            room -= std::min<std::uint64_t>(room, length);
            m_buffers.push_back(std::move(bytes));
        }
    }

    void checkViews() const {
        const json& views = array(m_root, "bufferViews");
        for (std::size_t v = 0; v < views.size(); ++v) {
            const std::string who = fmt::format("buffer view {}", v);
            const auto buffer = index(views[v], "buffer", m_buffers.size(), who);
            if (!buffer) bad(who + " names no buffer");
            const std::uint64_t offset = amount(views[v], "byteOffset", who, 0);
            const std::uint64_t length = amount(views[v], "byteLength", who);
            const std::uint64_t size = m_buffers[*buffer].size();
            if (offset > size || length > size - offset)
                bad(fmt::format("{} ends past buffer {} of {} bytes", who, *buffer, size));
            if (amount(views[v], "byteStride", who, 0) > 252) bad(who + " has a byteStride over 252");
        }
    }

    /// Of all meshes, and of all their instances: vertices, or the indices of them where those are more.
    std::uint64_t mostCorners() const { return 3 * m_limits.triangles; }

    /// Counts corners for which there is memory or time to be taken.
    void takeCorners(std::uint64_t& sum, std::uint64_t corners) const {
        sum += corners;
        if (sum > mostCorners()) bad(moreThan(mostCorners(), "vertices"));
    }

    std::uint64_t componentSize(const json& accessor, std::string_view who) const {
        switch (amount(accessor, "componentType", who)) {
            case 5120:
            case 5121:
                return 1;
            case 5122:
            case 5123:
                return 2;
            case 5125:
            case 5126:
                return 4;
            default:
                bad(fmt::format("{} has no valid componentType", who));
        }
    }

    std::uint64_t elementSize(const json& accessor, std::string_view who) const {
        const std::string type = accessor.value("type", "");
        constexpr std::pair<std::string_view, int> kTypes[] = {
            {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
        for (const auto& [name, components] : kTypes)
            if (type == name) return std::uint64_t(components) * componentSize(accessor, who);
        bad(fmt::format("{} has no valid type", who));
    }

    /// @p count values of @p size bytes at an offset of a buffer view lie inside of it.
    void checkRange(const json& object, std::uint64_t count, std::uint64_t size, std::string_view who) const {
        const json& views = array(m_root, "bufferViews");
        const auto v = index(object, "bufferView", views.size(), who);
        if (!v) return;
        const std::uint64_t length = amount(views[*v], "byteLength", who);
        const std::uint64_t stride = amount(views[*v], "byteStride", who, 0);
        const std::uint64_t step = stride == 0 ? size : stride;
        const std::uint64_t offset = amount(object, "byteOffset", who, 0);
        if (step < size) bad(fmt::format("{} has values that overlap", who));
        if (count == 0) return;
        if (offset > length || size > length - offset || (count - 1) > (length - offset - size) / step)
            bad(fmt::format("{} ends past buffer view {} of {} bytes", who, *v, length));
    }

    void checkAccessors() const {
        const std::uint64_t most = mostCorners();
        std::uint64_t changed = 0;
        const json& accessors = array(m_root, "accessors");
        for (std::size_t a = 0; a < accessors.size(); ++a) {
            const std::string who = fmt::format("accessor {}", a);
            const std::uint64_t count = amount(accessors[a], "count", who);
            if (count > most) bad(fmt::format("{} announces {} values, {}", who, count, moreThan(most)));
            checkRange(accessors[a], count, elementSize(accessors[a], who), who);
            const auto sparse = accessors[a].find("sparse");
            if (sparse == accessors[a].end()) continue;
            const std::uint64_t changes = amount(*sparse, "count", who);
            takeCorners(changed, changes);
            const json& where = sparse->at("indices");
            checkRange(where, changes, componentSize(where, who), who + "'s sparse indices");
            checkRange(sparse->at("values"), changes, elementSize(accessors[a], who),
                       who + "'s sparse values");
            forIntegers(where, changes, who, [&](std::uint64_t, std::uint64_t value) {
                if (value >= count)
                    bad(fmt::format("{}: sparse index {} is out of range, {} values", who, value, count));
            });
        }
    }

    /// Calls @p each with the position and value of @p count unsigned integers. @pre ranges are checked
    template <typename Each>
    void forIntegers(const json& object, std::uint64_t count, std::string_view who, const Each& each) const {
        const std::uint64_t size = componentSize(object, who);
        const auto found = object.find("bufferView");
        if (found == object.end()) return;
        const json& view = array(m_root, "bufferViews")[found->get<std::size_t>()];
        const std::uint64_t stride = view.value("byteStride", std::uint64_t(0));
        const std::string& bytes = m_buffers[view["buffer"].get<std::size_t>()];
        std::uint64_t at =
            view.value("byteOffset", std::uint64_t(0)) + object.value("byteOffset", std::uint64_t(0));
        for (std::uint64_t i = 0; i < count; ++i, at += stride == 0 ? size : stride) {
            std::uint64_t value = 0;
            for (std::uint64_t k = size; k-- > 0;)
                value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
            each(i, value);
        }
    }

    void checkIndices(const json& accessor, std::uint64_t vertices, std::string_view who) const {
        const std::uint64_t type = amount(accessor, "componentType", who);
        if (accessor["type"] != "SCALAR" || (type != 5121 && type != 5123 && type != 5125))
            bad(fmt::format("{} has indices that are no unsigned integers", who));
        if (accessor.contains("sparse")) bad(fmt::format("{} has sparse indices", who));
        forIntegers(accessor, amount(accessor, "count", who), who, [&](std::uint64_t i, std::uint64_t value) {
            if (value >= vertices)
                bad(fmt::format("{}: index {} at {} is out of range, {} vertices", who, value, i, vertices));
        });
    }

    void checkMeshes() {
        const json& meshes = array(m_root, "meshes");
        const json& accessors = array(m_root, "accessors");
        std::uint64_t inMeshes = 0;
        for (std::size_t m = 0; m < meshes.size(); ++m) {
            CountedMesh mesh;
            const json& primitives = array(meshes[m], "primitives");
            for (std::size_t p = 0; p < primitives.size(); ++p) {
                const json& primitive = primitives[p];
                const std::string who = fmt::format("mesh {}, primitive {}", m, p);
                index(primitive, "material", array(m_root, "materials").size(), who);
                if (!primitive.contains("attributes")) bad(who + " has no attributes");
                for (const auto& [name, accessor] : primitive["attributes"].items())
                    checked(accessor, accessors.size(), who, "accessor");
                const auto position = index(primitive["attributes"], "POSITION", accessors.size(), who);
                if (!position) bad(who + " has no positions");
                const json& positions = accessors[*position];
                if (positions["type"] != "VEC3" || positions["componentType"] != 5126)
                    bad(who + " has positions that aren't three floats");
                std::uint64_t corners = amount(positions, "count", who);
                for (const auto& [name, accessor] : primitive["attributes"].items())
                    if (amount(accessors[accessor.get<std::size_t>()], "count", who) != corners)
                        bad(fmt::format("{} has attributes of different lengths", who));
                std::uint64_t most = corners;
                if (const auto indices = index(primitive, "indices", accessors.size(), who)) {
                    // Before they are looked at: many primitives may share them.
                    corners = amount(accessors[*indices], "count", who);
                    most = std::max(most, corners);
                    takeCorners(inMeshes, most);
                    checkIndices(accessors[*indices], amount(positions, "count", who), who);
                } else {
                    takeCorners(inMeshes, most);
                }
                mesh.corners += most;
                const std::uint64_t mode = amount(primitive, "mode", who, 4);
                if (mode > 6) bad(fmt::format("{} has mode {}", who, mode));
                if (mode < 4) {
                    ++mesh.facts.otherPrimitives;
                } else if (corners < 3 || (mode == 4 && corners % 3 != 0)) {
                    bad(fmt::format("{} has {} corners, no whole triangles", who, corners));
                } else {
                    mesh.facts.triangles += mode == 4 ? corners / 3 : corners - 2;
                }
            }
            m_meshes.push_back(mesh);
        }
    }

    glm::dvec3 vectorOf(const json& values, std::string_view who) const {
        if (!values.is_array() || values.size() != 3) bad(fmt::format("{} are not three numbers", who));
        return {values[0].get<double>(), values[1].get<double>(), values[2].get<double>()};
    }

    void checkLights() {
        constexpr double kMostLight = 1e6;  // files go beyond the 1 of KHR_lights_punctual
        if (!m_root.contains("extensions")) return;
        const json& extensions = m_root["extensions"];
        if (!extensions.contains("KHR_lights_punctual")) return;
        m_lights = array(extensions["KHR_lights_punctual"], "lights");
        for (std::size_t l = 0; l < m_lights.size(); ++l) {
            const std::string who = fmt::format("light {}", l);
            const std::string type = m_lights[l].value("type", "");
            if (type != "point" && type != "spot" && type != "directional")
                bad(fmt::format("{} has no valid type", who));
            if (m_lights[l].contains("color")) {
                const glm::dvec3 colour = vectorOf(m_lights[l]["color"], who + "'s color");
                for (int k = 0; k < 3; ++k)
                    if (!(colour[k] >= 0 && colour[k] <= kMostLight))
                        bad(fmt::format("{} has a color of {}", who, colour[k]));
            }
            if (type != "spot") continue;
            const json spot = m_lights[l].value("spot", json::object());
            const double inner = spot.value("innerConeAngle", 0.0);
            const double outer = spot.value("outerConeAngle", std::numbers::pi / 4);
            // Exporters round a right angle to float.
            if (!(inner >= 0 && inner < outer && outer <= std::numbers::pi / 2 + 1e-6))
                bad(fmt::format("{} has invalid cone angles, inner {} and outer {}", who, inner, outer));
        }
    }

    void checkCameras() const {
        const json& cameras = array(m_root, "cameras");
        for (std::size_t c = 0; c < cameras.size(); ++c) {
            const std::string type = cameras[c].value("type", "");
            const std::string who = fmt::format("camera {}", c);
            if (type == "orthographic") continue;
            if (type != "perspective" || !cameras[c].contains("perspective")) bad(who + " has no valid type");
            const double fov = cameras[c]["perspective"].value("yfov", 0.0);
            const double near = cameras[c]["perspective"].value("znear", 0.0);
            const double degrees = glm::degrees(fov);
            if (!(degrees >= 0.01 && degrees <= 179)) bad(fmt::format("{} has a yfov of {}", who, fov));
            if (!(near > 0)) bad(fmt::format("{} has a znear of {}", who, near));
        }
    }

    /// Each node has one parent at most, and none is its own ancestor (section 3.5.2).
    void checkNodes() {
        const json& nodes = array(m_root, "nodes");
        constexpr std::size_t kRoot = std::size_t(-1);
        std::vector<std::size_t> parent(nodes.size(), kRoot);
        m_isChild.resize(nodes.size());
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            const std::string who = fmt::format("node {}", n);
            index(nodes[n], "mesh", m_meshes.size(), who);
            index(nodes[n], "camera", array(m_root, "cameras").size(), who);
            lightOf(nodes[n], who);
            for (const json& child : array(nodes[n], "children")) {
                const std::size_t c = checked(child, nodes.size(), who, "child");
                if (parent[c] != kRoot)
                    bad(fmt::format("node {} has two parents, {} and {}", c, parent[c], n));
                parent[c] = n;
                m_isChild[c] = true;
            }
        }
        // With one parent each, a node that never comes to a root is on a cycle or below one.
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            int steps = 0;
            for (std::size_t at = n; at != kRoot; at = parent[at], ++steps) {
                if (std::size_t(steps) > nodes.size()) {
                    bad(fmt::format("node {} is its own ancestor, or below one that is", n));
                } else if (steps > kDeepestNode) {
                    bad(fmt::format("node {} is nested deeper than {}, or below a cycle", n, kDeepestNode));
                }
            }
        }
    }

    std::optional<std::size_t> lightOf(const json& node, std::string_view who) const {
        const auto extensions = node.find("extensions");
        if (extensions == node.end()) return {};
        const auto light = extensions->find("KHR_lights_punctual");
        if (light == extensions->end()) return {};
        return index(*light, "light", m_lights.size(), who);
    }

    std::vector<double> numbers(const json& node, const char* key, std::size_t count,
                                std::vector<double> otherwise) const {
        const json& values = array(node, key);
        if (values.empty()) return otherwise;
        if (values.size() != count)
            bad(fmt::format("'{}' has {} numbers, not {}", key, values.size(), count));
        return values.get<std::vector<double>>();
    }

    glm::dmat4 localMatrix(const json& node) const {
        const auto m = numbers(node, "matrix", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
        const auto t = numbers(node, "translation", 3, {0, 0, 0});
        const auto r = numbers(node, "rotation", 4, {0, 0, 0, 1});
        const auto s = numbers(node, "scale", 3, {1, 1, 1});
        if (node.contains("matrix")) {
            glm::dmat4 matrix;
            for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = m[std::size_t(i)];
            return matrix;
        }
        glm::dmat4 matrix = glm::mat4_cast(glm::dquat(r[3], r[0], r[1], r[2]));
        for (int k = 0; k < 3; ++k) matrix[k] *= s[std::size_t(k)];
        matrix[3] = glm::dvec4(t[0], t[1], t[2], 1);
        return matrix;
    }

    void walk(std::size_t n, const glm::dmat4& worldFromParent) {
        const json& node = array(m_root, "nodes")[n];
        const std::string who = fmt::format("node {}", n);
        const glm::dmat4 worldFromNode = worldFromParent * localMatrix(node);
        if (const auto mesh = index(node, "mesh", m_meshes.size(), who)) {
            m_facts.mesh.triangles += m_meshes[*mesh].facts.triangles;
            m_facts.mesh.otherPrimitives += m_meshes[*mesh].facts.otherPrimitives;
            takeCorners(m_instanced, m_meshes[*mesh].corners);
            if (m_facts.mesh.triangles > m_limits.triangles) bad(moreThan(m_limits.triangles, "triangles"));
        }
        if (const auto light = lightOf(node, who)) addLight(m_lights[*light], worldFromNode, who);
        if (const auto camera = index(node, "camera", array(m_root, "cameras").size(), who))
            addCamera(array(m_root, "cameras")[*camera], worldFromNode, who);
        for (const json& child : array(node, "children")) walk(child.get<std::size_t>(), worldFromNode);
    }

    glm::dvec3 direction(const glm::dvec4& v, std::string_view who) const {
        constexpr double kShortest = 1e-18;  // its square has all of its digits
        const double length = glm::length(glm::dvec3(v));
        if (!(length > kShortest) || !std::isfinite(length))
            bad(fmt::format("{} has a transform without a direction", who));
        return glm::dvec3(v) / length;
    }

    glm::dvec3 position(const glm::dmat4& worldFromNode, std::string_view who) const {
        for (int k = 0; k < 3; ++k)
            if (const std::string fault = coordinateFault(worldFromNode[3][k]); !fault.empty())
                bad(fmt::format("{}: {}", who, fault));
        return glm::dvec3(worldFromNode[3]);
    }

    void addLight(const json& light, const glm::dmat4& worldFromNode, std::string_view who) {
        const std::string type = light["type"];
        if (type == "spot") ++m_spots;
        // A light shines along -z (KHR_lights_punctual), so +z leads to it.
        const glm::dvec4 place = type == "directional" ? glm::dvec4(direction(worldFromNode[2], who), 0)
                                                       : glm::dvec4(position(worldFromNode, who), 1);
        const glm::dvec3 colour = light.contains("color") ? vectorOf(light["color"], "color") : glm::dvec3(1);
        m_facts.lights.push_back({.position = glm::vec4(place), .colour = glm::vec3(colour)});
    }

    void addCamera(const json& camera, const glm::dmat4& worldFromNode, std::string_view who) {
        if (camera["type"] == "orthographic") {
            ++m_orthographic;
            return;
        }
        const glm::dvec3 eye = position(worldFromNode, who);
        // As far ahead as float needs to keep the direction.
        const double ahead = std::max(1.0, glm::length(eye));
        m_facts.cameras.push_back(
            {.eye = glm::vec3(eye),
             .target = glm::vec3(eye - ahead * direction(worldFromNode[2], who)),
             .up = glm::vec3(direction(worldFromNode[1], who)),
             .fovDegrees = float(glm::degrees(camera["perspective"]["yfov"].get<double>())),
             .nearPlane = camera["perspective"]["znear"].get<float>()});
    }

    const std::filesystem::path& m_file;
    const SceneLimits m_limits;
    json m_root{};
    json m_lights = json::array();
    std::vector<std::string> m_buffers{};
    std::vector<CountedMesh> m_meshes{};
    std::vector<bool> m_isChild{};
    std::uint64_t m_instanced = 0;  ///< corners
    std::size_t m_orthographic = 0, m_spots = 0;
    GltfFacts m_facts{};
};

}  // namespace

GltfFacts readGltf(const std::filesystem::path& file, std::string_view data, const SceneLimits& limits) {
    try {
        return Document(file, data, limits).facts();
    } catch (const json::exception& error) {
        fail(file, fmt::format("bad glTF: {}", printable(error.what())));
    }
}

}  // namespace gnomon
