#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <random>
#include <set>

#include "base/reader.h"
#include "course/review/allocation.h"
#include "numerics/error.h"

namespace dynlab::test {
namespace test_allocation {
/// The same numbers for the same seed.
UniformDraw fixed_draw(std::uint32_t seed) {
    return [random = std::mt19937(seed)](std::size_t below) mutable { return random() % below; };
}

/// How many reviews each group writes and gets.
struct Loads {
    std::vector<int> writes, gets;
};

Loads loads_of(const AllocationProblem& problem, const Allocation& allocation) {
    Loads loads{std::vector<int>(problem.groups), std::vector<int>(problem.groups)};
    for (const auto& [reviewer, author] : allocation.pairs) ++loads.writes[reviewer], ++loads.gets[author];
    return loads;
}

/// The rules that hold whatever happened before: own reports, doubles, kin (what is fixed aside), no orphan.
void expect_rules(const AllocationProblem& problem, const Allocation& allocation) {
    const std::set<ReviewEdge> once(allocation.pairs.begin(), allocation.pairs.end());
    ASSERT_EQ(once.size(), allocation.pairs.size()) << "a pair occurs twice";
    const std::set<ReviewEdge> fixed(problem.fixed.begin(), problem.fixed.end());
    for (const ReviewEdge& pair : fixed) ASSERT_TRUE(once.contains(pair)) << "what is fixed was lost";
    for (const ReviewEdge& pair : allocation.pairs) {
        ASSERT_NE(pair.first, pair.second);
        if (fixed.contains(pair)) continue;
        ASSERT_TRUE(problem.active[pair.first] && problem.active[pair.second]);
        for (const auto& [a, b] : problem.kin)
            ASSERT_FALSE(pair == ReviewEdge(a, b) || pair == ReviewEdge(b, a)) << "a common member";
    }
}

int spread(const AllocationProblem& problem, const std::vector<int>& loads) {
    int lowest = 1 << 20, highest = 0;
    for (int i = 0; i < problem.groups; ++i)
        if (problem.active[i]) lowest = std::min(lowest, loads[i]), highest = std::max(highest, loads[i]);
    return highest - lowest;
}

// oracle: the rules, over 2,000 random courses with late-comers and drop-outs
TEST(allocation, keeps_its_rules_in_random_courses) {
    std::mt19937 random(20260301);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    int swaps_where_avoidable = 0, unbalanced = 0;
    for (int course = 0; course < 2000; ++course) {
        AllocationProblem problem;
        const int size = course % 20 == 0 ? 3 + below(298) : 3 + below(40);
        problem.reviews = 1 + below(std::min(6, size - 1));
        const int late = below(std::max(2, size / 5));
        problem.groups = size + late;
        problem.active.assign(problem.groups, true);
        for (int i = size; i < problem.groups; ++i) problem.active[i] = false;
        const std::uint32_t seed = random();
        const Allocation first = allocate_reviews(problem, fixed_draw(seed));
        expect_rules(problem, first);
        ASSERT_EQ(first.pairs, allocate_reviews(problem, fixed_draw(seed)).pairs);
        const Loads loads = loads_of(problem, first);
        ASSERT_EQ(spread(problem, loads.writes), 0) << course;
        ASSERT_EQ(spread(problem, loads.gets), 0) << course;
        if (2 * problem.reviews < size) swaps_where_avoidable += first.swapped;

        AllocationProblem later = problem;
        for (int i = size; i < later.groups; ++i) later.active[i] = true;
        const int left = below(std::max(1, size / 6) + 1);
        for (int i = 0; i < left; ++i) later.active[below(size)] = false;
        const int state = below(3);  // nothing sent; all sent; some sent, some written
        for (const ReviewEdge& pair : first.pairs) {
            const bool both = later.active[pair.first] && later.active[pair.second];
            const bool written = state > 0 && below(4) == 0, sent = state == 1 || (state == 2 && below(2) == 0);
            (written || (sent && both) ? later.fixed : later.loose).push_back(pair);
        }
        const Allocation second = allocate_reviews(later, fixed_draw(seed));
        expect_rules(later, second);
        ASSERT_EQ(second.pairs, allocate_reviews(later, fixed_draw(seed)).pairs);
        const Loads after = loads_of(later, second);
        const int active = static_cast<int>(std::count(later.active.begin(), later.active.end(), true));
        const bool has_spare_reviewers = active > 2 * problem.reviews + 1;
        if (has_spare_reviewers && (spread(later, after.writes) > 1 || spread(later, after.gets) > 1)) {
            ++unbalanced;
            ADD_FAILURE() << "course " << course << ": size " << size << " late " << late << " left " << left
                          << " reviews " << problem.reviews << " state " << state << " spreads "
                          << spread(later, after.writes) << ' ' << spread(later, after.gets);
        }
    }
    EXPECT_EQ(swaps_where_avoidable, 0);
    EXPECT_EQ(unbalanced, 0);
}

// oracle: the rule of common members, in courses in which every fourth group shares one with another
TEST(allocation, keeps_groups_with_a_common_member_apart) {
    std::mt19937 random(5);
    for (int course = 0; course < 300; ++course) {
        AllocationProblem problem;
        problem.groups = 8 + static_cast<int>(random() % 40);
        problem.reviews = 1 + static_cast<int>(random() % 3);
        problem.active.assign(problem.groups, true);
        for (int i = 0; i < problem.groups / 4; ++i) {
            const int a = static_cast<int>(random() % problem.groups), b = static_cast<int>(random() % problem.groups);
            if (a != b) problem.kin.emplace_back(a, b);
        }
        const Allocation allocation = allocate_reviews(problem, fixed_draw(random()));
        expect_rules(problem, allocation);
        const Loads loads = loads_of(problem, allocation);
        EXPECT_EQ(spread(problem, loads.writes), 0);
        EXPECT_LE(spread(problem, loads.gets), 1);
    }
}

// oracle: a late group joins between two groups whose pair is not announced yet; each group writes and gets as many
// reviews as before
TEST(allocation, takes_late_comers_in_without_more_work_for_others) {
    AllocationProblem problem{13, 2, std::vector<bool>(13, true), {}, {}, {}};
    problem.active[12] = false;
    const Allocation first = allocate_reviews(problem, fixed_draw(3));
    problem.loose = first.pairs;
    problem.active[12] = true;
    const Allocation second = allocate_reviews(problem, fixed_draw(3));
    const Loads loads = loads_of(problem, second);
    EXPECT_EQ(spread(problem, loads.writes), 0);
    EXPECT_EQ(spread(problem, loads.gets), 0);
    int kept = 0;
    for (const ReviewEdge& pair : first.pairs)
        kept += std::find(second.pairs.begin(), second.pairs.end(), pair) != second.pairs.end();
    EXPECT_GE(kept, static_cast<int>(first.pairs.size()) - 4);
}

// oracle: counting
TEST(allocation, says_what_cannot_be_had) {
    AllocationProblem problem{3, 3, std::vector<bool>(3, true), {}, {}, {}};
    EXPECT_THROW(allocate_reviews(problem, fixed_draw(1)), InvalidArgument);
    problem.reviews = 2;  // everybody reviews everybody: couples cannot be avoided
    const Allocation all = allocate_reviews(problem, fixed_draw(1));
    EXPECT_EQ(all.pairs.size(), 6u);
    EXPECT_EQ(all.swapped, 3);
    ASSERT_FALSE(all.remarks.empty());
    EXPECT_NE(message_text(all.remarks.back()).find("3 pairs of groups review each other"), std::string::npos);
    problem = {4, 1, std::vector<bool>(4, true), {{0, 1}, {0, 2}, {0, 3}}, {}, {}};
    const Allocation lonely = allocate_reviews(problem, fixed_draw(1));
    EXPECT_EQ(lonely.open_reviews, 1);
    EXPECT_NE(message_text(lonely.remarks.front()).find("common members"), std::string::npos);
}

// oracle: the clock; 300 groups with six reviews each
TEST(allocation, is_quick) {
    AllocationProblem problem{300, 6, std::vector<bool>(300, true), {}, {}, {}};
    const auto start = std::chrono::steady_clock::now();
    const Allocation allocation = allocate_reviews(problem, fixed_draw(9));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    RecordProperty("milliseconds", static_cast<int>(1000 * seconds));
    EXPECT_EQ(allocation.swapped, 0);
    EXPECT_LT(seconds, 2.0);  // 0.2 s are meant; instrumented builds are slower
}

}  // namespace test_allocation
}  // namespace dynlab::test
