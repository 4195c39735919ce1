// Oracle: what was planted. Random systems, inputs and noise of fixed seeds that no threshold was chosen with.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/reader.h"
#include "numerics/validation/advice.h"
#include "support/advice_corpus.h"

namespace test_advice_statistics {

using namespace dynlab;
using dynlab::test::CorpusKind;

constexpr std::uint32_t kFirstSeed = 700001, kSeeds = 5;

bool has_one_of(const Advice& advice, const std::vector<std::string>& codes) {
    return std::any_of(codes.begin(), codes.end(), [&](const std::string& code) { return advice.has(code); });
}

std::string warnings(const Advice& advice) {
    std::string all;
    for (const DataIssue& issue : advice.findings)
        if (issue.weight == Weight::kWarning) all += "\n  " + issue.code + ": " + message_text(issue.message);
    return all;
}

class clean_advice_statistics : public testing::TestWithParam<CorpusKind> {};
class faulty_advice_statistics : public testing::TestWithParam<CorpusKind> {};

TEST_P(clean_advice_statistics, no_warning) {
    for (std::uint32_t seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
        const Advice advice = advise(GetParam().simulated_data(seed));
        EXPECT_TRUE(advice.clean()) << GetParam().name << ", seed " << seed << warnings(advice);
    }
}

TEST_P(faulty_advice_statistics, all_but_one_are_found) {
    std::uint32_t found = 0;
    std::string missed;
    for (std::uint32_t seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
        const Advice advice = advise(GetParam().simulated_data(seed));
        if (has_one_of(advice, GetParam().codes))
            ++found;
        else
            missed += "\nseed " + std::to_string(seed) + warnings(advice);
    }
    EXPECT_GE(found, kSeeds - 1) << GetParam().name << missed;
}

std::string test_name(const testing::TestParamInfo<CorpusKind>& info) {
    std::string name = info.param.name;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(corpus, clean_advice_statistics, testing::ValuesIn(dynlab::test::clean_kinds()), test_name);
INSTANTIATE_TEST_SUITE_P(corpus, faulty_advice_statistics, testing::ValuesIn(dynlab::test::faulty_kinds()), test_name);

}  // namespace test_advice_statistics
