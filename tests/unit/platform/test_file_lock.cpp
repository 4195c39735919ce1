#include "platform/locks/file_lock.h"

#include <gtest/gtest.h>

#include <optional>

#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_file_lock {

// oracle: flock(2): a lock belongs to one open file, and goes when that is closed
TEST(file_lock, one_at_a_time_has_it) {
    const TemporaryFolder folder;
    std::optional<FileLock> first(folder.path() / ".lock");
    EXPECT_TRUE(first->held());
    EXPECT_FALSE(FileLock(folder.path() / ".lock").held());
    first.reset();
    EXPECT_TRUE(FileLock(folder.path() / ".lock").held());
    EXPECT_THROW(FileLock("/none/such/.lock"), EnvironmentError);
}

}  // namespace test_file_lock
}  // namespace dynlab
