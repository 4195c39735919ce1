#include <gtest/gtest.h>

#include <algorithm>

#include "numerics/estimators/learning/dmdc.h"
#include "numerics/estimators/learning/narx.h"
#include "support/reference_data.h"

namespace test_learning_reference {

using namespace dynlab;
using namespace dynlab::test;

// Oracle: tests/reference/data/learning_twins.py, the definitions on stored matrices in numpy.

Vector twin(const std::string& name) {
    std::vector<double> values;
    for (const auto& row : reference_rows("learning_twins.csv"))
        if (row[0] == name) values.push_back(std::stod(row[1]));
    return Vector::Map(values.data(), static_cast<Index>(values.size()));
}

IdData simulated_data(std::initializer_list<const char*> outputs) {
    auto columns = reference_columns("learning_record.csv");
    const auto N = static_cast<Index>(columns["u"].size());
    Matrix y(N, static_cast<Index>(outputs.size()));
    Index i = 0;
    for (const char* name : outputs) y.col(i++) = Vector::Map(columns[name].data(), N);
    return IdData(y, Matrix(Vector::Map(columns["u"].data(), N)), 1);
}

void expect_equal(const VectorView& found, const VectorView& expected) {
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.cwiseAbs().maxCoeff());
}

void expect_twin(const NarxFit& found, const IdData& data, const std::string& label) {
    const auto count = static_cast<Index>(found.model->terms().size());
    Vector terms(count), reductions(count);
    for (Index i = 0; i < count; ++i) {
        terms[i] = static_cast<double>(found.model->terms()[static_cast<std::size_t>(i)]);
        reductions[i] = found.steps[static_cast<std::size_t>(i)].error_reduction;
    }
    EXPECT_EQ(terms, twin(label + "_term"));
    expect_equal(found.fit.theta, twin(label + "_theta"));
    expect_equal(found.fit.std, twin(label + "_std"));
    expect_equal(reductions, twin(label + "_reduction"));
    const FreeRun run = found.model->free_run(data, 0, Vector());
    expect_equal(run.output.col(0).tail(20), twin(label + "_free"));
}

TEST(learning_reference, narx_equals_its_twin) {
    const IdData data = simulated_data({"y1"});
    const NarxLags lags{2, {2}, {1}};
    NarxOptions six;
    six.terms = 6;
    expect_twin(narx(data, lags, six), data, "narx6");
    expect_twin(narx(data, lags), data, "narxbic");
}

void expect_twin(const DmdcFit& found, const std::string& label) {
    ComplexVector sorted = found.eigenvalues;
    std::sort(sorted.begin(), sorted.end(), [](const Complex& a, const Complex& b) {
        return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
    });
    expect_equal(sorted.real(), twin(label + "_real"));
    EXPECT_LT((sorted.imag() - twin(label + "_imag")).cwiseAbs().maxCoeff(), 1e-9);
    Vector markov(20);
    Matrix x = found.system.B;
    for (Index k = 0; k < 10; ++k, x = found.system.A * x) markov.segment(2 * k, 2) = found.system.C * x;
    expect_equal(markov, twin(label + "_markov"));
}

TEST(learning_reference, dmdc_equals_its_twin) {
    const IdData data = simulated_data({"y1", "y2"});
    expect_twin(dmdc(data, {2, 1}), "dmdc1");
    expect_twin(dmdc(data, {4, 3}), "dmdc3");
}

}  // namespace test_learning_reference
