#include "numerics/validation/advice.h"

#include <algorithm>

namespace dynlab::inline numerics {

namespace {

bool spoils_a_stretch(const RecordFinding& finding) {
    return finding.experiment == 0 && (finding.code == "saturation" || finding.code == "nonlinear");
}

bool forbids_a_model(const RecordFinding& finding) {
    return finding.code == "constant" || finding.code == "time_column" || finding.code == "same_column";
}

}  // namespace

bool Advice::has(const std::string& code) const {
    return find(code) != nullptr;
}

const RecordFinding* Advice::find(const std::string& code) const {
    const auto found =
        std::find_if(findings.begin(), findings.end(), [&](const RecordFinding& f) { return f.code == code; });
    return found == findings.end() ? nullptr : &*found;
}

bool Advice::clean() const {
    return std::none_of(findings.begin(), findings.end(),
                        [](const RecordFinding& f) { return f.weight == Weight::kWarning; });
}

Advice advise(const IdData& data, const std::function<bool()>& cancel) {
    Advice advice{signal_advice(data), {}};
    const bool usable = std::none_of(advice.findings.begin(), advice.findings.end(), forbids_a_model);
    if (usable && data.input_count() == 1 && data.regular())
        for (Index output = 1; output <= data.output_count(); ++output)
            for (RecordFinding& finding : model_advice(data.select({output}, {1}), cancel))
                advice.findings.push_back(std::move(finding));
    std::stable_sort(advice.findings.begin(), advice.findings.end(),
                     [](const RecordFinding& a, const RecordFinding& b) { return a.weight > b.weight; });
    for (const RecordFinding& finding : advice.findings)
        if (spoils_a_stretch(finding))
            advice.discard.insert(advice.discard.end(), finding.sections.begin(), finding.sections.end());
    advice.discard = joined(advice.discard);
    return advice;
}

}  // namespace dynlab::inline numerics
