// Coordinator and workers in processes of their own. Oracle: the jobs that were put, each of which must come back once.
#include "workflow/shares/coordinator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "platform/error.h"
#include "platform/interrupt.h"
#include "platform/temporary_folder.h"
#include "support/message_texts.h"
#include "workflow/shares/shared_identity.h"
#include "workflow/shares/worker.h"

namespace dynlab {
namespace test_coordinator {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using namespace std::chrono_literals;

std::string square_of(const ShareJob& job) {
    const int number = std::stoi(job.bytes);
    return std::to_string(number * number);
}

/// "crash" ends its process, "slow" takes a quarter of a second, "throws" says why it cannot be done; "halves" and
/// "sulks" are slow, and return or throw something else when they are interrupted.
void do_test_job(WorkingHand& hand, const Spool::Claimed& claimed) {
    hand.finish(claimed, [&] {
        if (claimed.job.title == "crash") ::raise(SIGABRT);  // which no sanitizer catches
        if (claimed.job.title == "throws") throw EnvironmentError("there is no such thing");
        const auto until = std::chrono::steady_clock::now() + (claimed.job.title == "" ? 0ms : 250ms);
        while (std::chrono::steady_clock::now() < until) {
            if (interrupted() && claimed.job.title == "halves") return std::string("half");
            if (interrupted() && claimed.job.title == "sulks") throw EnvironmentError("not now");
            throw_if_interrupted();
            ::usleep(5000);
        }
        return square_of(claimed.job);
    });
}

class coordinator : public testing::Test {
  protected:
    ~coordinator() override {
        for (const pid_t worker : workers_) {
            ::kill(worker, SIGKILL);
            ::waitpid(worker, nullptr, 0);
        }
    }
    Spool begun() const {
        SpoolIdentity identity;
        identity.purpose = "test", identity.program = shared_identity();
        identity.lease_ms = 1500;
        return Spool::begin(folder_.path() / "spool", folder_.path() / "key", identity);
    }
    pid_t start_worker(const std::string& node, int hands = 1) {
        const pid_t child = ::fork();
        if (child == 0) {
            ::prctl(PR_SET_PDEATHSIG, SIGKILL);
            const InterruptScope interrupts;
            WorkerOptions options;
            options.hands = hands, options.node = node;
            options.kinds = {{"square", do_test_job}};
            try {
                work_for(Spool::open(folder_.path() / "spool"), options);
            } catch (const std::exception&) {
                ::_exit(1);
            }
            ::_exit(0);
        }
        workers_.push_back(child);
        return child;
    }
    static ShareJob job(int number, const std::string& title = "") {
        return {"square", "", title, std::to_string(number)};
    }
    /// Numbers and what came of them, or "trouble".
    static std::map<std::string, std::string> collected(Coordinator& coordinator) {
        std::map<std::string, std::string> all;
        do {
            while (const auto done = coordinator.finished()) {
                EXPECT_FALSE(all.contains(done->key));
                all[done->key] = !done->result           ? message_text(done->trouble)
                                 : done->result->trouble ? message_text(*done->result->trouble)
                                                         : done->result->bytes;
            }
        } while (coordinator.wait());
        return all;
    }
    static void end(pid_t worker, int signal) { ::kill(worker, signal); }

    TemporaryFolder folder_;
    std::vector<pid_t> workers_;
};

TEST_F(coordinator, gets_every_job_back_once) {
    const Spool spool = begun();
    start_worker("a", 2), start_worker("b");
    std::map<std::string, std::string> expected;
    {
        Coordinator leader(spool, nullptr);
        for (int i = 0; i < 100; ++i) expected[leader.put(job(i))] = std::to_string(i * i);
        const std::string odd = leader.put(job(1, "throws"));
        expected[odd] = "there is no such thing";
        EXPECT_EQ(collected(leader), expected);
        leader.conclude();
    }
    EXPECT_FALSE(fs::exists(spool.folder()));
    EXPECT_FALSE(fs::exists(folder_.path() / "key"));
    for (const pid_t worker : workers_) {
        int status = 1;
        ::waitpid(worker, &status, 0);
        EXPECT_EQ(status, 0);
    }
    workers_.clear();
}

TEST_F(coordinator, gives_up_a_job_that_ends_three_processes_and_names_how) {
    const Spool spool = begun();
    start_worker("alpha");
    Coordinator leader(spool, nullptr);
    const std::string bad = leader.put(job(5, "crash"));
    for (int i = 0; i < 20; ++i) leader.put(job(i));
    const auto all = collected(leader);
    EXPECT_EQ(all.size(), 21u);
    EXPECT_THAT(all.at(bad), HasSubstr("3 workers were lost with it"));
    EXPECT_THAT(all.at(bad), HasSubstr("on alpha: the process that did it ended with signal 6"));
}

TEST_F(coordinator, gives_the_jobs_of_the_dead_and_the_silent_to_others) {
    const Spool spool = begun();
    const pid_t silent = start_worker("silent"), dead = start_worker("dead");
    Coordinator leader(spool, nullptr);
    std::map<std::string, std::string> expected;
    for (int i = 0; i < 12; ++i) expected[leader.put(job(i, "slow"))] = std::to_string(i * i);
    for (int waited = 0; spool.leases().size() < 2 && waited < 500; ++waited) ::usleep(10000);
    ASSERT_EQ(spool.leases().size(), 2u);
    end(dead, SIGKILL);
    end(silent, SIGSTOP);
    start_worker("healthy");
    EXPECT_EQ(collected(leader), expected);
    end(silent, SIGCONT);  // what it hands in late harms nobody
}

TEST_F(coordinator, is_ended_and_another_goes_on) {
    const Spool spool = begun();
    start_worker("a");
    std::map<std::string, std::string> expected;
    {
        Coordinator first(spool, nullptr);
        for (int i = 0; i < 8; ++i) expected[first.put(job(i, "slow"))] = std::to_string(i * i);
        while (spool.results().empty()) ::usleep(10000);
    }  // its worker has given back what it had
    EXPECT_TRUE(spool.leases().empty());
    EXPECT_TRUE(spool.stopped());
    for (const auto& [key, losses] : spool.listed("jobs")) EXPECT_EQ(losses, 0);
    Coordinator second(begun(), nullptr);
    start_worker("b");
    for (int i = 0; i < 8; ++i) second.put(job(i, "slow"));
    EXPECT_EQ(collected(second), expected);
}

TEST_F(coordinator, a_worker_asked_to_end_gives_back_what_it_has) {
    const Spool spool = begun();
    const pid_t asked = start_worker("asked", 6);
    Coordinator leader(spool, nullptr);
    std::map<std::string, std::string> expected;
    for (const char* title : {"slow", "halves", "sulks"})
        for (int i = 0; i < 2; ++i) expected[leader.put(job(i, title))] = std::to_string(i * i);
    while (spool.leases().size() < 6) ::usleep(5000);
    end(asked, SIGTERM);
    ::waitpid(asked, nullptr, 0);
    std::erase(workers_, asked);
    EXPECT_TRUE(spool.leases().empty());
    EXPECT_EQ(spool.listed("jobs").size(), 6u);
    for (const auto& [key, losses] : spool.listed("jobs")) EXPECT_EQ(losses, 0);
    start_worker("other");
    EXPECT_EQ(collected(leader), expected);
}

TEST_F(coordinator, a_stranger_who_writes_into_the_spool_changes_no_result) {
    const Spool spool = begun();
    Coordinator leader(spool, nullptr);
    std::map<std::string, std::string> expected;
    for (int i = 0; i < 6; ++i) {
        const std::string key = leader.put(job(i));
        expected[key] = std::to_string(i * i);
        std::ofstream(spool.folder() / "results" / key) << "forged";
    }
    start_worker("a");
    EXPECT_EQ(collected(leader), expected);
    EXPECT_THAT(test::texts_of(leader.complaints()),
                testing::Contains(HasSubstr("is not signed by any worker of this session")));
}

TEST_F(coordinator, refuses_a_worker_with_another_program) {
    SpoolIdentity identity;
    identity.purpose = "test", identity.program = "another";
    const Spool spool = Spool::begin(folder_.path() / "spool", folder_.path() / "key", identity);
    WorkerOptions options;
    options.node = "alpha";
    const auto refused = work_for(spool, options);
    ASSERT_TRUE(refused);
    EXPECT_THAT(message_text(*refused), HasSubstr("alpha has another version of dynlab"));
}

// Where every third job loses its worker to somebody else's kill, none of them is wronged.
TEST_F(coordinator, does_not_blame_jobs_for_a_storm) {
    const Spool spool = begun();
    std::vector<pid_t> storm = {start_worker("a"), start_worker("b")};
    Coordinator leader(spool, nullptr);
    std::map<std::string, std::string> expected;
    for (int i = 0; i < 30; ++i) expected[leader.put(job(i, "slow"))] = std::to_string(i * i);
    std::map<std::string, std::string> all;
    int kills = 0;
    for (int waited = 0; leader.wait(); ++waited) {
        while (const auto done = leader.finished())
            all[done->key] = done->result ? done->result->bytes : message_text(done->trouble);
        if (waited % 6 != 5 || kills == 40) continue;
        pid_t& victim = storm[static_cast<std::size_t>(kills++ % 2)];
        end(victim, SIGKILL);
        victim = start_worker("again");
    }
    EXPECT_GT(kills, 10);
    EXPECT_EQ(all, expected);
}

}  // namespace test_coordinator
}  // namespace dynlab
