#include "platform/files/atomic_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_atomic_files {

namespace fs = std::filesystem;

// oracle: what was written
TEST(atomic_files, writes_several_in_their_order) {
    const TemporaryFolder folder;
    const fs::path kept = folder.path() / "000";
    write_file_atomically(kept, "old");
    std::vector<NewFile> files;
    for (int i = 0; i < 150; ++i)
        files.push_back({folder.path() / fmt::format("{:03}", i), std::string(static_cast<std::size_t>(100 * i), 'x')});
    write_files_atomically(files);
    for (const NewFile& file : files) EXPECT_EQ(read_file(file.file), file.content);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 150);
    // One that cannot be written: what stands before it may be new, the rest is as it was.
    files[140].file = folder.path() / "no such folder" / "file";
    for (NewFile& file : files) file.content = "new";
    EXPECT_THROW(write_files_atomically(files), EnvironmentError);
    bool old = false;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (i == 140) continue;
        const std::string content = read_file(files[i].file);
        old = old || content != "new";
        EXPECT_EQ(content, old ? std::string(100 * i, 'x') : "new") << i;
    }
    EXPECT_TRUE(old);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 150);
}

}  // namespace test_atomic_files
}  // namespace dynlab
