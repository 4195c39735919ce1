#include "course/findings/findings_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "course/names/plain_words.h"
#include "data_io/values/json_values.h"

namespace dynlab::inline course {
namespace {

constexpr const char *kBold = "\033[1m", *kRed = "\033[31m", *kYellow = "\033[33m", *kGreen = "\033[32m",
                     *kFaint = "\033[2m", *kPlain = "\033[0m";
constexpr std::size_t kLineWidth = 100;

/// Words of a sentence on lines of at most kLineWidth that begin with `first` and then with as many spaces.
std::string wrapped(const std::string& sentence, const std::string& first) {
    const std::string indent(first.size(), ' ');
    std::string result, line = first;
    bool empty = true;
    for (std::size_t start = 0; start < sentence.size();) {
        const std::size_t end = std::min(sentence.find(' ', start), sentence.size());
        const std::string word = sentence.substr(start, end - start);
        if (!empty && line.size() + 1 + word.size() > kLineWidth) {
            result += line + "\n";
            line = indent;
            empty = true;
        }
        line += (empty ? "" : " ") + word;
        empty = false;
        start = end + 1;
    }
    return result + line + "\n";
}

std::string place_of(const Finding& finding) {
    if (!finding.place.empty()) return finding.place;
    return finding.page > 0 ? fmt::format("page {}", finding.page) : "";
}

class Writer {
  public:
    explicit Writer(bool in_colour) : in_colour_(in_colour) {}

    std::string styled(const char* style, const std::string& text) const {
        return in_colour_ ? style + text + kPlain : text;
    }

    /// Findings of one severity, those of one kind together; a remedy they share stands once.
    std::string group(const CheckResult& result, Severity severity, const char* style, const std::string& title) const {
        std::vector<std::pair<std::string, std::vector<const Finding*>>> kinds;
        std::size_t count = 0;
        for (const Finding& finding : result.findings) {
            if (finding.severity != severity) continue;
            ++count;
            const auto same = [&finding](const auto& kind) { return kind.first == finding.id; };
            const auto known = std::find_if(kinds.begin(), kinds.end(), same);
            (known == kinds.end() ? kinds.emplace_back(finding.id, std::vector<const Finding*>()) : *known)
                .second.push_back(&finding);
        }
        if (count == 0) return "";
        std::string text = "\n" + styled(style, fmt::format("{} ({})", title, count)) + "\n";
        for (const auto& [id, findings] : kinds) text += "\n  " + styled(kBold, id) + "\n" + all_of(findings);
        return text;
    }

    std::string all_of(const std::vector<const Finding*>& findings) const {
        std::string text;
        for (std::size_t i = 0; i < findings.size(); ++i) {
            const std::string place = place_of(*findings[i]);
            text += wrapped(printable((place.empty() ? "" : place + ": ") + findings[i]->what, 2000), "    ");
            const bool last = i + 1 == findings.size() || findings[i + 1]->remedy != findings[i]->remedy;
            if (last) text += styled(kFaint, wrapped(printable(findings[i]->remedy, 2000), "    -> "));
        }
        return text;
    }

  private:
    bool in_colour_;
};

nlohmann::json or_null(const std::string& text) {
    return text.empty() ? nlohmann::json() : nlohmann::json(printable(text, 4000));
}

nlohmann::json or_null(int number) {
    return number == 0 ? nlohmann::json() : nlohmann::json(number);
}

}  // namespace

std::string findings_in_words(const CheckResult& result, bool in_colour) {
    const Writer writer(in_colour);
    const std::string as = result.template_name.empty() ? "" : " as " + printable(result.template_name);
    const std::string checked =
        fmt::format("checked{}{}{}", as, result.checked.empty() ? "" : ": ", fmt::join(result.checked, ", "));
    const std::string subject = printable(result.subject);
    if (result.findings.empty())
        return fmt::format("{}: {}; {}.\n", subject, writer.styled(kGreen, "nothing to mend"), checked);
    const auto rules = std::count_if(result.findings.begin(), result.findings.end(),
                                     [](const Finding& finding) { return finding.severity == Severity::kRule; });
    std::string text =
        fmt::format("{}{}\n", writer.styled(kBold, subject), result.checked.empty() ? "" : ": " + checked);
    text += writer.group(result, Severity::kRule, kRed, "Rules broken");
    text += writer.group(result, Severity::kHint, kYellow, "Hints");
    if (rules == 0) text += "\n" + writer.styled(kGreen, "No rule is broken.") + "\n";
    return text;
}

std::string findings_as_json(const CheckResult& result) {
    nlohmann::ordered_json out;
    out["subject"] = printable(result.subject, 4000);
    out["template"] = or_null(result.template_name);
    out["language"] = or_null(result.language);
    out["pages"] = or_null(result.pages);
    out["passed"] = result.passed();
    out["checked"] = result.checked;
    out["findings"] = nlohmann::ordered_json::array();
    for (const Finding& finding : result.findings) {
        out["findings"].push_back({{"id", finding.id},
                                   {"severity", finding.severity == Severity::kRule ? "rule" : "hint"},
                                   {"page", or_null(finding.page)},
                                   {"place", or_null(finding.place)},
                                   {"what", printable(finding.what, 4000)},
                                   {"remedy", printable(finding.remedy, 4000)}});
    }
    return out.dump(2) + "\n";
}

CheckResult findings_from_json(const std::string& json) {
    const nlohmann::json in = parsed_json(json);
    const auto text = [](const nlohmann::json& value) { return value.is_null() ? "" : value.get<std::string>(); };
    const auto number = [](const nlohmann::json& value) { return value.is_null() ? 0 : value.get<int>(); };
    try {
        CheckResult result;
        result.subject = in.at("subject");
        result.template_name = text(in.at("template"));
        result.language = text(in.at("language"));
        result.pages = number(in.at("pages"));
        result.checked = in.at("checked").get<std::vector<std::string>>();
        for (const nlohmann::json& one : in.at("findings"))
            result.findings.push_back({one.at("id"), one.at("severity") == "rule" ? Severity::kRule : Severity::kHint,
                                       number(one.at("page")), text(one.at("place")), one.at("what"),
                                       one.at("remedy")});
        return result;
    } catch (const nlohmann::json::exception&) {
        throw EnvironmentError("these are not findings that dynlab check wrote");
    }
}

}  // namespace dynlab::inline course
