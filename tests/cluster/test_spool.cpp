// The folder through which work is shared. Oracle: what was put in, counted; who may forge nothing.
#include "workflow/shares/spool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/signature.h"
#include "platform/temporary_folder.h"
#include "workflow/shares/heartbeat_watch.h"

namespace dynlab {
namespace test_spool {

namespace fs = std::filesystem;
using testing::HasSubstr;
using namespace std::chrono_literals;

class spool : public testing::Test {
  protected:
    Spool begun(const std::string& purpose = "test", const std::string& program = "one") const {
        SpoolIdentity identity;
        identity.purpose = purpose, identity.program = program;
        return Spool::begin(folder_.path() / "spool", folder_.path() / "key", identity);
    }
    static ShareJob job(int number) { return {"test", "", std::to_string(number), std::string(100, 'x')}; }
    /// A result as a worker with this key makes it.
    static ShareResult result_of(const Spool& spool, const std::string& key, const SigningKey& signer) {
        ShareResult result;
        result.worker = "w", result.node = "n", result.bytes = "done";
        result.signature = signer.sign(spool.signed_text(key, result));
        return result;
    }

    TemporaryFolder folder_;
};

TEST_F(spool, a_job_is_claimed_by_one_of_many_processes) {
    constexpr int kJobs = 200, kProcesses = 8;
    const Spool folder = begun();
    for (int i = 0; i < kJobs; ++i) folder.put(folder.key_of(job(i)), job(i));
    std::vector<pid_t> children;
    for (int k = 0; k < kProcesses; ++k) {
        const pid_t child = ::fork();
        if (child == 0) {
            std::ofstream claimed(folder_.path() / ("claimed-" + std::to_string(k)));
            while (const auto one = folder.claim("w" + std::to_string(k) + ".0")) claimed << one->job.title << '\n';
            claimed.close();
            ::_exit(0);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) ::waitpid(child, nullptr, 0);
    std::multiset<int> all;
    for (int k = 0; k < kProcesses; ++k) {
        std::ifstream claimed(folder_.path() / ("claimed-" + std::to_string(k)));
        for (int number; claimed >> number;) all.insert(number);
    }
    EXPECT_EQ(all.size(), static_cast<std::size_t>(kJobs));
    EXPECT_EQ(std::set<int>(all.begin(), all.end()).size(), static_cast<std::size_t>(kJobs));
    EXPECT_EQ(folder.leases().size(), static_cast<std::size_t>(kJobs));
}

TEST_F(spool, only_its_owner_may_look_into_it_and_nothing_in_it_can_be_read) {
    const Spool folder = begun();
    ShareJob secret = job(1);
    secret.bytes = "the hidden record";
    folder.put(folder.key_of(secret), secret);
    folder.put_common("the secret of the course");
    struct stat status {};
    ASSERT_EQ(::stat(folder.folder().c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0700u);
    for (const auto& entry : fs::recursive_directory_iterator(folder.folder())) {
        if (!entry.is_regular_file()) continue;
        const std::string bytes = read_file(entry.path());
        EXPECT_EQ(bytes.find("secret"), std::string::npos) << entry.path();
        EXPECT_EQ(bytes.find("hidden"), std::string::npos) << entry.path();
    }
    EXPECT_FALSE(fs::exists(folder.folder() / "key"));
}

TEST_F(spool, results_of_strangers_are_none) {
    const Spool folder = begun();
    const SigningKey ours = SigningKey::of_seed(std::string(32, 'a')),
                     strangers = SigningKey::of_seed(std::string(32, 'b'));
    folder.admit("w", ours.public_key());
    const std::string key = folder.key_of(job(1)), other = folder.key_of(job(2));
    folder.put(key, job(1));
    const auto claimed = folder.claim("w.0");
    ASSERT_TRUE(claimed);
    // A worker that this session knows.
    folder.finish(claimed->lease, result_of(folder, key, ours));
    ASSERT_TRUE(folder.result(key));
    EXPECT_EQ(folder.result(key)->bytes, "done");
    // The same bytes under the name of another job.
    fs::copy_file(folder.folder() / "results" / key, folder.folder() / "results" / other);
    EXPECT_FALSE(folder.result(other));
    // Signed by another key; by nobody; for other bytes.
    folder.finish(claimed->lease, result_of(folder, key, strangers));
    EXPECT_FALSE(folder.result(key));
    ShareResult altered = result_of(folder, key, ours);
    altered.bytes = "full marks";
    folder.finish(claimed->lease, altered);
    EXPECT_FALSE(folder.result(key));
    // Somebody who has no key at all.
    std::ofstream(folder.folder() / "results" / key) << "full marks for everybody, signed: the worker";
    EXPECT_FALSE(folder.result(key));
    // It is refused, and the job waits again.
    folder.refuse_result(key);
    EXPECT_TRUE(folder.listed("jobs").contains(key));
    EXPECT_FALSE(folder.results().contains(key));
    // One who opens a spool of his own at the same place has another key.
    std::ofstream(folder.folder() / "jobs" / "forged.0") << "do this";
    while (const auto one = folder.claim("w.0")) EXPECT_EQ(one->lease.job.key, key);
    EXPECT_TRUE(fs::exists(folder.folder() / "refused" / "forged.0"));
}

TEST_F(spool, jobs_that_lost_workers_come_last_and_are_suspected_after_three) {
    const Spool folder = begun();
    const std::string bad = folder.key_of(job(0));
    folder.put(bad, job(0));
    folder.lose(folder.claim("w.0")->lease);
    for (int i = 1; i < 10; ++i) folder.put(folder.key_of(job(i)), job(i));
    for (int i = 1; i < 10; ++i) EXPECT_NE(folder.claim("w.0")->lease.job.key, bad);
    for (int lost = 1; lost < kTries; ++lost) {
        const auto again = folder.claim("w.0");
        ASSERT_TRUE(again);
        EXPECT_EQ(again->lease.job.losses, lost);
        folder.lose(again->lease);
    }
    EXPECT_FALSE(folder.claim("w.0"));
    EXPECT_EQ(folder.listed("suspects").at(bad), kTries);
}

TEST_F(spool, goes_on_for_the_same_work_and_refuses_other) {
    const std::string id = begun().identity().id;
    EXPECT_EQ(begun().identity().id, id);
    EXPECT_EQ(Spool::open(folder_.path() / "spool").identity().id, id);
    try {
        begun("another course");
        FAIL();
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(), HasSubstr("belongs to other work (\"test\", not \"another course\"); give this one"));
    }
    // With another program nothing of it may be used.
    const Spool folder = begun();
    folder.put(folder.key_of(job(1)), job(1));
    EXPECT_NE(begun("test", "two").identity().id, id);
    EXPECT_TRUE(begun("test", "two").listed("jobs").empty());
}

TEST_F(spool, takes_no_folder_with_other_things_and_no_place_that_cannot_be_written) {
    write_file_atomically(folder_.path() / "thesis.tex", "do not remove me");
    SpoolIdentity identity;
    EXPECT_THROW(Spool::begin(folder_.path(), folder_.path() / "key", identity), EnvironmentError);
    EXPECT_TRUE(fs::exists(folder_.path() / "thesis.tex"));
    EXPECT_THROW(Spool::begin("/proc/spool", folder_.path() / "key", identity), EnvironmentError);
    EXPECT_THROW(Spool::open(folder_.path() / "none"), EnvironmentError);
}

TEST_F(spool, a_result_that_the_disk_does_not_take_leaves_the_lease) {
    const Spool folder = begun();
    const std::string key = folder.key_of(job(1));
    folder.put(key, job(1));
    const auto claimed = folder.claim("w.0");
    ASSERT_TRUE(claimed);
    ShareResult large = result_of(folder, key, SigningKey::of_seed(std::string(32, 'a')));
    large.bytes = std::string(1 << 20, 'x');
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit little{1 << 16, 1 << 16};
        ::setrlimit(RLIMIT_FSIZE, &little);
        try {
            folder.finish(claimed->lease, large);
        } catch (const EnvironmentError&) {
            ::_exit(7);
        }
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 7);
    EXPECT_EQ(folder.leases().size(), 1u);
    EXPECT_TRUE(folder.results().empty());
    folder.give_back(claimed->lease);
    EXPECT_TRUE(folder.claim("w.0"));
}

TEST(heartbeat_watch, counts_by_the_observers_clock_since_the_last_change) {
    HeartbeatWatch watch;
    const auto start = HeartbeatWatch::Clock::now();
    watch.see(7, start);
    EXPECT_FALSE(watch.heard());
    watch.see(7, start + 5s);
    EXPECT_EQ(watch.lasting(start + 6s), 6s);
    watch.see(3, start + 8s);  // backwards is a change as well
    EXPECT_TRUE(watch.heard());
    EXPECT_EQ(watch.lasting(start + 9s), 1s);
}

}  // namespace test_spool
}  // namespace dynlab
