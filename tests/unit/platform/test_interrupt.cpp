#include "platform/interrupt.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>

#include "platform/error.h"

namespace dynlab {
namespace test_interrupt {

TEST(interrupt, sets_the_flag_within_a_scope_only) {
    EXPECT_FALSE(interrupted());
    {
        const InterruptScope scope;
        EXPECT_FALSE(interrupted());
        throw_if_interrupted();
        std::raise(SIGINT);
        EXPECT_TRUE(interrupted());
        EXPECT_THROW(throw_if_interrupted(), Interrupted);
    }
    EXPECT_FALSE(interrupted());
}

TEST(interrupt, inner_scopes_share_the_flag) {
    const InterruptScope outer;
    {
        const InterruptScope inner;
        std::raise(SIGINT);
    }
    EXPECT_TRUE(interrupted());
}

TEST(interrupt, forgotten_ones_do_not_count) {
    const InterruptScope scope;
    for (int i = 0; i < 3; ++i) {
        std::raise(SIGINT);
        EXPECT_TRUE(interrupted());
        clear_interrupts();
        EXPECT_FALSE(interrupted());
    }
    clear_interrupts(4);
    for (int i = 0; i < 3; ++i) std::raise(SIGINT);
    EXPECT_TRUE(interrupted());
}

/// Status of a child that raises SIGINT so many times within a scope, then exits with 5.
int status_after_interrupts(int count, bool within_scope) {
    const pid_t child = fork();
    if (child == 0) {
        if (within_scope) {
            const InterruptScope scope;
            for (int i = 0; i < count; ++i) std::raise(SIGINT);
            _exit(5);
        }
        { const InterruptScope ended; }
        for (int i = 0; i < count; ++i) std::raise(SIGINT);
        _exit(5);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return status;
}

TEST(interrupt, second_one_ends_the_program) {
    EXPECT_EQ(WEXITSTATUS(status_after_interrupts(1, true)), 5);
    const int status = status_after_interrupts(2, true);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), SIGINT);
}

TEST(interrupt, after_the_scope_the_program_ends_as_usual) {
    const int status = status_after_interrupts(1, false);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), SIGINT);
}

// oracle: POSIX, of a process that raises a signal whose handler was taken away
TEST(interrupt, termination_is_held_back_until_all_is_undone) {
    const auto status_of = [](const std::function<void()>& work) {
        const pid_t child = fork();
        if (child == 0) {
            work();
            _exit(5);
        }
        int status = 0;
        waitpid(child, &status, 0);
        return status;
    };
    for (const int number : {SIGTERM, SIGHUP}) {
        const int undone = status_of([number] {
            const InterruptScope scope;
            std::raise(number);
            _exit(interrupted() ? 6 : 7);
        });
        ASSERT_TRUE(WIFEXITED(undone));
        EXPECT_EQ(WEXITSTATUS(undone), 6);
        const int passed_on = status_of([number] {
            const InterruptScope scope;
            std::raise(number);
            pass_on_termination();
        });
        ASSERT_TRUE(WIFSIGNALED(passed_on));
        EXPECT_EQ(WTERMSIG(passed_on), number);
        const int at_once = status_of([number] {
            const InterruptScope scope;
            end_when_terminated();
            std::raise(number);
        });
        ASSERT_TRUE(WIFSIGNALED(at_once));
        EXPECT_EQ(WTERMSIG(at_once), number);
    }
    const int nothing = status_of([] {
        const InterruptScope scope;
        std::raise(SIGINT);
        pass_on_termination();
    });
    ASSERT_TRUE(WIFEXITED(nothing));
    EXPECT_EQ(WEXITSTATUS(nothing), 5);
}

/// How a copy of this process ends that does `work` and then hears nothing.
int status_of_deaf(const std::function<void()>& work) {
    const pid_t child = fork();
    if (child == 0) {
        work();
        for (int second = 0; second < 20; ++second) sleep(1);
        _exit(5);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return status;
}

TEST(interrupt, unheard_one_ends_a_program_that_said_so) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        const auto began = std::chrono::steady_clock::now();
        const int status = status_of_deaf([number] {
            static const InterruptScope scope(InterruptScope::Unhandled::kEnds);
            std::raise(number);
        });
        if (number == SIGINT) {
            EXPECT_EQ(WEXITSTATUS(status), 130);
        } else {
            EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == number) << number;
        }
        EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(15));
    }
}

TEST(interrupt, programs_that_go_on_are_not_ended) {
    const auto status_after = [](const std::function<void()>& work) {
        return status_of_deaf([&work] {
            work();
            usleep(600'000);
            _exit(6);
        });
    };
    const int forgotten = status_after([] {
        static const InterruptScope scope(InterruptScope::Unhandled::kEnds);
        std::raise(SIGINT);
        clear_interrupts();
        std::raise(SIGINT);
    });
    EXPECT_EQ(WEXITSTATUS(forgotten), 6);
    const int slow = status_after([] {
        static const InterruptScope scope(InterruptScope::Unhandled::kEnds);
        static const SlowEnding slow_ending;
        std::raise(SIGINT);
    });
    EXPECT_EQ(WEXITSTATUS(slow), 6);
}

}  // namespace test_interrupt
}  // namespace dynlab
