#include "cli/usage_error.h"

#include <regex>

#include "platform/text/regex_limit.h"

namespace dynlab::inline cli {
namespace {

/// The parser's own sentences, and ours with what the brackets caught.
struct UsageSentence {
    const char *theirs, *ours;
};

constexpr UsageSentence kSentences[] = {
    {"Could not convert: (\\S+) = (.*)", "$1 wants a number, but '$2' was given"},
    {"(\\S+): At Most 1 required but received .*", "$1 can be given once only"},
    {"(\\S+): 1 required .*", "$1 wants a value behind it"},
    {"The following argument was not expected: (\\S+\\.lua)", "a script is run by its command: dynlab run $1"},
    {"The following arguments? (was|were) not expected: (.*)", "nothing is known of $2 here"},
};

}  // namespace

std::string usage_message(const CLI::App* app, const CLI::Error& error) {
    std::string message = error.what();
    for (const auto& [theirs, ours] : kSentences) {
        if (message.size() > kLongestForRegex) break;
        const std::regex pattern(theirs);
        if (!std::regex_match(message, pattern)) continue;
        message = std::regex_replace(message, pattern, ours);
        break;
    }
    return message + "\nRun with " + app->get_help_ptr()->get_name() + " for more information.\n";
}

}  // namespace dynlab::inline cli
