#include "scene/mesh_file.h"

#include <assimp/GltfMaterial.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>

#include "scene/gltf.h"
#include "scene/mesh_check.h"
#include "scene/parsed_apart.h"
#include "scene/text.h"
#include "scene/weld.h"

namespace gnomon {
namespace {

std::string extensionOf(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return char(std::tolower(static_cast<unsigned char>(c))); });
    return extension;
}

glm::dmat4 matrixOf(const aiMatrix4x4& m) {
    return glm::transpose(glm::dmat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4,
                                     m.d1, m.d2, m.d3, m.d4));
}

/// Turns Assimp's node tree into objects.
class Importer {
  public:
    /// @param materials of the file; Assimp's own default comes after them
    Importer(const std::filesystem::path& file, const SceneLimits& limits, const aiScene& scene,
             std::size_t materials, MeshFile& out)
        : m_file(file), m_limits(limits), m_scene(scene), m_materials(materials), m_out(out) {}

    void run(const MeshFacts& facts) {
        walk(*m_scene.mRootNode, glm::dmat4(1));
        if (m_triangles != facts.triangles)
            fail(m_file,
                 fmt::format("{} triangles in the file, but {} could be read", facts.triangles, m_triangles));
        if (facts.otherPrimitives > 0)
            m_out.notes.push_back(fmt::format("{} point or line primitive{} ignored", facts.otherPrimitives,
                                              facts.otherPrimitives == 1 ? "" : "s"));
        if (const std::string dropped = describe(m_out.dropped); !dropped.empty())
            m_out.notes.push_back(dropped);
        if (m_empty > 0)
            m_out.notes.push_back(
                fmt::format("{} mesh{} without a triangle left dropped", m_empty, m_empty == 1 ? "" : "es"));
        if (m_out.objects.empty()) fail(m_file, "no triangle left");
    }

  private:
    void walk(const aiNode& node, const glm::dmat4& worldFromParent) {
        const glm::dmat4 worldFromNode = worldFromParent * matrixOf(node.mTransformation);
        for (unsigned m = 0; m < node.mNumMeshes; ++m)
            addObject(*m_scene.mMeshes[node.mMeshes[m]], worldFromNode, node.mName.C_Str());
        for (unsigned c = 0; c < node.mNumChildren; ++c) walk(*node.mChildren[c], worldFromNode);
    }

    void addObject(const aiMesh& mesh, const glm::dmat4& worldFromNode, const char* nodeName) {
        Object object;
        object.name = printable(mesh.mName.length > 0 ? mesh.mName.C_Str() : nodeName);
        std::vector<glm::vec3> positions(mesh.mNumVertices);
        for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
            const aiVector3D& p = mesh.mVertices[v];
            const glm::dvec3 world(worldFromNode * glm::dvec4(p.x, p.y, p.z, 1));
            for (int k = 0; k < 3; ++k)
                if (const std::string fault = coordinateFault(world[k]); !fault.empty())
                    fail(m_file, fmt::format("mesh '{}', vertex {}: {}", object.name, v, fault));
            positions[v] = glm::vec3(world);
        }
        std::vector<glm::uvec3> triangles;
        triangles.reserve(mesh.mNumFaces);
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const std::span<const unsigned> corners(mesh.mFaces[f].mIndices, mesh.mFaces[f].mNumIndices);
            if (corners.size() < 3) continue;  // a point or line: real faces were checked
            if (std::ranges::any_of(corners, [&](unsigned v) { return v >= mesh.mNumVertices; }))
                fail(m_file, fmt::format("mesh '{}', face {}: index out of range", object.name, f));
            m_steps += triangulate(positions, corners, triangles);
            if (m_steps > m_limits.polygonSteps)
                fail(m_file, fmt::format("mesh '{}', face {}: {}", object.name, f,
                                         moreThan(m_limits.polygonSteps, "steps to cut polygons")));
        }
        m_triangles += triangles.size();
        if (triangles.empty()) return;

        // A mirror turns fronts into backs (glTF 2.0, section 3.7.4).
        if (glm::determinant(glm::dmat3(worldFromNode)) < 0)
            for (glm::uvec3& t : triangles) std::swap(t.y, t.z);
        object.mesh = weld(positions, triangles, m_out.dropped);
        if (object.mesh.triangles.empty()) {
            ++m_empty;
            return;
        }
        readMaterial(mesh, object);
        if (m_out.objects.size() == m_limits.objects) fail(m_file, moreThan(m_limits.objects, "objects"));
        m_out.objects.push_back(std::move(object));
    }

    void readMaterial(const aiMesh& mesh, Object& object) const {
        if (mesh.mMaterialIndex >= m_scene.mNumMaterials || mesh.mMaterialIndex >= m_materials) return;
        const aiMaterial& material = *m_scene.mMaterials[mesh.mMaterialIndex];
        if (material.GetName() == aiString(AI_DEFAULT_MATERIAL_NAME)) return;
        aiColor4D colour(0, 0, 0, 1);
        if (material.Get(AI_MATKEY_BASE_COLOR, colour) != AI_SUCCESS)
            material.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
        const glm::vec3 diffuse = glm::clamp(glm::vec3(colour.r, colour.g, colour.b), 0.0f, 1.0f);
        if (diffuse.x > 0 || diffuse.y > 0 || diffuse.z > 0) object.colour = diffuse;
        int twoSided = 0;
        // Assimp says "two-sided" of every PLY, since the winding there is unknown.
        if (m_out.isGltf && material.Get(AI_MATKEY_TWOSIDED, twoSided) == AI_SUCCESS)
            object.twoSided = twoSided != 0;
    }

    const std::filesystem::path& m_file;
    const SceneLimits& m_limits;
    const aiScene& m_scene;
    std::size_t m_materials;
    MeshFile& m_out;
    std::size_t m_triangles = 0, m_empty = 0;
    std::uint64_t m_steps = 0;
};

MeshFile parse(const std::filesystem::path& file, const SceneLimits& limits) {
    const std::string extension = extensionOf(file);
    const std::string data = readWhole(file, limits.meshBytes);
    if (data.empty()) fail(file, "empty file");

    MeshFile out;
    MeshFacts facts;
    std::size_t materials = 0;  // what Assimp makes up for PLY and STL isn't in the file
    if (extension == ".obj") {
        facts = checkObj(file, data, limits);
        materials = std::size_t(-1);
    }
    if (extension == ".ply") facts = checkPly(file, data, limits);
    if (extension == ".stl") facts = checkStl(file, data, limits);
    if (extension == ".gltf" || extension == ".glb") {
        GltfFacts gltf = readGltf(file, data, limits);
        facts = gltf.mesh;
        materials = gltf.materials;
        out.isGltf = true;
        out.lights = std::move(gltf.lights);
        out.cameras = std::move(gltf.cameras);
        out.notes = std::move(gltf.notes);
    }
    if (facts.triangles == 0) fail(file, "no triangle");

    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file.string(), 0);
    if (scene == nullptr || scene->mRootNode == nullptr) fail(file, printable(importer.GetErrorString()));
    Importer(file, limits, *scene, materials, out).run(facts);
    return out;
}

}  // namespace

bool isMeshFile(const std::filesystem::path& file) {
    const std::string extension = extensionOf(file);
    return extension == ".obj" || extension == ".ply" || extension == ".stl" || extension == ".gltf" ||
           extension == ".glb";
}

MeshFile loadMeshFile(const std::filesystem::path& file, const SceneLimits& limits) {
    return parsedApart(file, [&] { return parse(file, limits); });
}

}  // namespace gnomon
