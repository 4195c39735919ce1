#include <vector>

#include "platform/atomic_file.h"
#include "scripting/runtime/help.h"

namespace dynlab::inline scripting {
namespace {

/// Where the worker of a page puts what it fetches when it is first read (join_help.cmake).
constexpr char kPages[] = "/dynlab/help.txt";

std::string fetched() {
    try {
        return read_file(kPages);
    } catch (const std::exception&) {
        return {};  // without a connection, before they were fetched
    }
}

std::vector<HelpPage> pages_in(std::string_view text) {
    std::vector<HelpPage> pages;
    for (std::size_t at = 0, end; (end = text.find('\f', at)) != text.npos; at = end + 1) {
        const std::size_t line = text.find('\n', at);
        pages.push_back({text.substr(at, line - at), text.substr(line + 1, end - line - 1)});
    }
    return pages;
}

}  // namespace

std::span<const HelpPage> help_pages() {
    static const std::string text = fetched();
    static const std::vector<HelpPage> pages = pages_in(text);
    return pages;
}

}  // namespace dynlab::inline scripting
