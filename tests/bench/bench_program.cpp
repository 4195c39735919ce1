#include <fmt/format.h>

#include <regex>
#include <stdexcept>

#include "bench/bench.h"
#include "bench/program_work.h"
#include "platform/program_lookup.h"
#include "support/program.h"

namespace dynlab::bench {
namespace {

namespace fs = std::filesystem;
using test::Workbench;

constexpr int kRepetitions = 11;

void measure_start(const Workbench& bench, Report& report) {
    const auto start = [&] { must_succeed(bench.dynlab({"run", "-e", "print(1)"})); };
    start();
    report.results.push_back(
        {"dynlab run -e 'print(1)' (s)", "20 ms", median_seconds(kRepetitions, start), 0.020, 1, 0});
    if (!find_program("octave-cli")) {
        report.left_out.push_back("dynlab run -e 'print(1)' against octave-cli --eval 1");
        return;
    }
    const auto octave = [&] { must_succeed(bench.shell("octave-cli --eval 1")); };
    octave();
    const auto [ours, theirs] = paired_medians(5, start, octave);
    report.results.push_back(
        {"dynlab run -e 'print(1)' (s)", "octave-cli --eval 1 (s)", ours, theirs, 1.0 / 4, 1.0 / 8});
}

/// The same document for plain pandoc: slots replaced by what dynlab put there, figures by the files dynlab drew.
std::string plain_markdown(const Workbench& bench, std::string text) {
    must_succeed(bench.dynlab({"report", "six", "-o", "plain.md"}));
    must_succeed(bench.dynlab({"run", "six/analysis.lua", "--out", "drawn"}));
    text = bench.read("plain.md");
    std::vector<std::string> drawn;
    for (const auto& entry : fs::directory_iterator(bench.path("drawn"))) {
        if (entry.path().extension() == ".pdf") drawn.push_back(entry.path());
    }
    std::sort(drawn.begin(), drawn.end());
    std::size_t next = 0;
    const std::regex image(R"(\]\([^)]*\.svg\))");
    for (std::smatch match; std::regex_search(text, match, image) && next < drawn.size();) {
        text = std::string(match.prefix()) + "](" + drawn[next++] + ")" + std::string(match.suffix());
    }
    if (next != drawn.size()) throw std::runtime_error("the plain document must show every figure");
    return text;
}

void measure_report(const Workbench& bench, Report& report) {
    make_six_pages(bench);
    const std::string text = bench.read("six/report.md");
    const std::string plain = plain_markdown(bench, text);
    bench.write("in.md", plain);

    int edit = 0;
    const auto ours = [&](const char* output) {
        bench.write("six/report.md", text + fmt::format("\nThe text was edited {} times.\n", ++edit));
        must_succeed(bench.dynlab({"report", "six", "-o", output}));
    };
    const auto pandoc = [&] { must_succeed(bench.shell("pandoc in.md -o out.pdf")); };
    ours("six/report.pdf");
    pandoc();
    const auto [edited, peer] = paired_medians(
        kRepetitions, [&] { ours("six/report.pdf"); }, pandoc);
    report.results.push_back(
        {"six-page report after an edit (s)", "pandoc in.md -o out.pdf (s)", edited, peer, 0.6, 0.5});

    const auto unchanged = [&] { must_succeed(bench.dynlab({"report", "six"})); };
    unchanged();
    report.results.push_back(
        {"six-page report, unchanged (s)", "50 ms", median_seconds(kRepetitions, unchanged), 0.050, 1, 0});
    ours("report.html");
    const double html = median_seconds(kRepetitions, [&] { ours("report.html"); });
    report.results.push_back({"six-page report as HTML after an edit (s)", "0.25 s", html, 0.25, 1, 0});
}

void measure_memory(const Workbench& bench, Report& report) {
    for (const char* lesson : {"01", "02"}) {
        const ChildResult made = bench.dynlab({"report", lesson, "--timings", "--seed", "12345"});
        must_succeed(made);
        std::smatch megabytes;
        if (!std::regex_search(made.output, megabytes, std::regex(R"(([0-9.]+) MB  peak memory)"))) {
            throw std::runtime_error("--timings no longer tells the peak memory");
        }
        report.results.push_back(
            {fmt::format("peak memory of lesson {} (MB)", lesson), "100 MB", std::stod(megabytes[1]), 100, 1, 0});
    }
}

}  // namespace

void measure_program(Report& report) {
    const Workbench bench;
    measure_start(bench, report);
    measure_report(bench, report);
    measure_memory(bench, report);
}

}  // namespace dynlab::bench
