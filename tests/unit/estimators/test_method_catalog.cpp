#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "numerics/estimators/method_catalog.h"

namespace test_method_catalog {

using namespace dynlab;

TEST(method_catalog, every_method_has_its_files) {  // oracle: the source tree
    const std::filesystem::path root = DYNLAB_SOURCE_DIR;
    for (const MethodEntry& method : method_catalog()) {
        EXPECT_TRUE(exists(root / "engine/numerics/estimators" / (method.file + ".h"))) << method.file;
        EXPECT_TRUE(exists(root / "engine/numerics/estimators" / (method.file + ".cpp"))) << method.file;
        const std::filesystem::path test = root / "tests/unit/estimators" / method.file;
        EXPECT_TRUE(exists(test.parent_path() / ("test_" + test.filename().string() + ".cpp"))) << method.file;
    }
}

TEST(method_catalog, every_file_is_a_method_and_every_folder_a_family) {  // oracle: the source tree
    std::set<std::string> known{"method_catalog"};
    for (const MethodEntry& method : method_catalog()) known.insert(method.file.substr(0, method.file.find('/')));
    const std::filesystem::path folder = std::filesystem::path(DYNLAB_SOURCE_DIR) / "engine/numerics/estimators";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        const std::filesystem::path file = std::filesystem::relative(entry.path(), folder).replace_extension();
        EXPECT_TRUE(known.count(file.begin()->string())) << entry.path();
    }
}

TEST(method_catalog, names_are_unique_and_found) {  // oracle: definition
    std::set<std::string> names;
    for (const MethodEntry& method : method_catalog()) {
        ASSERT_FALSE(method.lua_names.empty());
        EXPECT_FALSE(method.title.empty() || method.structure.empty() || method.noise.empty() ||
                     method.reference.empty());
        for (const std::string& name : method.lua_names) {
            EXPECT_TRUE(names.insert(name).second) << name;
            ASSERT_TRUE(find_method(name).has_value());
            EXPECT_EQ(find_method(name)->file, method.file);
        }
    }
    EXPECT_FALSE(find_method("srivc_of_nothing").has_value());
}

}  // namespace test_method_catalog
