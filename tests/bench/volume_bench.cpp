/// What finding shadow volumes costs on one core, beside plain scalar loops for the same in the same run.
///
/// The mesh is a closed torus grid with shared vertices, in grid order or with triangles and vertices
/// shuffled; at each update the light stands elsewhere on a ring of 64. Names are step/order/triangles,
/// "Scalar..." the plain loop to compare with. Times are those of the CPU.
///
/// - Adjacency: which triangle is across each edge; AdjacencyOnce in fresh memory each time
/// - ZPass: facing, sides
/// - ZFail: the same, and the caps as one list of triangles, which the far cap turns round
/// - ZFailVertices: the same, and both caps written out as lists of vertices
/// - Counter: facing, sides of a mesh that needs the signed counter at each edge (two tori in one place)
/// - Finder: SilhouetteFinder, the caps and winding sides of a scene as values in fresh memory
/// - Smoke: fast and plain way on a small mesh, which must agree
///
/// --table prints medians, spreads and ratios to the plain loops.
///
/// bar_ms is what the step may take. Measured before on such a machine, and not here: a million triangles
/// took OGRE 1.12 835 ms for adjacency, 6.5 ms for z-pass and 12.5 ms for z-fail with caps.
#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "bench/run_benchmarks.h"
#include "bench/table_reporter.h"
#include "bench/torus.h"
#include "volume/caster_mesh.h"
#include "volume/silhouette_finder.h"

namespace gnomon {
namespace {

constexpr int kLights = 64;

enum Order { Grid, Shuffled };

/// Every triangle twice: each edge has four.
Mesh doubled(const Mesh& mesh) {
    Mesh result = mesh;
    result.triangles.insert(result.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    return result;
}

/// Vertices and weights of sides.
using Sides = std::vector<Side>;

/// What a light costs: buffers that stay from one light to the next, as in a program that draws frames.
struct Update {
    Facing facing{};
    std::vector<std::uint32_t> walks{}, caps{};
    std::vector<glm::uvec3> lightCap{}, farCap{};
    Sides sides{};

    void findSides(const CasterMesh& mesh, const glm::vec4& light, const Kernels& with) {
        mesh.face(light, facing, with);
        walks.clear();
        mesh.outline(facing.lit, walks, with);
        sides.clear();
        for (const std::uint32_t walk : walks) sides.push_back({mesh.fromOf(walk), mesh.toOf(walk), 1});
        mesh.count(facing.lit, {}, [&](const Adjacency::Crowded& edge, const CasterMesh::Count& count) {
            const int weight = count.forward - count.backward;
            if (weight == 0) return;
            sides.push_back(weight > 0 ? Side{edge.low, edge.high, weight}
                                       : Side{edge.high, edge.low, -weight});
        });
        benchmark::DoNotOptimize(sides.data());
    }

    void findCaps(const CasterMesh& mesh, const Kernels& with) {
        caps.clear();
        mesh.list(facing.lit, caps, with);
        benchmark::DoNotOptimize(caps.data());
    }

    void writeCaps(const CasterMesh& mesh) {
        lightCap.resize(caps.size());
        farCap.resize(caps.size());
        for (std::size_t i = 0; i < caps.size(); ++i) {
            const glm::uvec3 t = mesh.triangles()[caps[i]];
            lightCap[i] = t;
            farCap[i] = {t.z, t.y, t.x};
        }
        benchmark::DoNotOptimize(lightCap.data());
        benchmark::DoNotOptimize(farCap.data());
    }
};

/// The textbook: edges as records, planes as records, a byte per triangle, a counter per edge.
class Scalar {
  public:
    explicit Scalar(const Mesh& mesh) : m_triangles(mesh.triangles) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edgeOf;
        for (std::uint32_t i = 0; i < m_triangles.size(); ++i) {
            const glm::uvec3 t = m_triangles[i];
            const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
            const glm::dvec3 normal = glm::cross(b - a, c - a);
            m_planes.push_back(glm::vec4(glm::vec3(normal), float(-glm::dot(normal, a))));
            glm::uvec3 edges;
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t from = t[k], to = t[(k + 1) % 3];
                const auto [at, isNew] =
                    edgeOf.try_emplace(std::minmax(from, to), std::uint32_t(m_edges.size()));
                if (isNew) m_edges.push_back({from, to, i, i});
                m_edges[at->second].right = i;
                edges[k] = at->second;
            }
            m_edgesOf.push_back(edges);
        }
        m_counters.resize(m_edges.size());
        m_lit.resize(m_triangles.size());
    }

    void face(const glm::vec4& light) {
        for (std::size_t i = 0; i < m_planes.size(); ++i) m_lit[i] = glm::dot(m_planes[i], light) > 0;
    }

    /// For meshes with two triangles at each edge.
    void findSides() {
        sides.clear();
        for (const Edge& e : m_edges) {
            if (m_lit[e.left] == m_lit[e.right]) continue;
            sides.push_back(m_lit[e.left] ? Side{e.from, e.to, 1} : Side{e.to, e.from, 1});
        }
        benchmark::DoNotOptimize(sides.data());
    }

    void findCaps() {
        lightCap.clear();
        farCap.clear();
        for (std::size_t i = 0; i < m_triangles.size(); ++i) {
            if (!m_lit[i]) continue;
            const glm::uvec3 t = m_triangles[i];
            lightCap.push_back(t);
            farCap.push_back({t.z, t.y, t.x});
        }
        benchmark::DoNotOptimize(lightCap.data());
        benchmark::DoNotOptimize(farCap.data());
    }

    /// Aldridge and Woods, section 2.5.
    void countSides() {
        for (std::size_t i = 0; i < m_triangles.size(); ++i) {
            if (!m_lit[i]) continue;
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t edge = m_edgesOf[i][k];
                m_counters[edge] += m_edges[edge].from == m_triangles[i][k] ? 1 : -1;
            }
        }
        sides.clear();
        for (std::size_t e = 0; e < m_edges.size(); ++e) {
            const int count = std::exchange(m_counters[e], 0);
            if (count > 0) sides.push_back({m_edges[e].from, m_edges[e].to, count});
            if (count < 0) sides.push_back({m_edges[e].to, m_edges[e].from, -count});
        }
        benchmark::DoNotOptimize(sides.data());
    }

    Sides sides{};
    std::vector<glm::uvec3> lightCap{}, farCap{};

  private:
    struct Edge {
        std::uint32_t from, to, left, right;
    };
    std::vector<glm::uvec3> m_triangles;
    std::vector<glm::vec4> m_planes{};
    std::vector<Edge> m_edges{};
    std::vector<glm::uvec3> m_edgesOf{};
    std::vector<int> m_counters{};
    std::vector<unsigned char> m_lit{};
};

/// Meshes and what is made of them, built when first asked for.
class Cache {
  public:
    const Mesh& mesh(std::uint32_t n, Order order) {
        auto& at = m_meshes[{n, order}];
        if (!at) at = std::make_unique<Mesh>(order == Grid ? torusGrid(n) : shuffled(torusGrid(n), 1));
        return *at;
    }
    const Mesh& doubledMesh(std::uint32_t n, Order order) {
        auto& at = m_doubled[{n, order}];
        if (!at) {
            at = std::make_unique<Mesh>(doubled(mesh(n, Grid)));
            if (order == Shuffled) *at = shuffled(*at, 1);
        }
        return *at;
    }

    const CasterMesh& casters(const Mesh& mesh) {
        auto& at = m_casters[&mesh];
        if (!at) at = std::make_unique<CasterMesh>(mesh.positions, mesh.triangles);
        return *at;
    }
    Scalar& scalar(const Mesh& mesh) {
        auto& at = m_scalars[&mesh];
        if (!at) at = std::make_unique<Scalar>(mesh);
        return *at;
    }

  private:
    std::map<std::pair<std::uint32_t, Order>, std::unique_ptr<Mesh>> m_meshes{}, m_doubled{};
    std::map<const Mesh*, std::unique_ptr<CasterMesh>> m_casters{};
    std::map<const Mesh*, std::unique_ptr<Scalar>> m_scalars{};
};

Cache& cache() {
    static Cache kCache;
    return kCache;
}

/// What a step may take for 100,352 triangles and for 1,002,528.
struct Bar {
    double small, large;
    double of(std::uint32_t n) const { return n == 224 ? small : large; }
};
constexpr Bar kAdjacencyBars[]{{2.4, 42}, {9, 180}};  // grid, shuffled
constexpr Bar kZPassBar{0.18, 2.6}, kZFailBar{0.36, 4.2}, kCounterBar{1.1, 11.5};

void adjacencyOf(benchmark::State& state, std::uint32_t n, Order order) {
    const Mesh& mesh = cache().mesh(n, order);
    AdjacencyScratch scratch;
    Adjacency result;
    for (auto _ : state) {
        findAdjacency(mesh.triangles, scratch, result);
        benchmark::DoNotOptimize(result.across.data());
    }
    state.counters["bar_ms"] = kAdjacencyBars[order].of(n);
}

void adjacencyOnce(benchmark::State& state, std::uint32_t n, Order order) {
    const Mesh& mesh = cache().mesh(n, order);
    for (auto _ : state) benchmark::DoNotOptimize(adjacency(mesh.triangles).across.data());
}

/// Sort all walks by edge, pair neighbours.
void scalarAdjacency(benchmark::State& state, std::uint32_t n, Order order) {
    const Mesh& mesh = cache().mesh(n, order);
    for (auto _ : state) {
        std::vector<std::array<std::uint32_t, 3>> walks;
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t a = mesh.triangles[i][k], b = mesh.triangles[i][(k + 1) % 3];
                walks.push_back({std::min(a, b), std::max(a, b), 3 * i + k});
            }
        }
        std::sort(walks.begin(), walks.end());
        std::vector<std::uint32_t> across(walks.size());
        for (std::size_t i = 0; i + 1 < walks.size(); i += 2) {
            across[walks[i][2]] = walks[i + 1][2] / 3;
            across[walks[i + 1][2]] = walks[i][2] / 3;
        }
        benchmark::DoNotOptimize(across.data());
    }
}

template <class Step>
void update(benchmark::State& state, const Mesh& mesh, const Kernels& with, const Step& step, double bar) {
    const CasterMesh& casters = cache().casters(mesh);
    Update buffers;
    int i = 0;
    for (auto _ : state) step(buffers, casters, ringLight(i++ % kLights, kLights), with);
    state.counters["sides"] = double(buffers.sides.size());
    state.counters["bar_ms"] = bar;
    state.counters["bytes_per_triangle"] = double(casters.bytes()) / double(mesh.triangles.size());
}

void finder(benchmark::State& state, std::uint32_t n, Order order) {
    Scene scene;
    scene.objects.push_back({.mesh = cache().mesh(n, order)});
    const SilhouetteFinder silhouettes(scene);
    int i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(
            silhouettes.lit(ringLight(i++ % kLights, kLights), Silhouette::Winding).data());
}

template <class Step>
void scalarUpdate(benchmark::State& state, const Mesh& mesh, const Step& step) {
    Scalar& scalar = cache().scalar(mesh);
    int i = 0;
    for (auto _ : state) {
        scalar.face(ringLight(i++ % kLights, kLights));
        step(scalar);
    }
    state.counters["sides"] = double(scalar.sides.size());
}

void zPass(Update& u, const CasterMesh& mesh, const glm::vec4& light, const Kernels& with) {
    u.findSides(mesh, light, with);
}

void zFail(Update& u, const CasterMesh& mesh, const glm::vec4& light, const Kernels& with) {
    u.findSides(mesh, light, with);
    u.findCaps(mesh, with);
}

void zFailVertices(Update& u, const CasterMesh& mesh, const glm::vec4& light, const Kernels& with) {
    zFail(u, mesh, light, with);
    u.writeCaps(mesh);
}

void registerUpdates(const std::string& tail, std::uint32_t n, Order order, const Kernels& with) {
    const auto add = [&](const char* name, const auto& run) {
        benchmark::RegisterBenchmark((name + tail + "/" + std::string(with.name)).c_str(), run)
            ->Unit(benchmark::kMillisecond);
    };
    add("ZPass",
        [=](benchmark::State& s) { update(s, cache().mesh(n, order), with, zPass, kZPassBar.of(n)); });
    add("ZFail",
        [=](benchmark::State& s) { update(s, cache().mesh(n, order), with, zFail, kZFailBar.of(n)); });
    add("ZFailVertices", [=](benchmark::State& s) {
        update(s, cache().mesh(n, order), with, zFailVertices, kZFailBar.of(n));
    });
    // Half the grid's quads and each twice: as many triangles.
    const auto half = static_cast<std::uint32_t>(std::lround(n / std::sqrt(2.0)));
    add("Counter", [=](benchmark::State& s) {
        update(s, cache().doubledMesh(half, order), with, zPass, kCounterBar.of(n));
    });
}

void registerScalar(const std::string& tail, std::uint32_t n, Order order) {
    const auto add = [&](const char* name, const auto& run) {
        benchmark::RegisterBenchmark((name + tail).c_str(), run)->Unit(benchmark::kMillisecond);
    };
    add("ScalarAdjacency", [=](benchmark::State& s) { scalarAdjacency(s, n, order); });
    add("ScalarZPass", [=](benchmark::State& s) {
        scalarUpdate(s, cache().mesh(n, order), [](Scalar& scalar) { scalar.findSides(); });
    });
    add("ScalarZFailVertices", [=](benchmark::State& s) {
        scalarUpdate(s, cache().mesh(n, order), [](Scalar& scalar) {
            scalar.findSides();
            scalar.findCaps();
        });
    });
    const auto half = static_cast<std::uint32_t>(std::lround(n / std::sqrt(2.0)));
    add("ScalarCounter", [=](benchmark::State& s) {
        scalarUpdate(s, cache().doubledMesh(half, order), [](Scalar& scalar) { scalar.countSides(); });
    });
}

/// Whether the fast and the plain way find as many sides and caps, so that the ratio compares equal work.
void smoke(benchmark::State& state) {
    const Mesh meshes[]{shuffled(torusGrid(20), 2), shuffled(doubled(torusGrid(20)), 2)};
    for (auto _ : state) {
        for (const Mesh& mesh : meshes) {
            const CasterMesh casters(mesh.positions, mesh.triangles);
            Update fast;
            Scalar scalar(mesh);
            zFailVertices(fast, casters, ringLight(5, kLights), kernels().front());
            scalar.face(ringLight(5, kLights));
            scalar.countSides();
            scalar.findCaps();
            if (fast.sides.empty() || fast.sides.size() != scalar.sides.size() ||
                fast.lightCap != scalar.lightCap || fast.farCap != scalar.farCap)
                throw std::logic_error("volume_bench: the two ways differ");
        }
    }
}

/// All names but those of slower kernels.
std::string tableFilter() {
    return "(grid|shuffled)/[0-9]+(/" + std::string(kernels().front().name) + ")?$";
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
    using namespace gnomon;
    benchmark::RegisterBenchmark("Smoke", smoke);
    for (const std::uint32_t n : {224u, 708u}) {
        for (const Order order : {Grid, Shuffled}) {
            const std::string tail =
                std::string(order == Grid ? "/grid/" : "/shuffled/") + std::to_string(2 * n * n);
            benchmark::RegisterBenchmark(("Adjacency" + tail).c_str(), adjacencyOf, n, order)
                ->Unit(benchmark::kMillisecond);
            benchmark::RegisterBenchmark(("AdjacencyOnce" + tail).c_str(), adjacencyOnce, n, order)
                ->Unit(benchmark::kMillisecond);
            benchmark::RegisterBenchmark(("Finder" + tail).c_str(), finder, n, order)
                ->Unit(benchmark::kMillisecond);
            for (const Kernels& with : kernels()) registerUpdates(tail, n, order, with);
            registerScalar(tail, n, order);
        }
    }
    // What the README shows: all steps with the fastest kernels.
    TableReporter reporter;
    return runBenchmarks(argc, argv, reporter, {.repetitions = 9, .filter = "/" + tableFilter()});
}
