#include "course/feedback.h"

#include <fmt/format.h>

#include <cctype>
#include <string_view>

#include "documents/document.h"
#include "documents/error.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr auto kTime = std::chrono::seconds(30);

std::string plain_ascii(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) > 126) c = '?';
    return text;
}

std::string item_of(const json& check) {
    const bool graded = check.at("graded");
    const double points = check.at("points"), earned = check.at("earned");
    const std::string message = check.at("visible").get<bool>() ? check.at("message") : json("");
    const std::string hint = check.at("hint");
    std::string item =
        fmt::format("- **{}** – {}", escaped_markdown(check.at("about")),
                    graded ? fmt::format("{} of {}", points_text(earned), points_text(points)) : "not graded yet");
    if (earned < points && graded) {
        if (!message.empty()) item += "\\\n  " + escaped_markdown(message);
        if (!hint.empty()) item += "\\\n  *" + escaped_markdown(hint) + "*";
    } else if (!message.empty()) {
        item += "\\\n  " + escaped_markdown(message);
    }
    return item + "\n";
}

RunRecord record_of(const json& grade, bool ascii) {
    const auto text = [ascii](const json& j) {
        return ascii ? plain_ascii(j.get<std::string>()) : j.get<std::string>();
    };
    RunRecord record;
    record.script = "feedback";
    for (const char* name : {"submission", "lesson", "points", "possible", "lateness"})
        record.values[name] = {{}, text(grade.at(name))};
    std::string items;
    for (const json& check : grade.at("checks")) items += item_of(check);
    record.texts["checks"] = {ascii ? plain_ascii(items) : items};
    const std::string trouble = text(grade.at("trouble"));
    record.texts["trouble"] = {trouble.empty()
                                   ? "Your script ran to its end."
                                   : "**Your script did not run to its end:** " + escaped_markdown(trouble)};
    return record;
}

json json_of(const Grade& grade) {
    json j = {{"submission", grade.submission},
              {"lesson", grade.lesson},
              {"points", points_text(grade.earned())},
              {"possible", points_text(grade.possible())},
              {"lateness", grade.penalty > 0 ? fmt::format("It came {:.1f} hours late, which costs {} points.",
                                                           grade.late_hours, points_text(grade.penalty))
                                             : ""},
              {"trouble", grade.trouble},
              {"checks", json::array()}};
    for (const CheckGrade& check : grade.checks)
        j["checks"].push_back({{"about", check.about},
                               {"hint", check.hint},
                               {"message", check.message},
                               {"points", check.points},
                               {"earned", check.earned},
                               {"visible", check.visible},
                               {"graded", check.graded}});
    return j;
}

}  // namespace

std::string points_text(double points) {
    std::string text = fmt::format("{:.2f}", points);
    while (text.ends_with('0')) text.pop_back();
    if (text.ends_with('.')) text.pop_back();
    return text;
}

std::string escaped_markdown(const std::string& text) {
    constexpr std::string_view kHarmless = ",.:;%?!'\"()/";
    std::string result;
    // Documents refuse a word {=latex} wherever it stands, as it marks raw output.
    for (const char c : replaced(text, "{=", "{ =")) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7F) {
            result += ' ';
            continue;
        }
        // Character references: a backslash before = and others would be taken for TeX.
        if (byte < 0x80 && std::ispunct(byte) && kHarmless.find(c) == std::string_view::npos)
            result += fmt::format("&#{};", byte);
        else
            result += c;
    }
    return result;
}

json make_feedback(const json& job) {
    const fs::path to = job.at("to").get<std::string>();
    DocumentSource source;
    source.template_file = shared_folder() / "report_templates" / "feedback.md";
    DocumentMaker::Options options;
    options.use_cache = false;
    const DocumentMaker maker(options);
    for (const bool pdf : {false, true}) {
        if (pdf && !job.at("pdf").get<bool>()) continue;
        const fs::path file = to / (pdf ? "feedback.pdf" : "feedback.md");
        const auto make = [&](bool ascii) {
            const RunRecord record = record_of(job.at("grade"), ascii);
            source.record = &record;
            maker.make(source, file, pdf ? DocumentFormat::kPdf : DocumentFormat::kMarkdown, [] {});
        };
        try {
            make(false);
        } catch (const DocumentError&) {
            make(true);  // letters that LaTeX does not have
        }
    }
    return json::object();
}

void write_feedback(const Grade& grade, const fs::path& folder, bool pdf, const GradingSetup& setup) {
    const TemporaryFolder made;
    Box box(setup.isolation);
    box.add_document_programs();
    const fs::path templates = box.add(shared_folder() / "report_templates", "/box/home/report_templates");
    box.add(shared_folder() / "data", "/box/home/data");
    box.set_environment("DYNLAB_HOME", templates.parent_path().string());
    const fs::path to = box.add_writable(made.path(), "/box/feedback");
    const BoxedResult result =
        run_boxed(box, setup.program,
                  {{"work", "feedback"}, {"grade", json_of(grade)}, {"to", to.string()}, {"pdf", pdf}}, kTime);
    if (!result.output) throw EnvironmentError("the feedback cannot be written: " + result.reason);
    for (const char* name : {"feedback.md", "feedback.pdf"})
        if (fs::exists(made.path() / name)) place_file_atomically(made.path() / name, folder / name);
}

}  // namespace dynlab
