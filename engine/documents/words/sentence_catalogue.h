#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline documents {

/// Sentences of another language for those that are told to students and printed in documents. Its files hold pairs of
/// lines: a sentence as the program or a lesson's checks.lua writes it, with {} for what changes, and below it,
/// indented, the other language's, with as many {} in the same order. Lines that begin with # are remarks. For {n}
/// stands a number only, for {s} a sentence that is known, too.
class SentenceCatalogue {
  public:
    /// Adds the pairs of a file. Throws EnvironmentError with file and line for what is no pair.
    void add(const std::filesystem::path& file);

    /// The text, sentence by sentence, in the other language: of several entries that fit, the one with most letters
    /// of its own; a sentence that none fits stays. For {} within a sentence stands no end of another, but in quotation
    /// marks. What stands for {} is looked up as well; where it begins with a
    /// number, such as "15.9 %" or "-1.5e-05", its point becomes a comma, but for what stands in quotation marks. File
    /// and line before the message of a script, and the functions that say it, stay: "analysis.lua:3: fit: ...".
    std::string translated(std::string_view text) const;

    /// What a program prints, line by line; its name before a line ("dynlab: note: ...") stays.
    std::string translated_lines(std::string_view printed) const;

    /// Whether an entry is this sentence.
    bool knows(std::string_view sentence) const;

  private:
    struct Entry {
        std::vector<std::string> from, to;  ///< the pieces between the {}
        std::string places;                 ///< what stands for each {}: 'n', 's', or ' ' for anything
        std::size_t letters = 0;
    };
    struct Fit {
        const Entry* entry;
        std::vector<std::string_view> between;
        std::size_t end;
    };
    struct Named {
        std::size_t names = 0;  ///< how much of the text are names of functions
        std::optional<Fit> sentence;
    };
    enum class Extent { kAll, kFirstSentence };  ///< of a text; the first sentence may be all
    std::string told_line(std::string_view message) const;
    Named behind_names(std::string_view text) const;
    bool may_stand_for(char place, std::string_view text) const;
    std::optional<Fit> fit(const Entry& entry, std::string_view text) const;
    std::optional<Fit> fitting(std::string_view text, Extent extent) const;
    std::string written(const Fit& found) const;

    std::vector<Entry> entries_;
};

/// French: report_templates/sentences.fr.txt and script_errors.fr.txt, read once.
const SentenceCatalogue& shared_french_sentences();

/// What help pages say of the arguments and options of methods: report_templates/option_words.fr.txt, read once.
const SentenceCatalogue& french_option_words();

/// What numerics says of records, models and errors: report_templates/engine_sentences.fr.txt, read once.
const SentenceCatalogue& french_engine_sentences();
/// Where french_engine_sentences() reads them in a process that does not see report_templates; before their first use.
void read_french_engine_sentences_from(const std::filesystem::path& file);
/// In this installation.
std::filesystem::path file_of_french_engine_sentences();

}  // namespace dynlab::inline documents
