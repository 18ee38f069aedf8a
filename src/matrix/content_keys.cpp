#include "matrix/content_keys.h"

#include <map>

#include "matrix/cell_json.h"
#include "matrix/digest.h"

namespace gnomon {
namespace {

template <int N>
std::span<const float> numbersOf(const glm::vec<N, float>& v) {
    return {&v[0], std::size_t(N)};
}

void add(Digest& digest, const Object& object) {
    digest.add(object.name);
    digest.add(numbersOf(object.colour));
    digest.add(std::uint8_t(2 * object.casts + object.twoSided));
    digest.add(std::uint64_t(object.mesh.positions.size()));
    for (const glm::vec3& p : object.mesh.positions) digest.add(numbersOf(p));
    digest.add(std::uint64_t(object.mesh.triangles.size()));
    for (const glm::uvec3& t : object.mesh.triangles)
        for (int corner = 0; corner < 3; ++corner) digest.add(std::uint64_t(t[corner]));
}

/// All of a scene but its camera path.
std::uint64_t contentOf(const Scene& scene) {
    Digest digest;
    digest.add(scene.id);
    digest.add(std::uint64_t(scene.objects.size()));
    for (const Object& object : scene.objects) add(digest, object);
    digest.add(std::uint64_t(scene.lights.size()));
    for (const Light& light : scene.lights)
        digest.add(numbersOf(light.position)), digest.add(numbersOf(light.colour));
    digest.add(scene.ambient);
    digest.add(numbersOf(scene.background));
    // Triangles without area can close a mesh.
    for (const auto& flat : scene.dropped.flat)
        for (const glm::vec3& corner : flat) digest.add(numbersOf(corner));
    return digest.value();
}

void add(Digest& digest, const Camera& camera) {
    for (const glm::vec3& v : {camera.eye, camera.target, camera.up}) digest.add(numbersOf(v));
    digest.add(camera.fovDegrees), digest.add(camera.nearPlane);
}

/// Sources are in it: a refusal names them.
std::uint64_t contentOf(const Profile& profile) {
    Digest digest;
    digest.add(profile.id);
    for (const Profile::Fact& fact : profile.facts)
        digest.add(fact.key), digest.add(fact.value), digest.add(fact.source);
    return digest.value();
}

}  // namespace

ContentKeys::ContentKeys(const CellList& list, const RunMaker& maker) : m_list(list) {
    std::map<const Scene*, std::uint64_t> scenes;
    for (const CellGroup& group : list.groups()) {
        const auto [at, isNew] = scenes.try_emplace(group.scene);
        if (isNew) at->second = contentOf(*group.scene);
        Digest digest;
        digest.add(at->second);
        add(digest, group.scene->frames[std::size_t(group.frame)]);
        for (const int number : {group.size.width, group.size.height, group.frame})
            digest.add(std::int64_t(number));
        m_groups.push_back(digest.value());
    }
    for (const Profile& profile : list.request().profiles) m_profiles.push_back(contentOf(profile));
    const std::size_t profiles = list.request().profiles.size();
    for (std::size_t i = 0; list.count() > 0 && i < list.perGroup(); i += profiles) {
        Digest digest;
        digest.add(maker.program);
        digest.add(maker.version), digest.add(maker.driver);
        // The method and how it is drawn: what else a cell has stands above.
        Cell asked = list.blank(i);
        asked.profile.clear(), asked.scene.clear();
        asked.width = asked.height = asked.frame = asked.pixels = 0;
        digest.add(toJson(asked).dump());
        m_questions.push_back(digest.value());
    }
}

std::uint64_t ContentKeys::of(std::size_t place) const {
    Digest digest;
    digest.add(m_groups[place / m_list.perGroup()]);
    digest.add(m_profiles[m_list.profileOf(place)]);
    digest.add(m_questions[place % m_list.perGroup() / m_profiles.size()]);
    return digest.value();
}

}  // namespace gnomon
