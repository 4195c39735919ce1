#include <gtest/gtest.h>

#include <fstream>

#include "base/reader.h"
#include "platform/files/file_error.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {
namespace test_file_error {

namespace fs = std::filesystem;

template <class Call>
std::string reported(Call call) {
    try {
        call();
    } catch (const fs::filesystem_error& error) {
        return message_text(file_error_sentence(error));
    }
    return "nothing was thrown";
}

// A file has the path of a required folder, which is an error for every user, root as well.
TEST(file_error, is_reported_in_the_words_of_other_messages) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "file", below = file / "below", none = folder.path() / "none";
    std::ofstream(file) << "text";
    EXPECT_EQ(reported([&] { fs::create_directories(below); }),
              "cannot create the folder " + below.string() + ": not a directory");
    EXPECT_EQ(reported([&] { fs::directory_iterator{none}; }),
              "cannot read the folder " + none.string() + ": no such file or directory");
    EXPECT_EQ(reported([&] { fs::copy_file(none, below); }),
              "cannot copy file " + none.string() + " to " + below.string() + ": no such file or directory");
}

}  // namespace test_file_error
}  // namespace dynlab::test
