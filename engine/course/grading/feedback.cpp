#include "course/grading/feedback.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "base/reader.h"
#include "course/findings/french_sentences.h"
#include "documents/run_record.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/hash.h"
#include "platform/program_identity.h"
#include "platform/program_lookup.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr char kTemplate[] = "feedback.md";

using Escape = std::string (*)(const std::string&);

/// The feedback of one submission in its language; texts of others are made harmless by `escape`.
class FeedbackText {
  public:
    FeedbackText(const Grade& grade, Escape escape)
        : grade_(grade), words_(feedback_words(grade.language)), escape_(escape) {
        if (grade.language == "fr") sentences_ = french_sentences(grade.lesson);
    }

    std::string heading() const { return filled(words_.title, escape_(title())); }
    std::string title() const { return grade_.title.empty() ? grade_.submission : grade_.title; }
    std::string plain_title() const { return filled(words_.title, title()); }
    const char* checks_heading() const { return words_.checks; }

    std::string result() const {
        std::string text =
            filled(words_.result, escape_(grade_.lesson), points(grade_.earned()), points(grade_.possible()));
        if (grade_.penalty > 0) text += " " + filled(words_.late, points(grade_.penalty), grade_.lateness_told);
        if (!grade_.counts_instead.empty())
            text += "\n\n" + filled(grade_.newest_counts ? words_.newest_counts : words_.better_counts,
                                    escape_(grade_.counts_instead));
        return text;
    }

    std::string trouble() const {
        if (grade_.trouble.empty()) return grade_.silent ? words_.silent : words_.ran;
        const char* const what = grade_.unreadable ? words_.unreadable
                                 : grade_.began    ? words_.not_ended
                                                   : words_.not_begun;
        return what + told_trouble();
    }

    std::string checks() const {
        std::string items;
        for (const CheckGrade& check : grade_.checks) items += item_of(check);
        return items;
    }

    std::string closing() const { return words_.closing; }

  private:
    template <class... Parts>
    static std::string filled(const char* text, const Parts&... parts) {
        return fmt::format(fmt::runtime(text), parts...);
    }

    std::string points(double number) const {
        std::string text = points_text(number);
        if (grade_.language == "fr") std::replace(text.begin(), text.end(), '.', ',');
        return text;
    }

    /// A list item.
    std::string item_of(const CheckGrade& check) const {
        std::string item = fmt::format(
            "- **{}** – {}", told(check.about),
            check.graded ? filled(words_.of, points(check.earned), points(check.points)) : words_.not_graded);
        if (check.visible && !check.message.empty()) item += "\\\n  " + told(message_text(check.message));
        if (check.earned < check.points && check.graded && !check.hint.empty())
            item += "\\\n  *" + told(check.hint) + "*";
        return item + "\n";
    }

    std::string told(const std::string& sentence) const { return escaped(sentences_.translated(sentence)); }

    /// French sets a space before a colon, which is none of "analysis.lua:3": there the place is code.
    std::string told_trouble() const {
        static const RE2 kPlace(R"(^([\w.-]+\.lua:\d+): )", RE2::Latin1);
        const std::string text = sentences_.translated(message_text(grade_.trouble));
        std::string place;
        if (grade_.language != "fr" || !RE2::PartialMatch(text, kPlace, &place)) return escaped(text);
        return "`" + place + "`" + escaped(text.substr(place.size()));
    }

    /// Quotation marks stay straight on paper: hints quote code.
    std::string escaped(const std::string& text) const {
        return escape_ == escaped_markdown ? replaced(escape_(text), "\"", "&#34;") : escape_(text);
    }

    const Grade& grade_;
    const FeedbackWords& words_;
    SentenceCatalogue sentences_;
    Escape escape_;
};

RunRecord feedback_record(const FeedbackText& text) {
    RunRecord record;
    record.script = "feedback";
    record.texts["result"] = {text.result()};
    record.texts["checks"] = {text.checks()};
    record.texts["trouble"] = {text.trouble()};
    record.texts["closing"] = {text.closing()};
    return record;
}

/// A line for all that the PDF is made from, the same text in another form among it, and one for the PDF itself.
std::string text_and_document(const std::string& markdown, const fs::path& pdf) {
    const std::string layout = digest_of_folder(shared_folder() / "report_templates").hex();
    return fmt::format("{}\n{}\n", sha256_of(program_identity() + "\n" + layout + "\n" + markdown),
                       sha256_of_file(pdf));
}

constexpr FeedbackWords kEnglishFeedback = {
    "Feedback for {}",
    "Lesson {}: **{} of {} points.**",
    "{} of {} points.",
    ": ",
    "{} of {}",
    "not graded yet",
    "Checks",
    "Your script ran to its end.",
    "Your script ran to its end but gave no answer.",
    "**Your work could not be read, so it has no marks yet:** ",
    "**Your script could not be begun:** ",
    "**Your script did not run to its end:** ",
    "It was late, which costs {} points: {}.",
    "**This hand-in does not count.** Of several from you the better one counts: {}.",
    "**This hand-in does not count.** Of several from you the newest one counts: {}.",
    "Points are given by programs that hold your answers against your data and against records that nobody has seen. "
    "If you think that one of them is wrong, tell your instructor which, and why.",
};

constexpr FeedbackWords kFrenchFeedback = {
    "Retour pour {}",
    "Leçon {}, points : **{} sur {}.**",
    "Points : {} sur {}.",
    " : ",
    "{} sur {}",
    "pas encore noté",
    "Contrôles",
    "Votre script est allé jusqu'au bout.",
    "Votre script est allé jusqu'au bout, mais n'a donné aucune réponse.",
    "**Votre travail n'a pas pu être lu ; il n'a donc pas encore de note :** ",
    "**Votre script n'a pas pu commencer :** ",
    "**Votre script n'est pas allé jusqu'au bout :** ",
    "Il est arrivé en retard ; points perdus : {} ({}).",
    "**Cette remise ne compte pas.** De plusieurs remises de votre part, la meilleure compte : {}.",
    "**Cette remise ne compte pas.** De plusieurs remises de votre part, la plus récente compte : {}.",
    "Les points sont donnés par des programmes qui comparent vos réponses avec vos données et avec des enregistrements "
    "que personne n'a vus. Si vous pensez que l'un d'eux se trompe, dites à votre enseignant lequel, et pourquoi.",
};

}  // namespace

std::string points_text(double points) {
    std::string text = fmt::format("{:.2f}", points);
    while (text.ends_with('0')) text.pop_back();
    if (text.ends_with('.')) text.pop_back();
    return text;
}

std::string readable_markdown(const std::string& text) {
    constexpr std::string_view kMeaningful = "\\`*_{}[]<>#|$~^";
    std::string result;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (kMeaningful.find(c) != std::string_view::npos) result += '\\';
        result += byte < 0x20 || byte == 0x7F ? ' ' : c;
    }
    return result;
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

std::string feedback_markdown(const Grade& grade) {
    const FeedbackText text(grade, readable_markdown);
    return fmt::format("# {}\n\n{}\n\n{}\n\n## {}\n\n{}\n{}\n", text.heading(), text.result(), text.trouble(),
                       text.checks_heading(), text.checks(), text.closing());
}

void set_feedback(const Grade& grade, const fs::path& pdf, const fs::path& made, const BoxedDocuments* documents) {
    const std::string markdown = feedback_markdown(grade);
    if (fs::exists(pdf) && fs::exists(made) && read_file(made) == text_and_document(markdown, pdf)) return;
    fs::remove(pdf);
    if (!documents) return;
    const FeedbackText text(grade, escaped_markdown);
    documents->make(kTemplate, feedback_record(text), pdf,
                    {{"title", text.plain_title()}, {"lang", grade.language == "fr" ? "fr" : "en"}});
    fs::create_directories(made.parent_path());
    write_file_atomically(made, text_and_document(markdown, pdf));
}

const FeedbackWords& feedback_words(const std::string& language) {
    return language == "fr" ? kFrenchFeedback : kEnglishFeedback;
}

}  // namespace dynlab::inline course
