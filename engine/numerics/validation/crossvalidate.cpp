#include "numerics/validation/crossvalidate.h"

#include <cmath>
#include <limits>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMinFold = 10;  // samples

struct Part {
    std::size_t experiment;
    Index first, last;  // 1-based, inclusive
};

IdData one_experiment(const IdData& data, std::size_t k) {
    IdData part = data;
    part.experiments = {data.experiments[k]};
    return part;
}

// Each experiment is cut into segments in proportion to its share of the samples, at least one.
std::vector<Part> segments(const IdData& data, int folds) {
    std::vector<Part> parts;
    const double total = static_cast<double>(data.sample_count());
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        const Index N = data.sample_count(k);
        const Index count = std::max<Index>(1, std::lround(folds * static_cast<double>(N) / total));
        for (Index i = 0; i < count; ++i) parts.push_back({k, i * N / count + 1, (i + 1) * N / count});
    }
    return parts;
}

std::vector<Part> whole_experiments(const IdData& data) {
    std::vector<Part> parts;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) parts.push_back({k, 1, data.sample_count(k)});
    return parts;
}

IdData all_but(const IdData& data, const Part& part) {
    std::vector<IdData> others;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        const IdData own = one_experiment(data, k);
        if (k != part.experiment) {
            others.push_back(own);
            continue;
        }
        if (part.first > 1) others.push_back(own.range(1, part.first - 1));
        if (part.last < data.sample_count(k)) others.push_back(own.range(part.last + 1, data.sample_count(k)));
    }
    return others.size() == 1 ? others.front() : IdData::merge(others);
}

void check_parts(const std::vector<Part>& parts) {
    if (parts.size() < 2)
        throw InvalidArgument(
            "Cross-validation by experiments needs at least two experiments, but the data have one: use folds instead");
    for (const Part& part : parts)
        if (part.last - part.first + 1 < kMinFold)
            throw InvalidArgument("Each fold needs at least {} samples, but one has {}: use fewer folds", kMinFold,
                                  part.last - part.first + 1);
}

/// On the folds of one output, from what the model fits of each in per cent.
Message summary_of(const Vector& fits) {
    const Message summary =
        plural(fits.size(), "Simulated on {} part not used for estimation: fit {} % on average, from {} to {} %.",
               "Simulated on {} parts not used for estimation: fit {} % on average, from {} to {} %.",
               significant(fits.mean(), 4), significant(fits.minCoeff(), 4), significant(fits.maxCoeff(), 4));
    if (fits.allFinite()) return summary;
    return sentences({summary, Message("At least one of the models is unstable.")});
}

void summarise(CrossValidation& result, const std::vector<std::string>& names) {
    const Index folds = result.fit_percent.rows();
    if (folds == 0) {
        result.message = Message("Interrupted before the first fold was complete.");
        return;
    }
    const Matrix& fits = result.fit_percent;
    result.mean = fits.colwise().mean().transpose();
    result.spread = Vector::Zero(fits.cols());
    if (folds > 1 && fits.allFinite())
        result.spread =
            ((fits.rowwise() - result.mean.transpose()).colwise().squaredNorm() / static_cast<double>(folds - 1))
                .cwiseSqrt()
                .transpose();
    MessageList lines{{}, Join::kLines};
    for (Index i = 0; i < fits.cols(); ++i) {
        const Message summary = summary_of(fits.col(i));
        lines.items.push_back(fits.cols() > 1 ? Message("{}: {}", names[static_cast<std::size_t>(i)], summary)
                                              : summary);
    }
    result.message = lines.items.size() == 1 ? lines.items.front() : Message("{}", lines);
}

}  // namespace

void CrossValidationOptions::validate() const {
    if (!by_experiment && folds < 2) throw InvalidArgument("the number of folds must be at least 2, but is {}", folds);
}

CrossValidation cross_validate(const IdData& data, const ModelFitter& fit, const CrossValidationOptions& options) {
    options.validate();
    const std::vector<Part> parts = options.by_experiment ? whole_experiments(data) : segments(data, options.folds);
    check_parts(parts);
    CrossValidation result;
    std::vector<Vector> fits;
    for (const Part& part : parts) {
        if (options.cancel && options.cancel()) break;
        CrossValidationFold fold{part.experiment, part.first, part.last, fit(all_but(data, part)), {}};
        const IdData left_out = one_experiment(data, part.experiment).range(part.first, part.last);
        fold.validation = compare_all(left_out, fold.channels, options.simulation);
        // An unstable model may leave the range of numbers on the way: no fit is worse.
        const Vector& fit_percent = fold.validation.fit_percent;
        fits.push_back(fit_percent.array().isFinite().select(fit_percent, -std::numeric_limits<double>::infinity()));
        result.folds.push_back(std::move(fold));
    }
    result.fit_percent.resize(static_cast<Index>(fits.size()), data.output_count());
    for (std::size_t i = 0; i < fits.size(); ++i) result.fit_percent.row(static_cast<Index>(i)) = fits[i].transpose();
    summarise(result, data.output_names);
    return result;
}

}  // namespace dynlab::inline numerics
