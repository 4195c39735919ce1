#include "numerics/plants/crane_experiments.h"

#include <cmath>
#include <utility>

#include "numerics/linalg/side_by_side.h"
#include "numerics/plants/plant_data.h"

namespace dynlab::inline numerics {
namespace {

Vector joined(const std::vector<Vector>& parts) {
    Index count = 0;
    for (const Vector& part : parts) count += part.size();
    Vector all(count);
    count = 0;
    for (const Vector& part : parts) {
        all.segment(count, part.size()) = part;
        count += part.size();
    }
    return all;
}

/// One run of experiments: who drives the crane and reads its sensors.
class Experimenter {
  public:
    Experimenter(const CraneParameters& crane, const CraneExperiments& plan, std::uint32_t seed)
        : crane_(crane), plan_(plan), random_(seed) {}

    Vector held(double voltage, double duration) const {
        return Vector::Constant(static_cast<Index>(std::llround(duration / plan_.Ts)), voltage);
    }
    Vector quiet() const { return held(0, plan_.quiet_time); }
    Vector prbs() {
        return seeded_prbs(plan_.prbs_stages, plan_.prbs_hold, -plan_.prbs_amplitude, plan_.prbs_amplitude, random_);
    }

    /// Where the trolley must start so that the way it will go, as speed follows voltage, lies in the rail's middle.
    double centered_start(const Vector& u) const {
        double way = 0, lowest = 0, highest = 0;
        for (double voltage : u) {
            way += crane_truth(crane_).speed_gain * voltage * plan_.Ts;
            lowest = std::min(lowest, way);
            highest = std::max(highest, way);
        }
        return -(lowest + highest) / 2;
    }

    /// A planned experiment, with the random numbers for the noise of its sensors; only the response is not yet
    /// computed.
    struct Plan {
        CraneData data_set;
        CraneState start;
        Vector position_normals, angle_normals;
    };

    Plan plan(std::string name, const Vector& u, double start_position, double start_angle = 0) {
        CraneState start;
        start.motor_position = start.position = start_position;
        start.angle = start_angle;
        const Index N = u.size();
        CraneData data_set{std::move(name), Vector::LinSpaced(N, 0, static_cast<double>(N - 1)) * plan_.Ts, u,
                           Vector(N), Vector(N)};
        const Vector position_normals = random_.normal(N);
        return {std::move(data_set), start, position_normals, random_.normal(N)};
    }

    CraneData run(Plan requested) const {
        CraneSimulator crane(crane_, requested.start);
        CraneData& data_set = requested.data_set;
        for (Index k = 0; k < data_set.u.size(); ++k) {
            data_set.x[k] = crane.state().position;
            data_set.theta[k] = crane.state().angle + plan_.angle_offset;
            crane.advance(data_set.u[k], plan_.Ts);
        }
        data_set.x = measure(data_set.x, 0, plan_.position_resolution, requested.position_normals);
        data_set.theta =
            measure(data_set.theta, plan_.angle_noise_std, plan_.angle_resolution, requested.angle_normals);
        return std::move(data_set);
    }

    Plan random_experiment(std::string name) {
        const Vector u = joined({quiet(), prbs()});
        return plan(std::move(name), u, centered_start(u));
    }

    Plan steps() {
        return plan("steps",
                    joined({quiet(), held(2, 1.5), held(0, 4), held(-2, 1.5), held(0, 4), held(4, 0.75), held(0, 4),
                            held(-4, 0.75), held(0, 4)}),
                    -0.1);
    }

    Plan limits() {
        const Vector random_part = prbs();
        const Index third = random_part.size() / 3;
        const Vector before = random_part.head(third), after = random_part.tail(random_part.size() - third);
        return plan(
            "limits",
            joined({quiet(), before, held(12, 1.2), held(0, 1), held(-12, 1.8), held(0, 1), held(3, 2.6), after}),
            centered_start(before));
    }

  private:
    const CraneParameters& crane_;
    const CraneExperiments& plan_;
    RandomStream random_;
};

}  // namespace

void CraneExperiments::validate() const {
    const char* plant = "crane";
    require_positive(plant, "sampling time", Ts, "PRBS amplitude", prbs_amplitude);
    require_not_negative(plant, "quiet time", quiet_time, "release angle", release_angle, "position resolution",
                         position_resolution, "angle noise", angle_noise_std, "angle resolution", angle_resolution,
                         "angle offset", std::abs(angle_offset));
}

std::vector<CraneData> simulate_crane(const CraneParameters& parameters, const CraneExperiments& experiments,
                                      std::uint32_t seed) {
    experiments.validate();
    Experimenter experimenter(parameters, experiments, seed);
    // All random numbers are drawn in the order of the experiments; after that each experiment can be simulated
    // separately.
    std::vector<Experimenter::Plan> plans;
    plans.push_back(experimenter.random_experiment("estimation"));
    plans.push_back(experimenter.random_experiment("validation"));
    plans.push_back(experimenter.steps());
    plans.push_back(experimenter.plan("free_swing", experimenter.held(0, 20), 0, experiments.release_angle));
    plans.push_back(experimenter.limits());
    std::vector<CraneData> data_sets(plans.size());
    side_by_side(plans.size(), [&](std::size_t i) { data_sets[i] = experimenter.run(std::move(plans[i])); });
    return data_sets;
}

}  // namespace dynlab::inline numerics
