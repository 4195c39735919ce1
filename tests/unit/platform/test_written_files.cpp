#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "platform/written_files.h"

namespace dynlab::test {
namespace test_written_files {

/// One run of a script that saves `content` as `file`.
class written_files : public ::testing::Test {
  protected:
    void run(const std::string& content, WrittenFiles::Others others = WrittenFiles::Others::kKept) const {
        WrittenFiles written(ledger_, others);
        written.take(file_);
        write_file_atomically(file_, content);
        written.take(file_);  // twice in a run
    }
    const TemporaryFolder folder_;
    const std::filesystem::path file_ = folder_.path() / "x.csv", ledger_ = folder_.path() / "state/written";
};

// oracle: the contents of the file
TEST_F(written_files, replace_what_earlier_runs_wrote_and_nothing_else) {
    run("first");
    run("second");
    EXPECT_EQ(read_file(file_), "second");
    write_file_atomically(file_, "edited by hand");
    EXPECT_THROW(run("third"), EnvironmentError);
    EXPECT_EQ(read_file(file_), "edited by hand");
    run("third", WrittenFiles::Others::kReplaced);
    run("fourth");
    EXPECT_EQ(read_file(file_), "fourth");
    std::filesystem::remove(file_);
    run("fifth");
    std::filesystem::rename(file_, folder_.path() / "y.csv");
    EXPECT_THROW(WrittenFiles(ledger_).take(folder_.path() / "y.csv"), EnvironmentError);  // of that name none wrote it
}

// oracle: the rule: without a ledger, every existing file belongs to another user
TEST_F(written_files, of_others_stay) {
    write_file_atomically(file_, "a thesis");
    EXPECT_THROW(run("x"), EnvironmentError);
    EXPECT_THROW(WrittenFiles("").take(file_), EnvironmentError);
    EXPECT_EQ(read_file(file_), "a thesis");
    std::filesystem::remove(file_);
    {
        WrittenFiles unknown("");
        unknown.take(file_);
        write_file_atomically(file_, "x");
        unknown.take(file_);
    }
    EXPECT_THROW(WrittenFiles("").take(file_), EnvironmentError);
}

// oracle: the rule: only what a run has written is a run's
TEST_F(written_files, asked_for_and_not_written_have_no_owner) {
    { WrittenFiles(ledger_).take(file_); }  // the call then failed
    write_file_atomically(file_, "by hand");
    EXPECT_THROW(run("x"), EnvironmentError);
    { WrittenFiles(ledger_, WrittenFiles::Others::kReplaced).take(file_); }  // allowed, and failed
    EXPECT_THROW(run("x"), EnvironmentError);
    EXPECT_EQ(read_file(file_), "by hand");
}

// oracle: the rule, in a session that goes on after a statement has settled
TEST_F(written_files, changed_by_hand_during_a_session_stay) {
    WrittenFiles written(ledger_);
    written.take(file_);
    write_file_atomically(file_, "first");
    written.settle();
    written.take(file_);
    write_file_atomically(file_, "second");
    written.settle();
    write_file_atomically(file_, "edited");
    EXPECT_THROW(written.take(file_), EnvironmentError);
}

// oracle: what a killed run had written at that moment, or had not
TEST_F(written_files, of_a_killed_run_are_known_and_what_comes_after_it_is_not) {
    const auto killed_run = [&](const std::function<void(WrittenFiles&)>& work) {
        const pid_t process = ::fork();
        if (process == 0) {
            WrittenFiles written(ledger_);
            written.take(file_);
            work(written);
            ::raise(SIGKILL);
        }
        ::waitpid(process, nullptr, 0);
    };
    killed_run([](WrittenFiles&) {});  // before it wrote
    write_file_atomically(file_, "by hand");
    EXPECT_THROW(run("x"), EnvironmentError);
    std::filesystem::remove(file_);
    killed_run([&](WrittenFiles&) { write_file_atomically(file_, "first"); });
    run("second");
    const std::filesystem::path finished = folder_.path() / "finished";
    write_file_atomically(finished, "third");
    killed_run([&](WrittenFiles&) { note_replacement(file_, finished); });  // before it was put in place
    run("fourth");
    killed_run([&](WrittenFiles&) { place_file_atomically(finished, file_); });
    EXPECT_EQ(read_file(file_), "third");
    write_file_atomically(file_, "by hand");
    EXPECT_THROW(run("x"), EnvironmentError);
    EXPECT_EQ(read_file(file_), "by hand");
}

// oracle: a ledger of many runs
TEST_F(written_files, are_known_in_a_long_ledger) {
    run("whole");
    std::string older;
    while (older.size() < (3u << 20)) older += std::string(64, 'a') + ' ' + std::string(64, 'b') + '\n';
    write_file_atomically(ledger_, older + read_file(ledger_));
    run("again");
    EXPECT_EQ(read_file(file_), "again");
    EXPECT_LT(std::filesystem::file_size(ledger_), 1u << 20);
}

}  // namespace test_written_files
}  // namespace dynlab::test
