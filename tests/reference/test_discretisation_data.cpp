#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/models/process_model.h"
#include "numerics/simulation/lsim.h"
#include "support/reference_data.h"

namespace dynlab {
namespace test_discretisation_data {

Vector numbers_of(const nlohmann::json& values) {
    Vector numbers(static_cast<Index>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
        numbers[static_cast<Index>(i)] =
            values[i].is_string() ? std::stod(values[i].get<std::string>()) : values[i].get<double>();
    return numbers;
}

Matrix rows_of(const nlohmann::json& values) {
    Matrix rows(static_cast<Index>(values.size()), static_cast<Index>(values.front().size()));
    for (std::size_t i = 0; i < values.size(); ++i) rows.row(static_cast<Index>(i)) = numbers_of(values[i]).transpose();
    return rows;
}

/// Largest difference, each entry relative to its own magnitude.
double relative_difference(const Matrix& value, const Matrix& reference) {
    return ((value - reference).array() / reference.array().abs()).abs().maxCoeff();
}

TEST(discretisation_data, step_matrices_of_four_filters) {  // oracle: reference data, 80-bit arithmetic
    constexpr double kTolerance = 5e-14;  // cancellation in the series costs entries of F up to two digits
    std::ifstream file(DYNLAB_SOURCE_DIR "/tests/reference/data/discretisation_longdouble.json");
    const nlohmann::json filters = nlohmann::json::parse(file);
    ASSERT_EQ(filters.size(), 4u);
    for (const nlohmann::json& filter : filters) {
        const Vector den = numbers_of(filter["den"]);
        const Index n = den.size() - 1;
        const double Ts = std::stod(filter["Ts"].get<std::string>());
        const StepMatrices step = exact_step(companion(den), Vector::Unit(n, 0), Ts);
        EXPECT_LT(relative_difference(step.F, rows_of(filter["F"])), kTolerance) << den.transpose();
        EXPECT_LT(relative_difference(step.G, numbers_of(filter["G_zoh"])), kTolerance) << den.transpose();
        EXPECT_LT(relative_difference(step.H0, numbers_of(filter["H0_foh"])), kTolerance) << den.transpose();
        EXPECT_LT(relative_difference(step.H1, numbers_of(filter["H1_foh"])), kTolerance) << den.transpose();
    }
}

double output_difference(const TransferFunction& G, const std::string& file, double Ts) {
    auto columns = test::reference_columns(file);
    const Index N = static_cast<Index>(columns["y"].size());
    const Vector y = Vector::Map(columns["y"].data(), N), u = Vector::Map(columns["u"].data(), N);
    return (lsim(G, u, Ts) - y).cwiseAbs().maxCoeff() / y.cwiseAbs().maxCoeff();
}

TEST(discretisation_data, simulated_outputs) {  // oracle: reference data, outputs of an independent program
    EXPECT_LT(output_difference(TransferFunction(Vector::Constant(1, 2.0), Eigen::Vector3d(1, 4, 3)),
                                "sys2_noisefree.csv", 0.01),
              1e-13);
    const Vector den = (Vector(5) << 1, 5, 408, 416, 1600).finished();
    EXPECT_LT(output_difference(TransferFunction(Eigen::Vector2d(-6400, 1600), den), "rg_noisefree.csv", 0.01), 1e-12);
}

TEST(discretisation_data, outputs_with_delays_between_samples) {  // oracle: reference data
    const auto process = [](const char* structure, Vector parameters) {
        return ProcessModel(ProcessStructure::parse(structure), std::move(parameters)).transfer_function();
    };
    EXPECT_LT(output_difference(process("P1D", Eigen::Vector3d(1.5, 0.8, 0.373)), "P1D_noisefree.csv", 0.05), 1e-13);
    EXPECT_LT(output_difference(process("P2D", Eigen::Vector4d(1.2, 1.0, 0.4, 0.255)), "P2D_noisefree.csv", 0.05),
              1e-13);
    EXPECT_LT(output_difference(process("P2DU", Eigen::Vector4d(0.9, 0.5, 0.35, 0.61)), "P2DU_noisefree.csv", 0.05),
              1e-13);
}

}  // namespace test_discretisation_data
}  // namespace dynlab
