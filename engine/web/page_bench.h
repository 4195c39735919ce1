#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "data_io/values/described.h"
#include "scripting/memoized_calls/memoized_call.h"

namespace dynlab::inline web {

/// Begins a session of the workbench in a page.
struct BenchOpening {
    std::string file;               ///< place of the script in the page's files
    std::string source;             ///< the script; empty: that of a new session
    std::vector<std::string> past;  ///< scripts before this one, oldest first: what undo goes back to
    std::string prelude;            ///< engine/app/workbench/views.lua
    std::string stopped;            ///< id of the cell that the user has stopped; the cells before it run. Empty: none
};
DYNLAB_DESCRIBE(BenchOpening, file, source, past, prelude, stopped)

/// What the page asks, as it asks the server of `dynlab app`: "script", "look", "columns", ... (workbench_page.cpp).
struct BenchOrder {
    std::string path, name;  ///< name: the parameter of the address
    std::string body;
};
DYNLAB_DESCRIBE(BenchOrder, path, name, body)

struct BenchReply {
    int status = 200;  ///< of HTTP
    std::string text;
};
DYNLAB_DESCRIBE(BenchReply, status, text)

void open_bench(const BenchOpening& opening, const CallCache& calls);
BenchReply answer_bench(const BenchOrder& order);
/// Runs the next part of the script and its views that is older than the last order, and returns whether more are left.
/// What the page shows is news: {kind: "page", page, past}, `past` as that of the opening and only when it is another.
bool work_for_bench();

}  // namespace dynlab::inline web
