#include "platform/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <string>

#include "platform/error.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {

TemporaryFolder::TemporaryFolder() {
    const char* parent = std::getenv("TMPDIR");
    std::string pattern = (parent && *parent) ? parent : "/tmp";
    pattern += "/dynlab-XXXXXX";
    if (!::mkdtemp(pattern.data())) {
        throw EnvironmentError("cannot make a temporary folder in " +
                               std::filesystem::path(pattern).parent_path().string() + ": " + system_reason(errno));
    }
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace dynlab::inline platform
