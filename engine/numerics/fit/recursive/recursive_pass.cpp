#include "numerics/fit/recursive/recursive_pass.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "numerics/criteria/denominator_group.h"
#include "numerics/error.h"
#include "numerics/filters/evolving_filter.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/fit/recursive/instrument_array.h"
#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/models/sampled_system.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kSamplesBetweenQuestions = 4096;  // whether to stop
constexpr Index kFirstSamplesPerParameter = 20;
constexpr double kFilterMemories = 20;      // of the first batch
constexpr double kBlockMemories = 5;        // of the blocks from which the errors' color is estimated
constexpr Index kSamplesBetweenLooks = 16;  // at how well the model is known
constexpr double kSurest = 0.03;            // relative standard errors of coefficients that filters follow
constexpr double kQuickest = 5;             // poles of a model that filters follow, in cutoff frequencies
constexpr double kStepRounding = 1e-9;      // relative, of a number of samples: the unit of time must not change it

/// The data as the loop uses them.
struct Samples {
    VectorView y, u;
    Vector t;  // empty for regular sampling
    double Ts;
    Index delay;
    bool held_u, held_y;

    double step(Index k) const { return t.size() > 0 ? t[k] - t[k - 1] : Ts; }
    double input(Index k) const { return k >= delay ? u[k - delay] : 0.0; }
};

Samples samples_of(const RecursiveName& method, const IdData& data, double delay, Hold hold_y) {
    const Experiment& data_set = data.experiments.front();
    Index late = 0;
    if (delay > 0) {
        const SplitDelay split = data.regular() ? split_delay(delay, data.Ts) : SplitDelay{0, delay};
        if (split.rest > 0)
            throw InvalidArgument("{}: the delay must be a whole number of sampling times, but it is {} {}",
                                  method.name, delay, data.time_unit);
        late = split.samples;
    }
    return {data_set.y.col(0),       data_set.u.col(0),   data_set.t, data.Ts, late,
            data.hold == Hold::kZoh, hold_y == Hold::kZoh};
}

/// A filter that stays as it is: steps of equal length are worked out once.
template <int kOrder>
class FixedFilter {
  public:
    explicit FixedFilter(const EvolvingModel& model) : model_(model) {
        Vector den(model.n + 1);
        den[0] = 1;
        for (int i = 0; i < model.n; ++i) den[i + 1] = model.a[static_cast<std::size_t>(i)];
        A_ = companion(den);
    }
    void advance(EvolvingState& state, double from, double to, double h) {
        if (h != step_) prepare(h);
        const auto n = static_cast<std::size_t>(kOrder > 0 ? kOrder : model_.n);
        EvolvingState next;
        for (std::size_t i = 0; i < n; ++i) {
            next[i] = H0_[i] * from + H1_[i] * to;
            for (std::size_t j = 0; j < n; ++j) next[i] += F_[i][j] * state[j];
        }
        state = next;
    }
    double highest(const EvolvingState& state, double v) const { return highest_derivative<kOrder>(model_, state, v); }

  private:
    void prepare(double h) {
        const StepMatrices step = exact_step(A_, Vector::Unit(A_.rows(), 0), h);
        for (Index i = 0; i < A_.rows(); ++i) {
            const auto row = static_cast<std::size_t>(i);
            H0_[row] = step.H0(i, 0);
            H1_[row] = step.H1(i, 0);
            for (Index j = 0; j < A_.rows(); ++j) F_[row][static_cast<std::size_t>(j)] = step.F(i, j);
        }
        step_ = h;
    }

    EvolvingModel model_;
    Matrix A_;
    std::array<EvolvingState, kMaxEvolvingPoles> F_{};
    EvolvingState H0_{}, H1_{};
    double step_ = 0;
};

bool is_stable(const EvolvingModel& model) {
    if (model.n <= 2) return model.a[0] > 0 && (model.n < 2 || model.a[1] > 0);
    Vector den(model.n + 1);
    den[0] = 1;
    for (int i = 0; i < model.n; ++i) den[i + 1] = model.a[static_cast<std::size_t>(i)];
    return is_hurwitz(den);
}

/// The samples of the first batch, and the model that ivsvf, or lssvf where that one fails, makes of them.
Index first_batch(const IdData& data, Index parameters, double lambda) {
    const double steps = kFilterMemories / (lambda * data.mean_step());
    const Index requested = std::max<Index>(kFirstSamplesPerParameter * parameters,
                                            static_cast<Index>(std::min(steps * (1 + kStepRounding), 1e15)));
    return std::min(requested, data.sample_count());
}

Vector first_model(const IdData& data, const TransferStructure& structure, const RecursiveOptions& options,
                   Index samples) {
    for (Index count = samples;; count = std::min(2 * count, data.sample_count())) {
        const IdData beginning = data.range(1, count);
        const DenominatorGroup group(beginning, structure, 0, options.hold_y);
        const Vector E = filter_denominator(options.lambda, group.order());
        const Vector first = solve_equations(group.svf(E));
        if (first.allFinite()) {
            const Vector start = group.with_stable_poles(first), theta = solve_equations(group.auxiliary(E, start));
            return theta.allFinite() ? group.with_stable_poles(theta) : start;
        }
        if (count == data.sample_count()) return first;
    }
}

/// A pass over the samples whose sizes only its own loops know.
class AnyPass {
  public:
    virtual ~AnyPass() = default;
    /// The model of instruments and filters until sample `until` (0-based), and from then on, too, when that is behind
    /// the last.
    virtual void begin_with(const Vector& theta, Index until) = 0;
    virtual void take(Index first, Index last) = 0;  ///< samples first ... last
    virtual bool known() const = 0;
    virtual Vector theta() const = 0;
    virtual double variance() const = 0;
    virtual Matrix covariance() const = 0;
    virtual Index samples_not_followed() const = 0;
};

template <RecursiveMethod kMethod, int kOrder, int kCount>
class Pass final : public AnyPass {
  public:
    /// `step`: mean sampling time, s.
    Pass(const Samples& samples, const TransferStructure& structure, const RecursiveOptions& options, double step)
        : samples_(samples),
          options_(options),
          array_(static_cast<int>(structure.parameter_count()),
                 std::max(kBlockMemories / (options.lambda * step) * (1 - kStepRounding), 1.0)) {
        n_ = structure.poles.front();
        m_ = structure.channels.front().zeros;
        model_.n = filter_.n = n_;
        model_.m = filter_.m = m_;
        const Vector E = filter_denominator(options.lambda, n_);
        for (int i = 0; i < n_; ++i) {
            const auto place = static_cast<std::size_t>(i);
            filter_.a[place] = E[i + 1];
            in_cutoffs_[place] = (i > 0 ? in_cutoffs_[place - 1] : 1) / options.lambda;
            quickest_size_ = (1 + kQuickest) * quickest_size_ + kQuickest;
        }
        fixed_.emplace(filter_);
    }

    void begin_with(const Vector& theta, Index until) override {
        model_.set(theta.data());
        follows_from_ = until;
        if (options_.model || !too_quick(model_)) return;
        model_ = filter_;
        model_.b = {};
        model_.b[static_cast<std::size_t>(m_)] = std::pow(options_.lambda, n_);
    }

    void take(Index first, Index last) override {
        for (Index k = first; k <= last; ++k) take(k);
    }

    bool known() const override { return array_.known(); }
    Vector theta() const override { return Vector::Map(array_.theta().data(), n_ + m_ + 1); }
    double variance() const override { return array_.variance(); }
    Matrix covariance() const override { return array_.covariance(); }
    Index samples_not_followed() const override { return not_followed_; }

  private:
    using Array = InstrumentArray<kCount, kMethod != RecursiveMethod::kLeastSquares>;

    void take(Index k) {
        if (k > 0) advance(k);
        const auto n = static_cast<std::size_t>(kOrder > 0 ? kOrder : n_);
        const auto count = n + static_cast<std::size_t>(m_) + 1;
        const double y = samples_.y[k], u = samples_.input(k);
        typename Array::Row z{}, phi{};
        const EvolvingModel& filter = kMethod == RecursiveMethod::kRefined ? model_ : filter_;
        for (std::size_t i = 0; i < n; ++i) {
            phi[i] = -y_[i];
            z[i] = kMethod == RecursiveMethod::kLeastSquares ? phi[i] : -x_[i];
        }
        for (std::size_t i = n; i < count; ++i) {
            const int derivative = m_ - static_cast<int>(i - n);
            phi[i] = derivative == static_cast<int>(n) ? highest_derivative<kOrder>(filter, u_, u)
                                                       : u_[n - 1 - static_cast<std::size_t>(derivative)];
            z[i] = phi[i];
        }
        if (k > 0 && options_.drift.size() > 0) walk();
        array_.add(z, phi, highest_derivative<kOrder>(filter, y_, y), options_.forgetting);
        if (kMethod == RecursiveMethod::kLeastSquares || k < follows_from_ || !array_.known()) return;
        if (k % kSamplesBetweenLooks == 0) sure_ = known_well();
        if (sure_) follow();
    }

    /// Everything to the instant of sample k; the signals begin at their first sample and are zero, no ramp, before.
    void advance(Index k) {
        const double h = samples_.step(k), y0 = samples_.y[k - 1], y1 = samples_.held_y ? y0 : samples_.y[k];
        const double u0 = samples_.input(k - 1);
        const double u1 = samples_.held_u || k == samples_.delay ? u0 : samples_.input(k);
        if constexpr (kMethod == RecursiveMethod::kRefined) {
            in_pieces(h, [&](double piece, double from, double to) {
                advance_cascade<kOrder>(model_, y_, {y0 + from * (y1 - y0), y0 + to * (y1 - y0)}, u_, x_,
                                        {u0 + from * (u1 - u0), u0 + to * (u1 - u0)}, piece);
            });
            return;
        }
        fixed_->advance(y_, y0, y1, h);
        fixed_->advance(u_, u0, u1, h);
        if constexpr (kMethod == RecursiveMethod::kInstruments) {
            // The model's output, sampled, goes through the filter as y does.
            if (k == 1) output_ = filtered_numerator<kOrder>(model_, behind_, samples_.input(0));
            in_pieces(h, [&](double piece, double from, double to) {
                advance_filter<kOrder>(model_, behind_, u0 + from * (u1 - u0), u0 + to * (u1 - u0), piece);
            });
            const double output = filtered_numerator<kOrder>(model_, behind_, samples_.input(k));
            fixed_->advance(x_, output_, samples_.held_y || k == samples_.delay ? output_ : output, h);
            output_ = output;
        }
    }

    template <class Move>
    void in_pieces(double h, const Move& move) {
        const int pieces = std::max(pieces_of_step(model_, h), 1);
        for (int i = 0; i < pieces; ++i) move(h / pieces, double(i) / pieces, double(i + 1) / pieces);
    }

    void walk() {
        const double variance = options_.noise_variance.value_or(array_.variance());
        if (!(variance > 0) || !std::isfinite(variance)) return;
        typename Array::Row steps{};
        for (Index i = 0; i < options_.drift.size(); ++i)
            steps[static_cast<std::size_t>(i)] = options_.drift[i] / variance;
        array_.walk(steps);
    }

    /// The estimate becomes the model of the samples to come, if it is stable and not too quick for the cut-off
    /// frequency: what a quick filter lets through of the noise would outweigh all other samples.
    void follow() {
        EvolvingModel next = model_;
        next.set(array_.theta().data());
        if (is_stable(next) && !too_quick(next))
            model_ = next;
        else
            ++not_followed_;
    }

    /// Whether the denominator is known well enough for filters to follow it: samples that filters of a poor estimate
    /// let through would outweigh all others, now and later.
    bool known_well() const { return array_.known_to(kSurest, static_cast<std::size_t>(n_)); }

    /// Against poles at kQuickest times the cutoff frequency.
    bool too_quick(const EvolvingModel& model) const {
        double size = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(kOrder > 0 ? kOrder : n_); ++i)
            size += std::abs(model.a[i]) * in_cutoffs_[i];
        return !(size <= quickest_size_);
    }

    const Samples& samples_;
    const RecursiveOptions& options_;
    Array array_;
    int n_ = 0, m_ = 0;
    EvolvingModel filter_, model_;
    EvolvingState in_cutoffs_{};  // lambda^-(i + 1)
    double quickest_size_ = 0;    // sum |a_i| lambda^-i of poles all at kQuickest
    std::optional<FixedFilter<kOrder>> fixed_;
    EvolvingState y_{}, u_{}, x_{}, behind_{};
    double output_ = 0;
    Index follows_from_ = 0, not_followed_ = 0;
    bool sure_ = false;
};

/// How the method meets change: half a sentence.
Message memory_text(const RecursiveOptions& options) {
    if (options.drift.size() > 0) return Message("with parameters that follow a random walk");
    if (options.forgetting == 1) return Message("without forgetting");
    return Message("with most of the weight on the last {} samples", std::round(1 / (1 - options.forgetting)));
}

/// Which samples the history keeps.
Index history_stride(Index samples, Index points) {
    return std::max<Index>(1, (samples + points - 1) / points);
}

Fit run_pass(AnyPass& pass, const RecursiveName& method, const IdData& data, const TransferStructure& structure,
             const RecursiveOptions& options) {
    const Index N = data.sample_count(), d = structure.parameter_count();
    const Index stride = history_stride(N, options.history_points), points = (N - 1) / stride + 1;
    const Vector t = data.time();
    auto history = std::make_shared<ParameterHistory>();
    history->t = Vector::Constant(points, kNaN);
    history->theta = history->std = Matrix::Constant(points, d, kNaN);
    Fit fit;
    fit.structure = structure;
    for (Index point = 0, next = 0; point < points; ++point) {
        const Index recorded = N - 1 - (points - 1 - point) * stride;
        while (next <= recorded) {
            const Index since = next % kSamplesBetweenQuestions;
            if (since == 0 && options.cancel && options.cancel()) break;
            const Index last = std::min(recorded, next - since + kSamplesBetweenQuestions - 1);
            pass.take(next, last);
            next = last + 1;
        }
        if (next <= recorded) {
            fit.termination = Termination::kCanceled;
            break;
        }
        history->t[point] = t[recorded];
        if (!pass.known()) continue;
        history->theta.row(point) = pass.theta().transpose();
        if (std::isfinite(pass.variance()))
            history->std.row(point) = pass.covariance().diagonal().cwiseMax(0).cwiseSqrt().transpose();
    }
    if (!pass.known())
        throw InvalidArgument(
            "{}: the samples do not determine the parameters, because the input does not excite the system enough for "
            "{} parameters. Use a richer input, such as a PRBS, or fewer poles and zeros",
            method.name, d);
    fit.theta = pass.theta();
    fit.covariance = pass.covariance();
    fit.noise_variance = Vector::Constant(1, pass.variance());
    fit.history = std::move(history);
    if (pass.samples_not_followed() > N / 2)
        fit.warnings.push_back(
            Message("For most samples, the estimate was unstable or too fast for the sampling time. The filters and "
                    "instruments then used the last suitable model."));
    describe_models(fit);
    fit.message = Message("{}, recursive, {}.", method.title, memory_text(options));
    return fit;
}

template <RecursiveMethod kMethod>
std::unique_ptr<AnyPass> pass_of_method(const Samples& samples, const TransferStructure& structure,
                                        const RecursiveOptions& options, double step) {
    const int n = structure.poles.front();
    const Index d = structure.parameter_count();
    if (n == 1 && d == 2) return std::make_unique<Pass<kMethod, 1, 2>>(samples, structure, options, step);
    if (n == 2 && d == 3) return std::make_unique<Pass<kMethod, 2, 3>>(samples, structure, options, step);
    if (n == 2 && d == 4) return std::make_unique<Pass<kMethod, 2, 4>>(samples, structure, options, step);
    return std::make_unique<Pass<kMethod, Eigen::Dynamic, Eigen::Dynamic>>(samples, structure, options, step);
}

std::unique_ptr<AnyPass> pass_of(RecursiveMethod kind, const Samples& samples, const TransferStructure& structure,
                                 const RecursiveOptions& options, double step) {
    switch (kind) {
        case RecursiveMethod::kLeastSquares:
            return pass_of_method<RecursiveMethod::kLeastSquares>(samples, structure, options, step);
        case RecursiveMethod::kInstruments:
            return pass_of_method<RecursiveMethod::kInstruments>(samples, structure, options, step);
        default:
            return pass_of_method<RecursiveMethod::kRefined>(samples, structure, options, step);
    }
}

void check_recursive_data(const RecursiveName& method, const IdData& data, const TransferStructure& structure) {
    if (structure.free_delays)
        throw InvalidArgument("{}: this method does not estimate delays; use srivc or coe", method.name);
    if (data.experiments.size() != 1)
        throw InvalidArgument(
            "{}: the data must have one experiment, but they have {}; select one with data:experiment(k)", method.name,
            data.experiments.size());
    if (data.input_count() != 1 || data.output_count() != 1)
        throw InvalidArgument("{} requires one input and one output, but the data have {} and {}", method.name,
                              data.input_count(), data.output_count());
    check_transfer_data(method.name, data, structure);
    if (structure.poles.front() > kMaxEvolvingPoles)
        throw InvalidArgument("{} supports up to {} poles, but {} were requested", method.name, kMaxEvolvingPoles,
                              structure.poles.front());
}

void check_fixed_model(const RecursiveName& method, const TransferFunction& model, const TransferStructure& structure) {
    if (!model.continuous() || model.pole_count() != structure.poles.front() ||
        model.zero_count() > structure.channels.front().zeros)
        throw InvalidArgument(
            "{}: option 'model' must be a continuous-time model with {} and no more than {}, as specified by the "
            "orders",
            method.name, plural(structure.poles.front(), "{} pole", "{} poles"),
            plural(structure.channels.front().zeros, "{} zero", "{} zeros"));
    if (!model.stable())
        throw InvalidArgument(
            "{}: option 'model' must be a stable model, because its simulated output is the instrument", method.name);
}

}  // namespace

void RecursiveOptions::validate(const std::string& method, Index parameters) const {
    if (!(lambda > 0) || !std::isfinite(lambda))
        throw InvalidArgument(
            "lambda, the cutoff frequency of the filter, must be a positive number of rad/s, but is {}. Choose a value "
            "slightly above the bandwidth of the system",
            lambda);
    if (!(forgetting > 0 && forgetting <= 1))
        throw InvalidArgument(
            "{}: the forgetting factor must be greater than 0 and at most 1 (1: no forgetting; 0.99: a memory of about "
            "100 samples), but is {}",
            method, forgetting);
    if (drift.size() > 0 && drift.size() != parameters)
        throw InvalidArgument(
            "{}: option 'drift' must have one variance for each of the {} parameters, or one for all, but has {}",
            method, parameters, drift.size());
    if (!drift.allFinite() || (drift.array() < 0).any())
        throw InvalidArgument("{}: the variances in option 'drift' must be nonnegative", method);
    if (noise_variance && !(*noise_variance > 0 && std::isfinite(*noise_variance)))
        throw InvalidArgument("{}: {} must be positive, but is {}", method, OptionName{"noise_variance"},
                              *noise_variance);
    if (history_points < 1)
        throw InvalidArgument("{}: {} must be at least 1, but is {}", method, OptionName{"history_points"},
                              history_points);
}

Fit recursive_pass(const RecursiveName& method, RecursiveMethod kind, const IdData& data,
                   const TransferStructure& structure, const RecursiveOptions& options) {
    check_recursive_data(method, data, structure);
    options.validate(method.name, structure.parameter_count());
    if (options.model) check_fixed_model(method, *options.model, structure);
    const Samples samples = samples_of(method, data, structure.channels.front().delay, options.hold_y);
    const std::unique_ptr<AnyPass> pass = pass_of(kind, samples, structure, options, data.mean_step());
    const Index N = data.sample_count(), d = structure.parameter_count();
    if (options.model) {
        Vector theta(d);
        theta << options.model->den().tail(structure.poles.front()), Vector::Zero(d - structure.poles.front());
        theta.tail(options.model->num().size()) = options.model->num();
        pass->begin_with(theta, N);
    } else if (kind != RecursiveMethod::kLeastSquares) {
        const Index batch = first_batch(data, d, options.lambda);
        pass->begin_with(first_model(data, structure, options, batch), batch);
    }
    return run_pass(*pass, method, data, structure, options);
}

}  // namespace dynlab::inline numerics
