#include "platform/files/whole_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_whole_folder {

namespace fs = std::filesystem;

// Oracle: the folder around it.
std::size_t entries_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(whole_folder, is_there_with_all_its_files_or_not_at_all) {
    const TemporaryFolder around;
    const fs::path folder = around.path() / "mine";
    const auto fill = [](const fs::path& growing) {
        for (const char* name : {"a", "b"}) std::ofstream(growing / name) << name;
    };
    EXPECT_THROW(make_whole_folder(folder,
                                   [&](const fs::path& growing) {
                                       fill(growing);
                                       throw EnvironmentError("the disk is full");
                                   }),
                 EnvironmentError);
    EXPECT_EQ(entries_in(around.path()), 0u);
    const pid_t killed = ::fork();
    if (killed == 0)
        make_whole_folder(folder, [](const fs::path& growing) {
            std::ofstream(growing / "a") << "a" << std::flush;
            ::raise(SIGKILL);
        });
    ::waitpid(killed, nullptr, 0);
    EXPECT_FALSE(fs::exists(folder));
    fs::create_directory(folder);  // an empty one may be there
    make_whole_folder(folder, fill);
    EXPECT_EQ(entries_in(around.path()), 1u);
    EXPECT_EQ(entries_in(folder), 2u);
    EXPECT_THROW(make_whole_folder(folder, fill), EnvironmentError);
    EXPECT_EQ(entries_in(folder), 2u);
}

}  // namespace test_whole_folder
}  // namespace dynlab
