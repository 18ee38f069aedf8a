#include "matrix/advice.h"
#include "matrix/choice.h"
#include "plan/chip_terms.h"

namespace gnomon {

Advice advise(Lab& lab, const Profile& profile, int width, int height, int frame,
              const ProgressListener& progress) {
    Advice advice{
        .profile = profile.id, .scene = lab.scene().id, .width = width, .height = height, .frame = frame};
    advice.rates = modelRates(profile);
    const auto before = lab.simulated();
    lab.simulate(Effects::none());
    auto all = options(lab, profile, Shade::Attenuated, width, height, frame);
    Progress at{.all = all.size()};
    if (progress) progress(at);
    for (Option& option : all) {
        AdviceRow row{.method = option.method,
                      .minimal = std::move(option.plan),
                      .amount = option.amount,
                      .cost = std::move(option.cost)};
        row.cell = lab.run(profile, option.axes, width, height, frame);
        if (row.isDrawn()) {
            row.fullAmount = sumOf(lab.fullAmounts(profile, option.axes, width, height, frame));
            for (const Pass& pass : row.minimal.plan.passes)
                row.chipTerms.push_back(chipTerms(pass, profile, row.minimal.plan));
            if (option.axes.store != Store::DepthMap &&
                lab.wrongPixels(profile, row.minimal, width, height, frame) == 0)
                row.proof = "exact arithmetic has every untied pixel as ray tracing has it";
        }
        advice.fidelity = row.cell.fidelity, advice.device = row.cell.device;
        at.failures += row.cell.verdict == Verdict::Failed;
        ++at.done;
        advice.rows.push_back(std::move(row));
        if (progress) progress(at);
    }
    lab.simulate(before);
    return ranked(std::move(advice));
}

}  // namespace gnomon
