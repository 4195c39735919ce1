#include "numerics/validation/sampling_issues.h"

#include <algorithm>
#include <cmath>

#include "numerics/signals/robust_statistics.h"
#include "numerics/validation/fitted_data.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kGap = 1.5;  // usual steps from which on a sample is missing

/// The steps between instants, and which of them are as usual.
struct Clock {
    Vector steps;
    double usual = 0;
    Index alike_to(double step) const { return ((steps.array() / step - 1).abs() < 0.05).count(); }
    bool is_usual(Index place) const { return std::abs(steps[place] / usual - 1) < 0.05; }
};

/// First place from which on the steps differ for at least `length` samples with few exceptions; -1 if none.
Index first_other_clock(const Clock& clock, Index length) {
    Index others = 0;
    for (Index k = 0; k < clock.steps.size(); ++k) {
        others += !clock.is_usual(k);
        if (k >= length) others -= !clock.is_usual(k - length);
        if (k + 1 >= length && others >= length - length / 20) {
            Index first = k + 1 - length;
            while (clock.is_usual(first)) ++first;
            return first;
        }
    }
    return -1;
}

DataIssue mixed_sampling(const Clock& clock, Index place, std::size_t experiment, const std::string& unit) {
    const double other = median(clock.steps.segment(place, std::min<Index>(20, clock.steps.size() - place)));
    return {
        "mixed_sampling",
        Weight::kWarning,
        "",
        Message("The data mix two sampling times: {} steps of {} and {} steps of {}, which begin at sample {}. Two "
                "files were probably joined. Create an experiment from each part, resample one part and merge both.",
                clock.alike_to(clock.usual), with_unit(significant(clock.usual, 4), unit), clock.alike_to(other),
                with_unit(significant(other, 4), unit), place + 1),
        other,
        experiment,
        {{place + 1, place + 2}}};
}

DataIssue gaps(const Clock& clock, Index count, std::size_t experiment, const std::string& unit) {
    Index place = 0;
    while (clock.steps[place] < kGap * clock.usual) ++place;
    const double step = clock.steps[place];
    return {"gaps",
            Weight::kWarning,
            "",
            Message("The time jumps at {}, first after sample {}, by {} instead of {}: samples are missing. "
                    "Interpolate small gaps (interp1); at large gaps, split the data into experiments.",
                    plural(count, "{} place", "{} places"), place + 1, with_unit(significant(step, 4), unit),
                    with_unit(significant(clock.usual, 4), unit)),
            step,
            experiment,
            {{place + 1, place + 2}}};
}

}  // namespace

void find_sampling(const IdData& data, std::vector<DataIssue>& findings) {
    const std::string& unit = data.time_unit;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        const Vector& t = data.experiments[k].t;
        if (t.size() < 10) continue;
        Clock clock{t.tail(t.size() - 1) - t.head(t.size() - 1)};
        clock.usual = median(clock.steps);
        if (clock.alike_to(clock.usual) < clock.steps.size() / 3) continue;
        const Index other = first_other_clock(clock, std::max<Index>(8, clock.steps.size() / 20));
        const Index missing = (clock.steps.array() > kGap * clock.usual).count();
        if (other >= 0)
            findings.push_back(mixed_sampling(clock, other, k, unit));
        else if (missing > 0)
            findings.push_back(gaps(clock, missing, k, unit));
    }
}

}  // namespace dynlab::inline numerics
