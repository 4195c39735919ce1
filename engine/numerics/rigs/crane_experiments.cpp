#include "numerics/rigs/crane_experiments.h"

#include <cmath>
#include <utility>

#include "numerics/rigs/seeded_prbs.h"
#include "numerics/rigs/sensor.h"

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
    double centred_start(const Vector& u) const {
        double way = 0, lowest = 0, highest = 0;
        for (double voltage : u) {
            way += crane_truth(crane_).speed_gain * voltage * plan_.Ts;
            lowest = std::min(lowest, way);
            highest = std::max(highest, way);
        }
        return -(lowest + highest) / 2;
    }

    CraneRecord run(std::string name, const Vector& u, double start_position, double start_angle = 0) {
        CraneState start;
        start.motor_position = start.position = start_position;
        start.angle = start_angle;
        CraneSimulator crane(crane_, start);
        CraneRecord record{std::move(name),
                           Vector::LinSpaced(u.size(), 0, static_cast<double>(u.size() - 1)) * plan_.Ts, u,
                           Vector(u.size()), Vector(u.size())};
        for (Index k = 0; k < u.size(); ++k) {
            record.x[k] = crane.state().position;
            record.theta[k] = crane.state().angle + plan_.angle_offset;
            crane.advance(u[k], plan_.Ts);
        }
        record.x = measure(record.x, 0, plan_.position_resolution, random_);
        record.theta = measure(record.theta, plan_.angle_noise_std, plan_.angle_resolution, random_);
        return record;
    }

    CraneRecord random_record(std::string name) {
        const Vector u = joined({quiet(), prbs()});
        return run(std::move(name), u, centred_start(u));
    }

    CraneRecord steps() {
        return run("steps",
                   joined({quiet(), held(2, 1.5), held(0, 4), held(-2, 1.5), held(0, 4), held(4, 0.75), held(0, 4),
                           held(-4, 0.75), held(0, 4)}),
                   -0.1);
    }

    CraneRecord limits() {
        const Vector random_part = prbs();
        const Index third = random_part.size() / 3;
        const Vector before = random_part.head(third), after = random_part.tail(random_part.size() - third);
        return run(
            "limits",
            joined({quiet(), before, held(12, 1.2), held(0, 1), held(-12, 1.8), held(0, 1), held(3, 2.6), after}),
            centred_start(before));
    }

  private:
    const CraneParameters& crane_;
    const CraneExperiments& plan_;
    RandomStream random_;
};

}  // namespace

void CraneExperiments::validate() const {
    const char* rig = "crane";
    require_positive(rig, "sampling time", Ts);
    require_not_negative(rig, "quiet time", quiet_time);
    require_positive(rig, "PRBS amplitude", prbs_amplitude);
    require_not_negative(rig, "release angle", release_angle);
    require_not_negative(rig, "position resolution", position_resolution);
    require_not_negative(rig, "angle noise", angle_noise_std);
    require_not_negative(rig, "angle resolution", angle_resolution);
    require_not_negative(rig, "angle offset", std::abs(angle_offset));
}

std::vector<CraneRecord> simulate_crane(const CraneParameters& parameters, const CraneExperiments& experiments,
                                        std::uint32_t seed) {
    experiments.validate();
    Experimenter experimenter(parameters, experiments, seed);
    std::vector<CraneRecord> records;
    records.push_back(experimenter.random_record("estimation"));
    records.push_back(experimenter.random_record("validation"));
    records.push_back(experimenter.steps());
    records.push_back(experimenter.run("free_swing", experimenter.held(0, 20), 0, experiments.release_angle));
    records.push_back(experimenter.limits());
    return records;
}

}  // namespace dynlab::inline numerics
