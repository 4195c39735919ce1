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
#include <functional>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/signature.h"
#include "platform/temporary_folder.h"
#include "workflow/shares/heartbeat.h"

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

TEST_F(spool, one_whose_making_or_removal_was_killed_is_begun_again) {  // oracle: what each step of the two leaves
    for (const char* gone : {"spool.json", "identity", "jobs"}) {
        begun();
        fs::remove(folder_.path() / "spool/spool.json");
        fs::remove_all(folder_.path() / "spool" / gone);
        EXPECT_TRUE(begun().exists()) << gone;
    }
    fs::remove(folder_.path() / "spool/spool.json");
    write_file_atomically(folder_.path() / "spool/thesis.tex", "mine");
    EXPECT_THROW(begun(), EnvironmentError);
    EXPECT_EQ(read_file(folder_.path() / "spool/thesis.tex"), "mine");
}

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

// Whoever can write here, but has no key, puts links and pipes in the places of files.
TEST_F(spool, links_and_pipes_in_it_lead_nowhere) {
    const fs::path thesis = folder_.path() / "thesis.tex";
    write_file_atomically(thesis, "do not touch me");
    const Spool folder = begun();
    const std::string key = folder.key_of(job(1)), piped = folder.key_of(job(2));
    folder.admit("w", SigningKey::of_seed(std::string(32, 'a')).public_key());
    folder.put(key, job(1));
    const auto claimed = folder.claim("w.0");
    ASSERT_TRUE(claimed);
    for (const std::string& name : {"results/" + key, "logs/" + key + ".0.txt", std::string("workers/w"),
                                    std::string("coordinator"), std::string("stop"), std::string("slurm")}) {
        fs::remove(folder.folder() / name);
        fs::create_symlink(thesis, folder.folder() / name);
    }
    EXPECT_FALSE(folder.result(key));
    EXPECT_FALSE(folder.log_of(claimed->lease.job));
    EXPECT_EQ(folder.logged(claimed->lease.job, 100), "");  // no complaint quotes the thesis
    folder.tell("w", WorkerStatus());
    folder.tell(CoordinatorStatus());
    folder.stop();
    EXPECT_EQ(folder.noted("slurm"), std::nullopt);
    folder.note("slurm", "17");
    EXPECT_EQ(folder.noted("slurm"), "17");
    folder.finish(claimed->lease, result_of(folder, key, SigningKey::of_seed(std::string(32, 'a'))));
    EXPECT_TRUE(folder.result(key));
    EXPECT_EQ(read_file(thesis), "do not touch me");
    // A pipe that nobody writes into, and a file without an end.
    ASSERT_EQ(::mkfifo((folder.folder() / "results" / piped).c_str(), 0600), 0);
    EXPECT_FALSE(folder.result(piped));
    ASSERT_EQ(::mkfifo((folder.folder() / "jobs" / (piped + ".0")).c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", folder.folder() / "jobs" / "endless.0");
    folder.refuse_result(piped);
    EXPECT_FALSE(folder.claim("w.0"));
    EXPECT_TRUE(fs::exists(fs::symlink_status(folder.folder() / "refused" / (piped + ".0"))));
}

TEST_F(spool, names_that_lead_elsewhere_are_none_of_ours) {
    const Spool folder = begun();
    const SigningKey mine = SigningKey::of_seed(std::string(32, 'a'));
    folder.admit("w", mine.public_key());
    const std::string key = folder.key_of(job(1));
    folder.put(key, job(1));
    const auto claimed = folder.claim("w.0");
    ASSERT_TRUE(claimed);
    for (const char* worker : {"../keys/w", "./w", "..", ".", "", "/etc/passwd"}) {
        ShareResult result = result_of(folder, key, mine);
        result.worker = worker;
        result.signature = mine.sign(folder.signed_text(key, result));
        folder.finish(claimed->lease, result);
        EXPECT_FALSE(folder.result(key)) << worker;
        EXPECT_FALSE(folder.worker(worker)) << worker;
    }
    for (const char* name : {".0", "x", "x.", "x.-1", "x.99999", "x.0.0", "x.1e3", "..", "x.0@"})
        std::ofstream(folder.folder() / "jobs" / name) << "do this";
    for (const char* name : {"@", "x@w.0", "x.0", ".0@w.0"}) std::ofstream(folder.folder() / "leases" / name) << "";
    EXPECT_TRUE(folder.listed("jobs").empty() || folder.listed("jobs").contains("x"));
    EXPECT_FALSE(folder.claim("w.0"));
    for (const Spool::Lease& lease : folder.leases()) EXPECT_EQ(lease.job.key.find('/'), std::string::npos);
}

TEST_F(spool, a_file_that_was_cut_is_none_and_costs_no_more_than_itself) {
    const Spool folder = begun();
    const auto cut = [&](const std::string& name) {
        fs::resize_file(folder.folder() / name, fs::file_size(folder.folder() / name) / 2);
    };
    const std::string common = folder.put_common("what all share"), key = folder.key_of(job(1));
    cut("common/" + common);
    EXPECT_FALSE(folder.common(common));
    folder.put_common("what all share");
    EXPECT_EQ(folder.common(common), "what all share");
    folder.put(key, job(1));
    cut("jobs/" + key + ".0");
    EXPECT_FALSE(folder.claim("w.0"));
    folder.put(key, job(1));
    EXPECT_TRUE(folder.claim("w.0"));
    folder.tell(CoordinatorStatus());
    cut("coordinator");
    EXPECT_FALSE(folder.coordinator());
    cut("spool.json");
    EXPECT_THROW(Spool::open(folder.folder()), EnvironmentError);
    try {
        begun();
        FAIL();
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(), HasSubstr("is spoilt; remove"));
    }
    fs::remove_all(folder.folder());
    const std::string id = begun().identity().id;
    fs::resize_file(folder.folder() / "identity", 5);
    EXPECT_THROW(Spool::open(folder.folder()), EnvironmentError);
    EXPECT_NE(begun().identity().id, id);
}

/// What it throws, or "taken".
std::string told_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const EnvironmentError& error) {
        return error.what();
    }
    return "taken";
}

TEST_F(spool, what_others_own_or_may_look_into_is_not_taken) {
    const fs::path place = begun().folder();
    ASSERT_EQ(::chmod(place.c_str(), 0755), 0);
    EXPECT_THAT(told_of([&] { Spool::open(place); }), HasSubstr("others may look into the spool"));
    EXPECT_EQ(told_of([&] { begun(); }), "taken");  // and makes it private again
    EXPECT_EQ(told_of([&] { Spool::open(place); }), "taken");
    fs::rename(place / "jobs", folder_.path() / "elsewhere");
    fs::create_directory_symlink(folder_.path() / "elsewhere", place / "jobs");
    EXPECT_THAT(told_of([&] { Spool::open(place); }), HasSubstr("jobs is no folder that this spool made"));
    EXPECT_THAT(told_of([&] { begun(); }), HasSubstr("jobs is no folder that this spool made"));
    fs::remove(place / "jobs");
    EXPECT_EQ(told_of([&] { begun(); }), "taken");
    if (::geteuid() != 0) GTEST_SKIP() << "only root may give files away";
    constexpr uid_t kNobody = 65534;
    ASSERT_EQ(::chown((place / "results").c_str(), kNobody, kNobody), 0);
    EXPECT_THAT(told_of([&] { begun(); }), HasSubstr("results is no folder that this spool made"));
    ASSERT_EQ(::chown(place.c_str(), kNobody, kNobody), 0);
    EXPECT_THAT(told_of([&] { begun(); }), HasSubstr("belongs to another user"));
    EXPECT_THAT(told_of([&] { Spool::open(place); }), HasSubstr("belongs to another user"));
    ASSERT_EQ(::chown(place.c_str(), 0, 0), 0);
    ASSERT_EQ(::chown((place / "results").c_str(), 0, 0), 0);
    ASSERT_EQ(::chown((folder_.path() / "key").c_str(), kNobody, kNobody), 0);
    EXPECT_THAT(told_of([&] { Spool::open(place); }), HasSubstr("belongs to another user; it is not taken"));
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
