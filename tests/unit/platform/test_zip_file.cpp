// Oracle: Info-ZIP's unzip, which lists, tests and unpacks what is written here.
#include "platform/files/zip_file.h"

#include <gtest/gtest.h>

#include "platform/atomic_file.h"
#include "platform/child_process.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {
namespace test_zip_file {

std::string unzip(std::vector<std::string> words) {
    words.insert(words.begin(), "unzip");
    ChildOptions options;
    options.command = std::move(words);
    const ChildResult result = run_child(options, "unzip");
    EXPECT_EQ(result.exit_code, 0) << result.output << result.error_output;
    return result.output;
}

TEST(zip_file, is_read_by_unzip_byte_for_byte) {
    std::string all_bytes;
    for (int byte = 0; byte < 256; ++byte) all_bytes += static_cast<char>(byte);
    const std::map<std::string, std::string> contents = {
        {"analysis.lua", "print(1)\n"}, {"data/own/own.csv", all_bytes}, {"empty.txt", ""}, {"été.md", "é\n"}};
    const TemporaryFolder folder;
    const auto file = folder.path() / "pack.zip";
    write_zip(file, contents);
    unzip({"-t", file.string()});
    unzip({"-q", file.string(), "-d", (folder.path() / "out").string()});
    for (const auto& [name, content] : contents) EXPECT_EQ(read_file(folder.path() / "out" / name), content) << name;
    EXPECT_EQ(read_file(file), zip_of(contents));
}

TEST(zip_file, of_nothing_is_a_zip) {
    EXPECT_EQ(zip_of({}).size(), 22u);
}

}  // namespace test_zip_file
}  // namespace dynlab::test
