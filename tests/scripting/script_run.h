#pragma once
#include <string>

#include "figures/gnuplot_renderer.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/runtime/services.h"

namespace dynlab::test {

/// `language`: of the document that the script is of.
inline RunRecord run(const std::string& code, RunOptions options = {}, const std::string& language = "en") {
    GnuplotRenderer renderer;
    ReportLanguage report{language};
    Runtime runtime(std::move(options), renderer);
    runtime.services().language = &report;
    return runtime.run_code(code, "lesson.lua");
}

/// All text that `code` prints; its error message when it stops with one.
inline std::string printed(const std::string& code, RunOptions options = {}, const std::string& language = "en") {
    const RunRecord record = run(code, std::move(options), language);
    if (record.error) return "ERROR " + record.error->text();
    std::string text;
    for (const auto& [cell, pieces] : record.outputs)
        for (const CellOutput& piece : pieces) text += piece.printed;
    return text;
}

/// The message with which `code` stops.
inline std::string error_of(const std::string& code, RunOptions options = {}) {
    const RunRecord record = run(code, std::move(options));
    return record.error ? record.error->text() : "(no error)";
}

}  // namespace dynlab::test
