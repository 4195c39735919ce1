// Files where another user may have put a link, a pipe or an endless file. Oracle: the content at the end of the link.
#include "platform/files/plain_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_plain_file {

namespace fs = std::filesystem;

class plain_file : public testing::Test {
  protected:
    plain_file() {
        write_file_atomically(path("thesis"), "years of work");
        fs::create_symlink(path("thesis"), path("link"));
        fs::create_symlink(path("nothing"), path("dangling"));
        fs::create_symlink("/dev/zero", path("endless"));
        ::mkfifo(path("pipe").c_str(), 0600);
        fs::create_directory(path("folder"));
    }
    fs::path path(const std::string& name) const { return folder_.path() / name; }
    TemporaryFolder folder_;
};

TEST_F(plain_file, replaces_what_is_there_and_not_what_it_leads_to) {
    ::chmod(path("thesis").c_str(), 0644);
    for (const char* name : {"link", "dangling", "endless", "pipe", "new"}) {
        write_plain_file(path(name), "sealed");
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(path(name)))) << name;
        EXPECT_EQ(read_file(path(name)), "sealed") << name;
        struct stat status {};
        ASSERT_EQ(::stat(path(name).c_str(), &status), 0);
        EXPECT_EQ(status.st_mode & 0777, 0600u) << name;
    }
    EXPECT_EQ(read_file(path("thesis")), "years of work");
    EXPECT_FALSE(fs::exists(path("nothing")));
    EXPECT_THROW(write_plain_file(path("folder"), "sealed"), EnvironmentError);
    EXPECT_THROW(write_plain_file(path("none/file"), "sealed"), EnvironmentError);
    for (const auto& entry : fs::directory_iterator(folder_.path()))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path();
}

}  // namespace test_plain_file
}  // namespace dynlab
