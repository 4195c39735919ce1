// The messages of a command to the program that runs it. Oracle: the messages that were written.
#include "data_io/values/command_messages.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/reader.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_command_messages {

namespace fs = std::filesystem;

class command_messages : public testing::Test {
  protected:
    fs::path file() const { return folder_.path() / "said"; }
    void write(const std::string& bytes) const { std::ofstream(file(), std::ios::binary) << bytes; }
    TemporaryFolder folder_;
};

TEST_F(command_messages, are_the_same_when_they_are_read) {
    const CommandMessages said{{Message("{} (up to date)", "a.pdf")},
                               {Message("there is no {}", "b"), plural(2, "{} gap", "{} gaps")},
                               {Message::verbatim("c")}};
    write_command_messages(file(), said);
    const CommandMessages read = read_command_messages(file());
    EXPECT_EQ(read.results, said.results);
    EXPECT_EQ(read.complaints, said.complaints);
    EXPECT_EQ(read.notes, said.notes);
    EXPECT_EQ(message_text(read.all()), "a.pdf (up to date)\nthere is no b\n2 gaps\nc");
    EXPECT_FALSE(read.empty());
}

TEST_F(command_messages, of_no_file_or_another_one_are_none) {
    EXPECT_TRUE(read_command_messages(file()).empty());
    write_command_messages(file(), {{Message("a")}, {}, {}});
    const std::string bytes = read_file(file());
    for (const std::string& other :
         {std::string(), std::string("{}"), bytes.substr(0, bytes.size() / 2), std::string(2 << 20, 'x')}) {
        write(other);
        EXPECT_TRUE(read_command_messages(file()).empty()) << other.size();
    }
    fs::remove(file());
    fs::create_directory(file());
    EXPECT_TRUE(read_command_messages(file()).empty());
    fs::remove(file());
    fs::create_symlink("/dev/zero", file());
    EXPECT_TRUE(read_command_messages(file()).empty());
}

}  // namespace test_command_messages
}  // namespace dynlab
