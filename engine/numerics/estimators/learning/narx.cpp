#include "numerics/estimators/learning/narx.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/reader.h"
#include "numerics/error.h"
#include "numerics/estimators/learning/canceled.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/triangular_factor.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMaxTerms = 50, kRowsAtOnce = 2048;
constexpr double kDependent = 1e-12;  // of a candidate's power, what the others leave of it
constexpr double kOutOfBounds = 1e3;  // times the largest output of the data

/// R of the candidates' values and the outputs, of which all that follows is made.
Matrix candidates_and_output(const IdData& data, const NarxLags& lags, const Monomials& monomials,
                             const std::function<bool()>& cancel) {
    TriangularFactor factor(monomials.count() + 1);
    for (const Experiment& experiment : data.experiments) {
        const Index first = lags.first();
        if (experiment.y.rows() <= first) continue;
        const Matrix past = lags.past_values(experiment.y.col(0), experiment.u);
        for (Index row = 0; row < past.rows(); row += kRowsAtOnce) {
            check_canceled("narx", cancel);
            const Index rows = std::min(kRowsAtOnce, past.rows() - row);
            Matrix block(rows, monomials.count() + 1);
            block.leftCols(monomials.count()) = monomials.values(past.middleRows(row, rows));
            block.col(monomials.count()) = experiment.y.col(0).segment(first + row, rows);
            factor.add(block);
        }
    }
    return factor.R();
}

Index equation_count(const IdData& data, const NarxLags& lags) {
    Index rows = 0;
    for (const Experiment& experiment : data.experiments)
        rows += std::max<Index>(0, experiment.y.rows() - lags.first());
    return rows;
}

struct Choice {
    std::vector<Index> terms;
    std::vector<double> error_reduction, bic;
};

/// Selects the candidates in turn: each time the one that explains most of the rest of the output. Each selected
/// candidate is removed from all others (modified Gram-Schmidt).
Choice choose_forwards(const Matrix& R, Index rows, Index max_terms, const std::function<bool()>& cancel) {
    const Index M = R.cols() - 1;
    Matrix W = R.leftCols(M);
    Vector rest = R.col(M);
    const Vector powers = W.colwise().squaredNorm().transpose();
    const double power = rest.squaredNorm(), N = static_cast<double>(rows);
    std::vector<bool> taken(static_cast<std::size_t>(M), false);
    Choice choice;
    while (static_cast<Index>(choice.terms.size()) < max_terms) {
        check_canceled("narx", cancel);
        Index best = -1;
        double max_explained = 0;
        for (Index j = 0; j < M; ++j) {
            const double own = W.col(j).squaredNorm();
            if (taken[static_cast<std::size_t>(j)] || own <= kDependent * powers[j]) continue;
            const double along = W.col(j).dot(rest), explained = along * along / own;
            if (explained > max_explained) max_explained = explained, best = j;
        }
        if (best < 0) break;
        taken[static_cast<std::size_t>(best)] = true;
        const Vector q = W.col(best).normalized();
        rest -= q * q.dot(rest);
        for (Index j = 0; j < M; ++j)
            if (!taken[static_cast<std::size_t>(j)]) W.col(j) -= q * q.dot(W.col(j));
        choice.terms.push_back(best);
        choice.error_reduction.push_back(max_explained / power);
        choice.bic.push_back(bic_of_loss(rest.squaredNorm() / N, power / N, rows, choice.terms.size()));
    }
    return choice;
}

std::size_t number_of_terms(const Choice& choice, Index requested) {
    if (requested == 0) return static_cast<std::size_t>(std::ranges::min_element(choice.bic) - choice.bic.begin()) + 1;
    if (static_cast<Index>(choice.terms.size()) < requested)
        throw InvalidArgument("narx: {} terms are requested, but these data determine only {}", requested,
                              plural(choice.terms.size(), "{} independent candidate", "{} independent candidates"));
    return static_cast<std::size_t>(requested);
}

/// theta of the selected terms, with all results of a linear regression.
void solve_chosen(NarxFit& found, const Matrix& R, const std::vector<Index>& terms, Index rows) {
    const auto d = static_cast<Index>(terms.size());
    Matrix chosen(R.rows(), d);
    for (Index i = 0; i < d; ++i) chosen.col(i) = R.col(terms[static_cast<std::size_t>(i)]);
    const LeastSquares solution = solve_least_squares(chosen, R.col(R.cols() - 1));
    Fit& fit = found.fit;
    const double squares = solution.residuals.squaredNorm();
    fit.theta = solution.solution;
    fit.noise_variance = Vector::Constant(1, squares / static_cast<double>(rows - d));
    fit.covariance = fit.noise_variance[0] * solution.inverse_gram;
    fit.std = fit.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    fit.condition_number = solution.condition_number;
    fit.loss = squares / static_cast<double>(rows);
}

/// The fits of the free run and one step ahead, and where the former is lost.
void assess(NarxFit& found, const IdData& data, Index rows) {
    Fit& fit = found.fit;
    const double variation = output_variations(data)[0];
    double errors = 0;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        const FreeRun run = found.model->free_run(data, k, Vector());
        if (run.lost_at) fit.warnings.push_back(divergence_text(data, k, *run.lost_at));
        errors += (data.experiments[k].y - run.output).squaredNorm();
    }
    fit.fit_percent = Vector::Constant(1, fit_percent_of_sums(errors, variation));
    fit.prediction_fit_percent = fit_percent_of_sums(fit.loss * static_cast<double>(rows), variation);
}

std::string equation_text(const IdData& data, const NarxFit& found) {
    std::string text = data.output_names.front() + "(k) =";
    for (Index i = 0; i < found.fit.theta.size(); ++i) {
        const double value = found.fit.theta[i];
        const std::string& term = found.fit.names[static_cast<std::size_t>(i)];
        text += (value < 0 ? " - " : i == 0 ? " " : " + ") + number_text(std::abs(value), 5);
        if (term != "1") text += "*" + term;
    }
    return text;
}

double candidate_count(Index variables, int degree) {
    double count = 1;
    for (int d = 1; d <= degree; ++d) count *= static_cast<double>(variables + d) / static_cast<double>(d);
    return std::round(count);
}

bool has_enough_samples(const IdData& data, const NarxLags& lags, int degree, Index terms) {
    const auto rows = static_cast<double>(equation_count(data, lags));
    const double candidates = candidate_count(lags.variables(), degree);
    const auto least = static_cast<double>(std::max<Index>(terms, 1));
    return lags.variables() > 0 && candidates >= least && rows > candidates && rows > least + 1;
}

/// "{2, {1, 2}, {1, 3}}", as the orders are given.
std::string orders_text(const NarxLags& lags) {
    const auto list = [](const std::vector<int>& values) {
        std::string text;
        for (const int value : values) text += (text.empty() ? "" : ", ") + std::to_string(value);
        return values.size() == 1 ? text : "{" + text + "}";
    };
    return "{" + std::to_string(lags.na) + ", " + list(lags.nb) + ", " + list(lags.nk) + "}";
}

/// The highest lower degree, and the most past values, that suit the number of samples.
std::vector<Message> smaller_structures(const IdData& data, const NarxLags& lags, const NarxOptions& options) {
    std::vector<Message> found;
    for (int degree = options.degree - 1; degree >= 1 && found.empty(); --degree)
        if (has_enough_samples(data, lags, degree, options.terms))
            found.push_back(Message("{} = {}", OptionName{"degree"}, degree));
    const int most = std::max(lags.na, *std::ranges::max_element(lags.nb));
    for (int limit = most - 1; limit >= 1; --limit) {
        NarxLags fewer = lags;
        fewer.na = std::min(fewer.na, limit);
        for (int& nb : fewer.nb) nb = std::min(nb, limit);
        if (!has_enough_samples(data, fewer, options.degree, options.terms)) continue;
        found.push_back(Message("{na, nb, nk} = {}", orders_text(fewer)));
        break;
    }
    return found;
}

void check(const IdData& data, const NarxLags& lags, const NarxOptions& options, Index candidates) {
    check_sampled_data("narx", data);
    if (data.output_count() != 1)
        throw InvalidArgument("narx needs one output, but the data have {}: select one", data.output_count());
    const Index rows = equation_count(data, lags), least = std::max<Index>(options.terms, 1) + 1;
    if (options.terms > candidates)
        throw InvalidArgument("narx: {} terms are requested, but the lags and the degree allow only {}", options.terms,
                              plural(candidates, "{} candidate", "{} candidates"));
    if (rows > std::max(least, candidates)) return;
    const std::vector<Message> smaller = smaller_structures(data, lags, options);
    const MessageList remedies{smaller, Join::kOr};
    if (rows > least) {
        const Message more = plural(candidates + 1 - rows, "{} more sample", "{} more samples");
        throw InvalidArgument(smaller.empty()
                                  ? Message("narx: only {} samples have all required past values, which is too few for "
                                            "{} candidate terms. Use at least {}",
                                            rows, candidates, more)
                                  : Message("narx: only {} samples have all required past values, which is too few for "
                                            "{} candidate terms. Use at least {}, or set {}",
                                            rows, candidates, more, remedies));
    }
    throw InvalidArgument(
        smaller.empty()
            ? Message("narx: the number of samples with all required past values is {}, but must be greater than {}. "
                      "Use more data, fewer lags or fewer terms",
                      rows, least)
            : Message("narx: the number of samples with all required past values is {}, but must be greater than {}. "
                      "Use more data, or set {}",
                      rows, least, remedies));
}

}  // namespace

void NarxLags::check(Index inputs) const {
    if (static_cast<Index>(nb.size()) != inputs || nb.size() != nk.size())
        throw InvalidArgument("narx: the lags are specified for {}, but the data have {}",
                              plural(static_cast<Index>(nb.size()), "{} input", "{} inputs"), inputs);
    bool negative = na < 0;
    for (std::size_t j = 0; j < nb.size(); ++j) negative = negative || nb[j] < 0 || nk[j] < 0;
    if (negative) throw InvalidArgument("narx: na, nb and nk must be nonnegative");
    if (variables() == 0) throw InvalidArgument("narx: the model uses no past values: na or nb must be at least 1");
}

Index NarxLags::variables() const {
    Index count = na;
    for (const int own : nb) count += own;
    return count;
}

Index NarxLags::first() const {
    Index first = na;
    for (std::size_t j = 0; j < nb.size(); ++j)
        if (nb[j] > 0) first = std::max<Index>(first, nk[j] + nb[j] - 1);
    return first;
}

Matrix NarxLags::past_values(const VectorView& y, const MatrixView& u) const {
    const Index start = first(), rows = y.size() - start;
    Matrix past(rows, variables());
    Index column = 0;
    for (int lag = 1; lag <= na; ++lag) past.col(column++) = y.segment(start - lag, rows);
    for (std::size_t j = 0; j < nb.size(); ++j)
        for (int i = 0; i < nb[j]; ++i)
            past.col(column++) = u.col(static_cast<Index>(j)).segment(start - nk[j] - i, rows);
    return past;
}

std::vector<std::string> NarxLags::names(const std::string& output, const std::vector<std::string>& inputs) const {
    std::vector<std::string> all;
    const auto add = [&](const std::string& name, int lag) {
        all.push_back(name + (lag == 0 ? "(k)" : "(k-" + std::to_string(lag) + ")"));
    };
    for (int lag = 1; lag <= na; ++lag) add(output, lag);
    for (std::size_t j = 0; j < nb.size(); ++j)
        for (int i = 0; i < nb[j]; ++i) add(inputs[j], nk[j] + i);
    return all;
}

NarxModel::NarxModel(NarxLags lags, Monomials monomials, std::vector<Index> terms, Vector theta, double Ts,
                     double largest)
    : lags_(std::move(lags)),
      monomials_(std::move(monomials)),
      terms_(std::move(terms)),
      theta_(std::move(theta)),
      Ts_(Ts),
      largest_(largest) {}

FreeRun NarxModel::free_run(const IdData& data, std::size_t experiment, const VectorView& x0) const {
    check_channels("narx", *this, data);
    if (!data.regular() || std::abs(data.Ts - Ts_) > 1e-6 * Ts_)
        throw InvalidArgument(
            data.regular() ? Message("narx: the sampling time of the model is {} s, but the sampling time of the data "
                                     "is {} s. Resample the data",
                                     Ts_, data.Ts)
                           : Message("narx: the sampling time of the model is {} s, but the data are irregularly "
                                     "sampled. Interpolate the data at equally spaced instants (interp1)",
                                     Ts_));
    const Experiment& data_set = data.experiments[experiment];
    const Index N = data_set.u.rows() > 0 ? data_set.u.rows() : data_set.y.rows(), first = lags_.first();
    if (N <= first)
        throw InvalidArgument("narx: the simulation starts after {}, but the data have only {}",
                              plural(first, "{} sample", "{} samples"), N);
    if (x0.size() != 0 && x0.size() != first)
        throw InvalidArgument("narx: x0 must contain the first {} of the simulation, but has {}",
                              plural(first, "{} output", "{} outputs"), plural(x0.size(), "{} value", "{} values"));
    FreeRun run{Matrix::Constant(N, 1, kNaN),
                {},
                Message("from the first {} of the data", plural(first, "{} sample", "{} samples"))};
    auto y = run.output.col(0);
    if (x0.size() > 0) {
        y.head(first) = x0;
    } else if (data_set.y.cols() > 0) {
        y.head(first) = data_set.y.col(0).head(first);
    } else {
        y.head(first).setZero();
    }
    Vector z(lags_.variables());
    for (Index k = first; k < N; ++k) {
        Index place = 0;
        for (int lag = 1; lag <= lags_.na; ++lag) z[place++] = y[k - lag];
        for (std::size_t j = 0; j < lags_.nb.size(); ++j)
            for (int i = 0; i < lags_.nb[j]; ++i) z[place++] = data_set.u(k - lags_.nk[j] - i, static_cast<Index>(j));
        double next = 0;
        for (Index i = 0; i < theta_.size(); ++i)
            next += theta_[i] * monomials_.value(terms_[static_cast<std::size_t>(i)], z);
        if (!(std::abs(next) <= kOutOfBounds * largest_)) {
            run.lost_at = k;
            break;
        }
        y[k] = next;
    }
    return run;
}

void NarxOptions::validate() const {
    if (terms < 0) throw InvalidArgument("narx: {} must be nonnegative, but is {}", OptionName{"terms"}, terms);
}

NarxFit narx(const IdData& data, const NarxLags& lags, const NarxOptions& options) {
    options.validate();
    lags.check(data.input_count());
    const Monomials monomials("narx", lags.variables(), options.degree);
    check(data, lags, options, monomials.count());
    const Index rows = equation_count(data, lags);
    const Matrix R = candidates_and_output(data, lags, monomials, options.cancel);
    const Index max_terms = options.terms > 0 ? options.terms : std::min({kMaxTerms, monomials.count(), rows - 2});
    const Choice choice = choose_forwards(R, rows, max_terms, options.cancel);
    if (choice.terms.empty())
        throw InvalidArgument("narx: no candidate term explains the output. Use other lags or a higher degree");
    const std::vector<Index> terms(choice.terms.begin(), choice.terms.begin() + number_of_terms(choice, options.terms));
    NarxFit found;
    solve_chosen(found, R, terms, rows);
    const std::vector<std::string> names = lags.names(data.output_names.front(), data.input_names);
    for (const Index term : terms) found.fit.names.push_back(monomials.text(term, names));
    for (std::size_t i = 0; i < choice.terms.size(); ++i)
        found.steps.push_back({monomials.text(choice.terms[i], names), choice.error_reduction[i], choice.bic[i]});
    double largest = 0;
    for (const Experiment& experiment : data.experiments)
        largest = std::max(largest, experiment.y.cwiseAbs().maxCoeff());
    found.model = std::make_shared<NarxModel>(lags, monomials, terms, found.fit.theta, data.Ts, largest);
    found.equation = equation_text(data, found);
    assess(found, data, rows);
    if (found.fit.condition_number > kAmbiguousCondition)
        warn_of_doubtful_parameters(found.fit, SimplerModel::kFewerTerms);
    found.fit.message =
        Message("Polynomial model with {} of {} chosen by forward selection: {}, {} % (one step ahead).", terms.size(),
                plural(monomials.count(), "{} candidate term", "{} candidate terms"), simulation_text(found.fit),
                significant(found.fit.prediction_fit_percent, 4));
    return found;
}

}  // namespace dynlab::inline numerics
