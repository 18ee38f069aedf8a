// Masks of 512x512 held against truth: beside them a plain loop that looks around each wrong pixel.

#include "matrix/judge.h"

#include <cmath>
#include <memory>
#include <random>

#include "bench/speed/speed_row.h"
#include "gl/stopwatch.h"

namespace gnomon {
namespace {

enum class MaskIs { Right, MostlyRight, Inverted };

/// A round shadow with a rim of ties, and a mask of it.
struct Judged {
    Judged(MaskIs mask, int size) : truth{.width = size, .height = size} {
        std::mt19937 random(7);
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const double distance = std::hypot(x - 0.5 * size, y - 0.4 * size) - 0.25 * size;
                const bool blocked = distance < 0, away = random() % 50 == 0;
                truth.shadow.push_back(blocked || away ? Shadow::InShadow : Shadow::Lit);
                truth.tie.push_back(std::abs(distance) < 0.3 ? Tie::Truth : Tie::None);
                truth.facesAway.push_back(away);
                truth.blocked.push_back(blocked);
                const bool isWrong =
                    mask == MaskIs::Inverted || (mask == MaskIs::MostlyRight && random() % 100 == 0);
                shadow.push_back(blocked != isWrong);
            }
        }
    }
    Truth truth;
    std::vector<bool> shadow{};
};

bool isNearBoundary(const Truth& truth, int x, int y, int reach) {
    const auto inShadow = [&](int u, int v) {
        return truth.shadow[std::size_t(v) * truth.width + u] == Shadow::InShadow;
    };
    for (int v = std::max(0, y - reach); v <= std::min(truth.height - 1, y + reach); ++v) {
        for (int u = std::max(0, x - reach); u <= std::min(truth.width - 1, x + reach); ++u)
            if (inShadow(u, v) != inShadow(x, y)) return true;
    }
    return false;
}

/// Wrong pixels near the boundary.
int plainEdges(const Judged& of, int reach) {
    int edges = 0;
    for (int y = 0; y < of.truth.height; ++y) {
        for (int x = 0; x < of.truth.width; ++x) {
            const std::size_t i = std::size_t(y) * of.truth.width + x;
            if (of.truth.facesAway[i] || of.truth.tie[i] != Tie::None) continue;
            edges += of.shadow[i] != of.truth.blocked[i] && isNearBoundary(of.truth, x, y, reach);
        }
    }
    return edges;
}

SpeedRow row(MaskIs mask, int divisor, const std::string& name, const std::string& what) {
    return {.name = "Judge/" + name,
            .what = "mask comparison, 512x512: " + what,
            .target = 5,
            .unit = "ms",
            .sides = "ms (plain)",
            .prepare = [=](Load load) -> Round {
                const auto of = std::make_shared<const Judged>(mask, load == Load::Full ? 512 : 32);
                return [=] {
                    double start = threadCpuMs();
                    const Judgement judgement = judge(of->truth, of->shadow, divisor, true);
                    const double ours = threadCpuMs() - start;
                    start = threadCpuMs();
                    const int edges = plainEdges(*of, divisor);
                    const double plain = threadCpuMs() - start;
                    if (edges != judgement.edge) throw std::logic_error("the plain loop disagrees");
                    return Measured{ours, ours, plain};
                };
            }};
}

}  // namespace

std::vector<SpeedRow> judgeRows() {
    return {row(MaskIs::Right, 1, "Right", "a right mask"),
            row(MaskIs::MostlyRight, 4, "MostlyRight", "1% wrong, quarter size"),
            row(MaskIs::Inverted, 4, "Inverted", "all wrong, quarter size")};
}

}  // namespace gnomon
