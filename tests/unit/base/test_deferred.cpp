#include "base/deferred.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace dynlab::test {
namespace test_deferred {

TEST(deferred, is_computed_once_for_all_copies_and_lets_go_of_what_it_captured) {
    int computed = 0;
    const auto captured = std::make_shared<int>(7);
    const auto deferred = Deferred<std::string>::later([&computed, captured] {
        ++computed;
        return std::to_string(*captured);
    });
    const Deferred<std::string> copy = deferred;
    EXPECT_EQ(copy.known(), nullptr);
    EXPECT_EQ(computed, 0);
    EXPECT_EQ(captured.use_count(), 2);
    EXPECT_EQ(copy.get(), "7");
    EXPECT_EQ(deferred.get(), "7");
    EXPECT_EQ(computed, 1);
    EXPECT_EQ(captured.use_count(), 1);
    EXPECT_EQ(deferred.known(), &copy.get());
}

TEST(deferred, threads_that_read_at_once_see_one_computation) {
    std::atomic<int> computed = 0;
    const auto deferred = Deferred<int>::later([&computed] { return ++computed; });
    std::vector<std::thread> readers;
    for (int i = 0; i < 8; ++i) readers.emplace_back([deferred] { EXPECT_EQ(deferred.get(), 1); });
    for (std::thread& reader : readers) reader.join();
    EXPECT_EQ(computed, 1);
}

TEST(deferred, a_computation_that_throws_is_tried_again) {
    int tries = 0;
    const auto deferred = Deferred<int>::later([&tries] {
        if (++tries == 1) throw std::runtime_error("not yet");
        return 5;
    });
    EXPECT_THROW(deferred.get(), std::runtime_error);
    EXPECT_EQ(deferred.get(), 5);
}

TEST(deferred, without_a_computation_it_is_the_value_or_an_empty_one) {
    EXPECT_EQ(Deferred<std::string>().get(), "");
    EXPECT_EQ(Deferred<std::string>("known").get(), "known");
    Deferred<std::string> edited;
    edited.edit() += "more";
    EXPECT_EQ(edited.get(), "more");
    EXPECT_EQ(Deferred<std::string>().get(), "");
}

}  // namespace test_deferred
}  // namespace dynlab::test
