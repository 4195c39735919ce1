#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "numerics/linalg/matrix_exponential.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/models/process_model.h"
#include "numerics/simulation/lsim.h"

namespace dynlab {
namespace {

const std::string kFolder = std::string(DYNLAB_SOURCE_DIR) + "/tests/reference/data/";

std::string file_text(const std::string& name) {
    std::ifstream file(kFolder + name);
    EXPECT_TRUE(file) << name;
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// The numbers of a JSON array after a key, in order, whatever its nesting; `end` becomes the place behind it.
Vector numbers_after(const std::string& text, const std::string& key, std::size_t& end) {
    end = text.find('[', text.find("\"" + key + "\"", end));
    std::vector<double> values;
    int depth = 0;
    do {
        if (text[end] == '[') ++depth;
        if (text[end] == ']') --depth;
        if (std::isdigit(static_cast<unsigned char>(text[end])) || text[end] == '-') {
            std::size_t length = 0;
            values.push_back(std::stod(text.substr(end, 40), &length));
            end += length - 1;
        }
        ++end;
    } while (depth > 0);
    return Eigen::Map<Vector>(values.data(), static_cast<Index>(values.size()));
}

/// Largest difference, each entry relative to its own magnitude.
double relative_difference(const Vector& value, const Vector& reference) {
    return ((value - reference).array() / reference.array().abs()).abs().maxCoeff();
}

TEST(discretisation_data, step_matrices_of_four_filters) {  // oracle: reference data, 80-bit arithmetic
    const std::string text = file_text("discretisation_longdouble.json");
    constexpr double kTolerance = 5e-14;  // entries of F lose up to two digits to cancellation of their own series
    int filters = 0;
    for (std::size_t at = 0; text.find("\"den\"", at) != std::string::npos; ++filters) {
        const Vector den = numbers_after(text, "den", at);
        const Vector F = numbers_after(text, "F", at), G = numbers_after(text, "G_zoh", at);
        const Vector H0 = numbers_after(text, "H0_foh", at), H1 = numbers_after(text, "H1_foh", at);
        const Index n = den.size() - 1;
        const StepMatrices step = exact_step(companion(den), Vector::Unit(n, 0), 0.01);
        const Matrix rows = step.F.transpose();
        EXPECT_LT(relative_difference(rows.reshaped(), F), kTolerance) << den.transpose();
        EXPECT_LT(relative_difference(step.G, G), kTolerance) << den.transpose();
        EXPECT_LT(relative_difference(step.H0, H0), kTolerance) << den.transpose();
        EXPECT_LT(relative_difference(step.H1, H1), kTolerance) << den.transpose();
    }
    EXPECT_EQ(filters, 4);
}

struct Record {
    Vector u, y;
};

Record read_record(const std::string& name) {
    std::istringstream text(file_text(name));
    std::string line;
    std::getline(text, line);
    std::vector<double> u, y;
    while (std::getline(text, line)) {
        const std::size_t first = line.find(','), second = line.find(',', first + 1);
        u.push_back(std::stod(line.substr(first + 1)));
        y.push_back(std::stod(line.substr(second + 1)));
    }
    return {Eigen::Map<Vector>(u.data(), static_cast<Index>(u.size())),
            Eigen::Map<Vector>(y.data(), static_cast<Index>(y.size()))};
}

double output_difference(const TransferFunction& G, const std::string& file, double Ts) {
    const Record record = read_record(file);
    return (lsim(G, record.u, Ts) - record.y).cwiseAbs().maxCoeff() / record.y.cwiseAbs().maxCoeff();
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

}  // namespace
}  // namespace dynlab
