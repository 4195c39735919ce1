#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "course/grading/class_statistics.h"

namespace dynlab::test {
namespace test_class_statistics {
using ::testing::ElementsAre;
using ::testing::Pair;

Grade work(const std::string& name, double a, double b, double c, const Message& said = {}) {
    Grade grade;
    grade.submission = name;
    for (const auto& [id, earned] : {std::pair("a", a), std::pair("b", b), std::pair("c", c)}) {
        CheckGrade check;
        check.id = id;
        check.about = Message::verbatim(id);
        check.points = 2;
        check.earned = earned;
        if (earned < 2 && id == std::string("a")) check.message = said;
        grade.checks.push_back(check);
    }
    return grade;
}

// oracle: counted and computed by hand. Points in a: 2 2 1 0 0, mean 1, deviations 1 1 0 -1 -1; in b and c together:
// 4 3 2 1 0, mean 2, deviations 2 1 0 -1 -2; correlation 6/sqrt(4*10).
TEST(class_statistics, are_those_counted_by_hand) {
    const std::vector<Grade> grades = {
        work("1", 2, 2, 2), work("2", 2, 1, 2), work("3", 1, 0, 2, Message("It is {} % away.", 3.2)),
        work("4", 0, 0, 1, Message("The sign is wrong.")), work("5", 0, 0, 0, Message("It is {} % away.", 1e-5))};
    const auto all = statistics_of_checks(grades);
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].graded, 5);
    EXPECT_EQ(all[0].passed, 2);
    EXPECT_DOUBLE_EQ(all[0].mean_share, 0.5);
    EXPECT_NEAR(all[0].discrimination, 6 / std::sqrt(40.0), 1e-12);
    EXPECT_THAT(all[0].mistakes, ElementsAre(Pair("It is ... % away.", 2), Pair("The sign is wrong.", 1)));
    const auto json = nlohmann::json::parse(class_statistics_json("04", grades));
    EXPECT_EQ(json.at("mean"), 3);
    EXPECT_EQ(json.at("median"), 3);
    EXPECT_EQ(json.at("checks").at(0).at("discrimination"), 0.9487);
    EXPECT_EQ(json.at("results").at(3).at("checks").at("c"), 1);
}

// oracle: the correlation without the works that failed to start, which have no points in any check
TEST(class_statistics, discrimination_leaves_out_works_without_an_answer) {
    std::vector<Grade> grades = {work("1", 2, 2, 2), work("2", 2, 1, 2), work("3", 1, 0, 2), work("4", 0, 0, 1),
                                 work("5", 0, 0, 0)};
    const double alone = statistics_of_checks(grades)[0].discrimination;
    for (int k = 0; k < 5; ++k) {
        grades.push_back(work("stopped", 0, 0, 0));
        grades.back().silent = true;
    }
    EXPECT_EQ(statistics_of_checks(grades)[0].discrimination, alone);
}

TEST(class_statistics, say_nothing_of_too_few_or_of_what_all_have) {
    const std::vector<Grade> few = {work("1", 2, 2, 2), work("2", 0, 1, 2)};
    EXPECT_TRUE(std::isnan(statistics_of_checks(few)[0].discrimination));
    const std::vector<Grade> same = {work("1", 2, 2, 2), work("2", 2, 0, 2), work("3", 2, 0, 0), work("4", 2, 1, 1),
                                     work("5", 2, 2, 1)};
    EXPECT_TRUE(std::isnan(statistics_of_checks(same)[0].discrimination));
    EXPECT_TRUE(
        nlohmann::json::parse(class_statistics_json("04", same)).at("checks").at(0).at("discrimination").is_null());
    std::vector<Grade> open = {work("1", 2, 2, 2), Grade()};
    open[0].checks[1].graded = false;
    EXPECT_EQ(statistics_of_checks(open)[1].graded, 0);
    EXPECT_TRUE(nlohmann::json::parse(class_statistics_json("04", open)).at("results").at(0).at("points").is_null());
}

}  // namespace test_class_statistics
}  // namespace dynlab::test
