// What the worked report of lesson 3.2 says in words, held to a second route: the simulators' equations and
// parameters, the noise of their sensors, the scatter of repeated experiments.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>
#include <nlohmann/json.hpp>

#include "lesson_record.h"
#include "numerics/plants/crane.h"

namespace dynlab::test {
namespace test_report_statements {

/// Frequency (rad/s) of the swinging poles of the crane on a moving trolley: equations of motion with a rigid belt, no
/// inductance of the motor, no dry friction and small angles, as d/dt of (speed, angle, angle's rate).
double swing_of_moving_trolley() {
    const CraneParameters p;
    const double K = p.torque_constant * p.gear_ratio / p.pulley_radius;
    Eigen::Matrix2d mass;
    mass << p.trolley_mass + p.pendulum_mass + p.rotor_inertia * std::pow(p.gear_ratio / p.pulley_radius, 2),
        p.pendulum_mass * p.pendulum_length, p.pendulum_mass * p.pendulum_length,
        p.pendulum_inertia + p.pendulum_mass * p.pendulum_length * p.pendulum_length;
    Eigen::Matrix<double, 2, 3> force;  // of speed, angle, angle's rate
    force << -(K * K / p.resistance + p.motor_damping + p.trolley_damping), 0, 0, 0,
        -p.pendulum_mass * p.pendulum_length * p.gravity, -p.pivot_damping;
    const Eigen::Matrix<double, 2, 3> acceleration = mass.inverse() * force;
    Eigen::Matrix3d A;
    A << acceleration.row(0), 0, 0, 1, acceleration.row(1);
    for (const std::complex<double>& eigenvalue : A.eigenvalues())
        if (eigenvalue.imag() > 0) return std::abs(eigenvalue);
    return 0;
}

/// The cell of a table of numbers, "454 ± 3" being 454.
double cell(const nlohmann::json& record, const char* table, int row, int column) {
    return std::stod(record.at("tables").at(table).at("rows").at(row).at(column).get<std::string>());
}
double error_in_cell(const nlohmann::json& record, const char* table, int row, int column) {
    const std::string text = record.at("tables").at(table).at("rows").at(row).at(column);
    return std::stod(text.substr(text.find("± ") + 3));
}

TEST(report_statements, crane_is_evaluated_by_repetitions_and_by_its_equations) {
    const nlohmann::json record = record_of_lesson("03_crane");
    const CraneTruth truth = crane_truth({});
    const double gravity = CraneParameters{}.gravity;
    EXPECT_GT(number(record, "fit_theta"), number(record, "most_theta")) << "the text says that it was luck";
    EXPECT_NEAR(number(record, "true_swing"), swing_of_moving_trolley(), 5e-4);
    EXPECT_NEAR(number(record, "true_pendulum"), truth.natural_frequency, 5e-4);
    const int swing_row = 6, pendulum_row = 7, most_column = 4;
    EXPECT_LT(cell(record, "repetition", swing_row, most_column), swing_of_moving_trolley()) << "always too low";
    EXPECT_LT(cell(record, "repetition", pendulum_row, most_column), truth.natural_frequency) << "always too low";

    const int jointly = 3, scatter = 4, c1_row = 7;
    for (int row = 0; row < 9; ++row) {
        const double ratio =
            error_in_cell(record, "parameters", row, jointly) / cell(record, "parameters", row, scatter);
        if (row == c1_row) {
            EXPECT_LT(ratio, 0.5) << "the exception of which the text speaks";
        } else {
            EXPECT_GT(ratio, 0.5) << row;
            EXPECT_LT(ratio, 2.05) << row << ", both rounded";
        }
    }
    EXPECT_NEAR(number(record, "scatter_a3"), number(record, "scatter_a3_position"),
                0.2 * number(record, "scatter_a3_position"))
        << "the angle adds nothing";
    // Rows: position F (1,0), (2,0), (4,2); sF (1,0), (3,2), (4,3). YIC prefers the free model, BIC the last one, the
    // validation data the chosen one.
    const int unbound = 2, chosen = 4, rich = 5, yic = 4, bic = 5, validation_fit = 7;
    for (int row = 0; row < 6; ++row) {
        if (row != unbound) {
            EXPECT_GT(cell(record, "orders", row, yic), cell(record, "orders", unbound, yic)) << row;
        }
        if (row != rich) {
            EXPECT_GT(cell(record, "orders", row, bic), cell(record, "orders", rich, bic)) << row;
        }
        if (row != chosen) {
            EXPECT_LT(cell(record, "orders", row, validation_fit), cell(record, "orders", chosen, validation_fit))
                << row;
        }
    }
    EXPECT_GT(number(record, "scatter_a3_angle"), 4 * number(record, "scatter_a3"));

    // The physical model: what the simulator has, and the potentiometer's noise with its steps.
    const double sensor = 1e3 * std::hypot(2e-3, 1.5e-3 / std::sqrt(12.));
    EXPECT_NEAR(number(record, "left_physical"), sensor, 0.1);
    EXPECT_GT(number(record, "left_friction"), 2 * sensor) << "friction explains nothing of the angle";
    EXPECT_LT(number(record, "left_wide"), 1.2 * sensor) << "the wide swings explain it";
    EXPECT_NEAR(number(record, "grey_dry"), truth.dry_voltage, 0.03);
    EXPECT_NEAR(number(record, "grey_gain"), 1e3 * truth.speed_gain, 1.5);
    EXPECT_NEAR(number(record, "grey_length"), gravity / std::pow(truth.natural_frequency, 2), 0.001);
    const int friction_row = 1, physical_row = 3, steps_x = 5, steps_theta = 6;
    EXPECT_GT(cell(record, "nonlinear", friction_row, steps_x), 99) << "friction explains the pushes' position";
    EXPECT_GT(cell(record, "nonlinear", physical_row, steps_theta),
              cell(record, "nonlinear", friction_row, steps_theta) + 5);

    EXPECT_NEAR(number(record, "rise_p"), number(record, "rise_lqr"), 0.15) << "about as fast";
}

}  // namespace test_report_statements
}  // namespace dynlab::test
