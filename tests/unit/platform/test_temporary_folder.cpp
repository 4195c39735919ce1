#include "platform/temporary_folder.h"
#include "support/environment_variable.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab {
namespace test_temporary_folder {

namespace fs = std::filesystem;

TEST(temporary_folder, is_private_and_goes_with_all_it_holds) {
    fs::path path;
    {
        const TemporaryFolder folder, other;
        path = folder.path();
        EXPECT_NE(path, other.path());
        EXPECT_EQ(fs::status(path).permissions(), fs::perms(0700));
        fs::create_directories(path / "a/b");
        write_file_atomically(path / "a/b/c", "x");
    }
    EXPECT_FALSE(fs::exists(path));
}

TEST(temporary_folder, lies_below_tmpdir) {
    const TemporaryFolder parent;
    const test::EnvironmentVariable tmpdir("TMPDIR", parent.path());
    EXPECT_EQ(TemporaryFolder().path().parent_path(), parent.path());
    tmpdir.set("/none/such");
    try {
        const TemporaryFolder impossible;
        ADD_FAILURE();
    } catch (const EnvironmentError& error) {
        EXPECT_STREQ(error.what(), "cannot create a temporary folder in /none/such: no such file or directory");
    }
}

}  // namespace test_temporary_folder
}  // namespace dynlab
