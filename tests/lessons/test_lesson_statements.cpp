// What the lessons say of luck, bias and scatter. Oracles: Fisher's information and the limits of least squares, worked
// out here from the simulators' equations, and experiments repeated with another random generator.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "data_io/csv_file.h"
#include "documents/percent_script.h"
#include "documents/text_lines.h"
#include "lesson_record.h"

namespace dynlab::test {
namespace test_lesson_statements {
using nlohmann::json;
using testing::HasSubstr;

std::string script_of(const std::string& lesson) {
    return DYNLAB_SOURCE_DIR "/lessons/" + lesson + "/lesson.lua";
}

json record_of_code(const std::string& code) {
    const Workbench bench(Workbench::Memory::kShared);
    bench.write("oracle.lua", code);
    const ChildResult run = bench.dynlab({"run", "oracle.lua", "--out", "made"});
    EXPECT_EQ(run.exit_code, 0) << run.error_output;
    return json::parse(bench.read("made/record.json"));
}

/// A cell of a table. "−1.5 ± 0.2" and "3.2 (0.3)" give the number and the value after it.
std::pair<double, double> cell(const json& record, const std::string& table, int row, int column) {
    std::string text = record.at("tables").at(table).at("rows").at(row).at(column);
    text = replaced(replaced(text, "−", "-"), " ± ", " (");
    const auto bracket = text.find('(');
    return {std::stod(text), bracket == text.npos ? 0 : std::stod(text.substr(bracket + 1))};
}

class lesson_pages : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(all, lesson_pages, testing::ValuesIn(lesson_slugs(false)),
                         [](const auto& lesson) { return lesson.param; });

std::size_t characters(const std::string& line) {
    return std::count_if(line.begin(), line.end(), [](unsigned char c) { return (c & 0xC0) != 0x80; });
}

// Oracle: as many characters of the code's type as a line of the page holds, counted in a PDF.
TEST_P(lesson_pages, have_no_code_that_wraps) {
    const std::size_t max_length = 84;
    std::ifstream file(script_of(GetParam()));
    bool printed = false;
    int number = 0;
    for (std::string line; std::getline(file, line);) {
        ++number;
        if (line.starts_with("-- %%"))
            printed = line.find("[markdown]") == line.npos && line.find("echo=false") == line.npos;
        EXPECT_TRUE(!printed || characters(line) <= max_length) << GetParam() << ":" << number << ": " << line;
    }
}

// The same for the code that replaces the solution in students' copies.
TEST(lesson_sheets, have_no_starter_that_wraps) {
    const std::string mark = "-- STARTER: ";
    for (const std::string& lesson : lesson_slugs()) {
        std::ifstream file(script_of(lesson));
        bool code = false;
        int number = 0;
        for (std::string line; std::getline(file, line);) {
            ++number;
            if (line.starts_with("-- %%"))
                code = line.find("[markdown]") == line.npos && line.find("echo=false") == line.npos;
            EXPECT_TRUE(!code || !line.starts_with(mark) || characters(line) <= 84 + mark.size())
                << lesson << ":" << number << ": " << line;
        }
    }
}

// The same for the code that students receive in lessons with a special report template.
TEST(lesson_sheets, have_no_code_that_wraps) {
    for (const std::string& lesson : lesson_slugs(true)) {
        std::ifstream file(script_of(lesson));
        bool given = true;
        int number = 0;
        for (std::string line; std::getline(file, line);) {
            ++number;
            if (line == "-- BEGIN SOLUTION") given = false;
            EXPECT_TRUE(!given || line.starts_with("-- ") || characters(line) <= 84) << lesson << ":" << number;
            if (line == "-- END SOLUTION") given = true;
        }
    }
}

TEST_P(lesson_pages, show_every_figure_with_number_and_caption) {
    const json record = record_of_lesson(GetParam());
    const std::string text = read_percent_script(script_of(GetParam())).source;
    for (const auto& [name, figure] : record.at("figures").items())
        EXPECT_THAT(text, HasSubstr("](figure:" + name + "){#fig:")) << "no caption for the figure " << name;
}

TEST_P(lesson_pages, explain_to_students_how_results_reach_the_page) {
    const Workbench bench(Workbench::Memory::kShared);
    ASSERT_EQ(bench.dynlab({"new", GetParam(), "mine"}).exit_code, 0);
    std::istringstream copy(bench.read("mine/analysis.lua"));
    int explained = 0;
    for (std::string line; std::getline(copy, line);) {
        if (line.find("_report echo=false") == line.npos) continue;
        std::string next;
        std::getline(copy, next);
        EXPECT_THAT(next, testing::StartsWith("-- ")) << line;
        ++explained;
    }
    EXPECT_GT(explained, 3);
    EXPECT_THAT(bench.read("mine/analysis.lua"), HasSubstr("![caption](figure:name){#fig:name}"));
}

/// Standard deviations that the Cramér–Rao bound allows for white noise of this standard deviation.
Vector least_deviations(const Matrix& sensitivity, double noise) {
    return noise * (sensitivity.transpose() * sensitivity).inverse().diagonal().cwiseSqrt();
}

// The heat exchanger as SOURCE.md states it: 301 samples every 2 s, a step of 20 % after 60 s.
struct Exchanger {
    double gain = 0.5015, time_constant = 76.24, period = 2, step_at = 60, step = 20;
    double noise = std::hypot(0.1, 0.01 / std::sqrt(12.0));  // the sensor's and that of rounding
    Index samples = 301;

    double shape(double since_step, double T) const { return since_step <= 0 ? 0 : 1 - std::exp(-since_step / T); }
    double since_step(Index k) const { return static_cast<double>(k) * period - step_at; }
    /// Derivatives of the output by gain, time constant, level and, if asked for, an initial deviation.
    Matrix sensitivity(bool any_start) const {
        Matrix J(samples, any_start ? 4 : 3);
        for (Index k = 0; k < samples; ++k) {
            const double t = since_step(k), T = time_constant;
            J(k, 0) = step * shape(t, T);
            J(k, 1) = t <= 0 ? 0 : -gain * step * std::exp(-t / T) * t / (T * T);
            J(k, 2) = 1;
            if (any_start) J(k, 3) = std::exp(-static_cast<double>(k) * period / T);
        }
        return J;
    }
    /// The time constant to which a first-order model without dead time tends when there is one.
    double without_dead_time(double dead_time) const {
        double best = 0, least = std::numeric_limits<double>::infinity();
        for (double T = 60; T < 150; T += 0.05) {
            Matrix Phi(samples, 2);
            Vector y(samples);
            for (Index k = 0; k < samples; ++k) {
                Phi.row(k) << shape(since_step(k), T), 1;
                y[k] = gain * step * shape(since_step(k) - dead_time, time_constant);
            }
            const double loss = (y - Phi * Phi.householderQr().solve(y)).squaredNorm();
            if (loss < least) std::tie(best, least) = std::pair(T, loss);
        }
        return best;
    }
};

TEST(lesson_01_statements, of_errors_follow_from_fishers_information) {
    const json record = record_of_lesson("01_process_models");
    const Exchanger plant;
    const Vector known = least_deviations(plant.sensitivity(false), plant.noise);
    const Vector any = least_deviations(plant.sensitivity(true), plant.noise);
    const double of_noise = 1 / std::sqrt(2.0 * 301);  // relative error of a noise's standard deviation
    EXPECT_NEAR(number(record, "K_std"), known[0], 4 * of_noise * known[0]);
    EXPECT_NEAR(number(record, "K_any_std"), any[0], 4 * of_noise * any[0]);
    EXPECT_NEAR(number(record, "K_any_ratio"), any[0] / known[0], 0.05 * any[0] / known[0]);
    EXPECT_NEAR(number(record, "reported"), known[1], 0.02 * known[1]);
    EXPECT_NEAR(number(record, "estimate_std"), known[1], 4 * known[1] / std::sqrt(2.0 * 200));
    EXPECT_NEAR(number(record, "estimate_mean"), plant.time_constant, 4 * known[1] / std::sqrt(200.0));
    // an independent repetition of the reading found a scatter of 1.7 s
    EXPECT_NEAR(number(record, "reading_std"), 1.7, 4 * 1.7 / std::sqrt(2.0 * 200));
    EXPECT_LT(number(record, "T_apart"), 2 * number(record, "reading_std")) << "both methods agree";
}

TEST(lesson_01_statements, of_settling_and_dead_time_follow_from_the_records) {
    const json record = record_of_lesson("01_process_models");
    const CsvTable table = read_csv_file(DYNLAB_SOURCE_DIR "/data/heat_exchanger/heat_exchanger.csv");
    const Vector& y = table.columns[std::find(table.names.begin(), table.names.end(), "y") - table.names.begin()];
    const double first = y.head(30).mean(), last = y.tail(51).mean();
    Index outside = 300;
    while (std::abs(y[outside] - last) <= 0.05 * (last - first)) --outside;
    EXPECT_EQ(number(record, "Tr_raw"), Exchanger{}.since_step(outside));

    const auto [T, T_error] = cell(record, "dead_time", 2, 1);
    const auto [D, D_error] = cell(record, "dead_time", 2, 2);
    EXPECT_NEAR(T, Exchanger{}.time_constant, 4 * T_error);
    EXPECT_NEAR(D, 20, 4 * D_error);
    EXPECT_NEAR(cell(record, "dead_time", 4, 1).first, Exchanger{}.without_dead_time(20), 2);
}

struct Estimates {
    std::vector<double> values;
    double mean() const { return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size()); }
    double deviation() const {
        double sum = 0;
        for (const double v : values) sum += (v - mean()) * (v - mean());
        return std::sqrt(sum / double(values.size() - 1));
    }
};

/// Slope of the line through the points (x, y).
double slope(const Vector& x, const Vector& y) {
    const Vector apart = x.array() - x.mean();
    return apart.dot(y) / apart.squaredNorm();
}

// dy/dt = -y + 2 u, u = 1: four samples every 0.5 s of output and derivative, noise of 0.05 on both.
TEST(lesson_02_statements, of_four_samples_agree_with_another_random_generator) {
    const json record = record_of_lesson("02_least_squares");
    std::mt19937 random(2);
    std::normal_distribution<double> noise(0, 0.05);
    Estimates continuous, discrete;
    for (int run = 0; run < 20000; ++run) {
        Vector y(4), rate(4);
        for (Index k = 0; k < 4; ++k) {
            const double decay = std::exp(-0.5 * double(k));
            y[k] = 2 * (1 - decay) + noise(random);
            rate[k] = 2 * decay + noise(random);
        }
        continuous.values.push_back(-slope(y, rate));
        discrete.values.push_back(-slope(y.head(3), y.tail(3)));
    }
    for (const auto& [name, expected] : {std::pair("few_ct", continuous), {"few_dt", discrete}}) {
        const double error = expected.deviation() * std::sqrt(1 / 5000.0 + 1 / 20000.0);
        EXPECT_NEAR(number(record, name), expected.mean(), 4 * error) << name;
        EXPECT_NEAR(number(record, std::string(name) + "_std"), expected.deviation(), 0.08 * expected.deviation());
    }
}

// Oracle: (R + sigma^2 E)^-1 R theta for an input whose bits of four samples are drawn by chance.
TEST(lesson_02_statements, of_long_records_follow_the_limit_of_least_squares) {
    const json record = record_of_lesson("02_least_squares");
    const double a1 = -std::exp(-0.5), b1 = 2 * (1 - std::exp(-0.5));
    std::mt19937 random(3);
    Eigen::Matrix2d R = Eigen::Matrix2d::Zero();
    double x = 0, u = 1;
    const int samples = 400000;
    for (int k = 0; k < samples; ++k) {
        if (k % 4 == 0) u = random() % 2 ? 1 : -1;
        const Eigen::Vector2d phi(-x, u);
        R += phi * phi.transpose() / samples;
        x = -a1 * x + b1 * u;
    }
    Eigen::Matrix2d E = Eigen::Matrix2d::Zero();
    E(0, 0) = 0.3 * 0.3;
    const double limit = (R + E).inverse().row(0).dot(R * Eigen::Vector2d(a1, b1));
    EXPECT_NEAR(number(record, "mc_limit"), limit, 0.003) << "400 samples of one sequence";
    EXPECT_NEAR(number(record, "mc_mean"), number(record, "mc_limit"), 0.002);
    for (int row = 0; row < 5; ++row) {
        const double scatter = cell(record, "law", row, 5).first;
        EXPECT_NEAR(cell(record, "law", row, 3).first, cell(record, "law", row, 4).first,
                    4 * scatter / std::sqrt(300.0) + 1e-4);
    }
    EXPECT_NEAR(cell(record, "law", 1, 5).first / cell(record, "law", 3, 5).first, 2, 0.4) << "scatter over sqrt(N)";
    EXPECT_NEAR(cell(record, "law", 1, 3).first / cell(record, "law", 0, 3).first, 9, 1) << "bias over sigma^2";
}

// Oracle: the loss of models whose delay is held at whole samples.
TEST(lesson_03_statements, of_delays_hold_near_the_minimum_and_far_from_it) {
    const json losses = record_of_code(R"(
local L = load("linear_system")
local est = iddata(L.y, L.u, 0.05)
local Td, fig, D = delayest(est)
for _, samples in ipairs{0, 1, 2, 3, 5, 8, 12} do
    local G = srivc(est, {2, 3, samples})
    report.value("held_" .. samples, mean((L.y - lsim(G, L.u, 0.05))^2), "%.6f")
    report.value("curve_" .. samples, interp1(D.delays, D.losses, vector{0.05*samples})[1], "%.6f")
end
)");
    for (const char* samples : {"0", "1", "2", "3", "5", "8", "12"}) {
        const double held = number(losses, std::string("held_") + samples);
        EXPECT_NEAR(number(losses, std::string("curve_") + samples), held, 0.005 * held) << samples;
    }
}

TEST(lesson_03_statements, of_the_noise_model_agree_with_an_independent_program) {
    const json record = record_of_lesson("03_workflow");
    EXPECT_NEAR(number(record, "dryer_ar"), 0.906, 0.021);
    EXPECT_NEAR(number(record, "dryer_noise_val"), 91.2, 0.1);
    EXPECT_LT(number(record, "dryer_noise_val"), number(record, "dryer_val_short"));
}

// Oracle: what arx tends to, (R + sigma^2 E)^-1 R theta, from a recursion of the sampled system 1/(s+1) - 1/(s+3).
TEST(lesson_04_statements, of_arx_follow_the_limit_of_least_squares) {
    const json record = record_of_lesson("04_estimators");
    const json limits = record_of_code(R"(
local function tends_to(period, snr)
    local p, q = math.exp(-period), math.exp(-3*period)
    local u = prbs(4, math.floor(1/period + 0.5))
    local N, x, slow, fast = #u, {}, 0, 0
    for k = 1, N do
        x[k] = slow - fast
        slow, fast = p*slow + (1 - p)*u[k], q*fast + (1 - q)*u[k]/3
    end
    local R, r, total, squares = zeros(4, 4), zeros(4), 0, 0
    for k = 1, N do total, squares = total + x[k], squares + x[k]^2 end
    local sigma = math.sqrt(squares/N - (total/N)^2)/10^(snr/20)
    for k = 3, N do
        local phi = {-x[k - 1], -x[k - 2], u[k - 1], u[k - 2]}
        for i = 1, 4 do
            for j = 1, 4 do R[{i, j}] = R[{i, j}] + phi[i]*phi[j] end
            r[i] = r[i] + phi[i]*x[k]
        end
    end
    for i = 1, 2 do R[{i, i}] = R[{i, i}] + (N - 2)*sigma^2 end
    local theta = solve(R, r)
    local middle, product = -theta[1]/2, theta[2]
    local distance = middle^2 - product
    local convertible = distance < 0 or middle > math.sqrt(distance)
    return convertible and -math.log(product)/period or 0
end
for i, period in ipairs{0.01, 0.05, 0.1, 0.2, 0.3} do
    for j, snr in ipairs{5, 15, 25, 35, 45} do
        report.value("a1_" .. i .. "_" .. j, tends_to(period, snr), "%.6f")
    end
end
)");
    int converted = 0;
    for (int row = 0; row < 5; ++row) {
        for (int column = 0; column < 5; ++column) {
            const double limit = number(limits, "a1_" + std::to_string(row + 1) + "_" + std::to_string(column + 1));
            const std::string text = record.at("tables").at("grid").at("rows").at(row).at(column + 1);
            EXPECT_EQ(text.find("of 100") != text.npos, limit == 0) << text << " where the limit is " << limit;
            if (limit == 0) continue;
            const auto [mean, scatter] = cell(record, "grid", row, column + 1);
            EXPECT_NEAR(mean, limit, 4 * scatter / 10 + 0.005) << row << ", " << column;
            ++converted;
        }
    }
    EXPECT_GT(converted, 5);
    for (int row = 0; row < 5; ++row)
        EXPECT_THAT(record.at("tables").at("grid").at("rows").at(row).at(1).get<std::string>(), HasSubstr("of 100"))
            << "no sampling time helps at 5 dB";
}

// Oracle: the Cramér–Rao bound 0.2869 of an independent program, the errors that means and deviations of runs have.
TEST(lesson_04_statements, of_scatter_stay_within_what_the_runs_can_show) {
    const json record = record_of_lesson("04_estimators");
    const double bound = 0.2869, of_200 = 1 / std::sqrt(2.0 * 199), of_2000 = 1 / std::sqrt(2.0 * 1999);
    EXPECT_NEAR(number(record, "std_error"), 100 * of_200, 1e-9);
    for (const char* name : {"tf_bound", "tf_over", "iv_over"})
        EXPECT_NEAR(number(record, name), 1, 4 * of_200) << name;
    EXPECT_GT(number(record, "ls_over"), 1 + 4 * of_200);
    EXPECT_GT(number(record, "root_std"), bound * (1 - 4 * of_2000));
    EXPECT_LT(number(record, "root_std"), number(record, "three_std")) << "the filter nearest to A scatters less";
    EXPECT_NEAR(number(record, "iv_more"), 100 * (number(record, "three_std") / bound - 1),
                4 * number(record, "iv_more_error") + 4 * 100 * of_2000);
    for (const char* name : {"low", "high"})
        EXPECT_GT(number(record, std::string(name) + "_mean"),
                  4 + 2 * number(record, std::string(name) + "_mean_error"));
}

}  // namespace test_lesson_statements
}  // namespace dynlab::test
