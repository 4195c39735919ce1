#include "documents/document.h"

#include <re2/re2.h>

#include <algorithm>

#include "base/languages.h"
#include "documents/bibliography.h"
#include "documents/complaints.h"
#include "documents/error.h"
#include "documents/html/web_page.h"
#include "documents/latex.h"
#include "documents/latex_remains.h"
#include "documents/pandoc.h"
#include "documents/pictures.h"
#include "documents/template_file.h"
#include "documents/text_lines.h"
#include "documents/words/characters.h"
#include "platform/atomic_file.h"
#include "platform/program_lookup.h"
#include "platform/stopwatch.h"
#include "platform/temporary_folder.h"
#include "platform/utf8.h"

namespace dynlab::inline documents {
namespace {

namespace fs = std::filesystem;
/// The place in the source that LaTeX's complaint is about: formulas and words reach LaTeX as they were written, so
/// the longest end of the text before the error that occurs in the source shows the line.
Place origin_of_refusal(const LatexRefusal& refusal, const MarkdownText& markdown, const fs::path& file) {
    const std::string before = trimmed(refusal.text_before);
    constexpr std::size_t kMaxLength = 60, kMinLength = 5;
    for (std::size_t length = std::min(kMaxLength, before.size()); length >= kMinLength; --length) {
        const Place found = find_in(markdown, before.substr(before.size() - length), file);
        if (found.line > 0) return found;
    }
    return {file, 0};
}

/// The last heading above a line of the LaTeX text; on slides, the title of the slide. Empty where there is none.
std::string section_of(const std::string& body, int line) {
    static const RE2 slide(R"(\\begin\{frame\}(?:\[[^\]]*\])?\{(.*)\})", RE2::Latin1);
    std::string heading;
    const std::vector<std::string> lines = lines_of(body);
    for (int i = 0; i < std::min<int>(line, static_cast<int>(lines.size())); ++i) {
        const std::string& text = lines[static_cast<std::size_t>(i)];
        const std::size_t open = text.find('{');
        const bool is_heading =
            text.find("section{") != std::string::npos && text.starts_with("\\") && open < text.size();
        const std::size_t close = std::min(text.find("}\\label{"), text.rfind('}'));
        RE2::FullMatch(text, slide, &heading);
        if (is_heading) heading = text.substr(open + 1, close - open - 1);
    }
    return heading;
}

/// `before`: the text up to where LaTeX stopped.
Message refusal_message(const Message& reason, const std::string& section, const std::string& before) {
    if (section.empty())
        return before.empty() ? Message("LaTeX cannot typeset this document: {}", reason)
                              : Message("LaTeX cannot typeset this document after \"{}\": {}", before, reason);
    return before.empty() ? Message("LaTeX cannot typeset this document in section \"{}\": {}", section, reason)
                          : Message("LaTeX cannot typeset this document in section \"{}\" after \"{}\": {}", section,
                                    before, reason);
}

/// A character as a message shows it: accents on a dotted circle.
std::string shown(char32_t character) {
    return (is_mark(character) ? "\u25CC" : "") + utf8_of(character);
}

void begin_with_error(const std::string& message, const fs::path& file, MarkdownText& text) {
    MarkdownText begun;
    begun.append(error_block(message), file, 0);
    begun.text += text.text;
    begun.origin.insert(begun.origin.end(), text.origin.begin(), text.origin.end());
    for (Place& line : begun.origin) line.line = std::max(line.line, 1);
    text = std::move(begun);
}

/// One document on its way: each member function is one step.
class DocumentBuilder {
  public:
    DocumentBuilder(const DocumentSource& source, const fs::path& output, DocumentFormat format,
                    const DocumentMaker::Options& options)
        : source_(source),
          output_(output),
          format_(format),
          options_(options),
          shared_templates_(shared_folder() / "report_templates"),
          text_(prepared_text(source)),
          record_(source.record ? source.record : &nothing_reported_) {}

    void make(const std::function<void()>& wait_for_figures) {
        Stopwatch watch(options_.timings);
        Complaints complaints;
        check_characters(complaints);
        find_latex_brackets(text_.markdown, complaints);
        const std::string bibliography = placed_bibliography(source_, text_, work_.path(), complaints);
        const std::vector<PlacedPicture> logo = find_logo(complaints);
        PandocJob job = pandoc_job(bibliography);
        if (!logo.empty()) job.logo = logo.front().written_name;
        const PandocResult written = run_pandoc(job, complaints);
        std::vector<PlacedPicture> pictures =
            find_picture_files(written.pictures, text_.markdown, source_.template_file, format_, prefix(), complaints);
        pictures.insert(pictures.end(), logo.begin(), logo.end());
        // If a document cannot be made, its gaps are reported together with the errors.
        if (options_.gaps) (complaints.empty() ? *options_.gaps : complaints).add_all(written.gaps);
        complaints.throw_if_any();
        if (options_.pictures)
            for (const PlacedPicture& picture : pictures) options_.pictures->push_back(picture.file);
        watch.note("pandoc");
        if (wait_for_figures) wait_for_figures();
        const auto figures = find_figures(written.pictures, text_.markdown, source_.template_file, *record_, format_,
                                          prefix(), complaints);
        complaints.throw_if_any();
        pictures.insert(pictures.end(), figures.begin(), figures.end());
        watch.note("figures");
        write(written.text, pictures);
    }

  private:
    std::string prefix() const {
        if (format_ == DocumentFormat::kMarkdown) return output_.stem().string() + "_files/picture-";
        return "dynlab-picture-";
    }

    /// One picture, or none.
    std::vector<PlacedPicture> find_logo(Complaints& complaints) const {
        if (text_.logo_named_in.empty() || format_ == DocumentFormat::kMarkdown) return {};
        return find_picture_files({{0, false, text_.metadata.at("logo")}}, {}, text_.logo_named_in, format_, prefix(),
                                  complaints);
    }

    PandocJob pandoc_job(const std::string& bibliography) const {
        PandocJob job;
        job.markdown = text_.markdown;
        job.metadata = text_.metadata;
        job.rules = text_.rules;
        job.language = text_.language;
        job.record = record_;
        job.format = format_;
        job.template_file = source_.template_file;
        job.shared_templates = shared_templates_;
        job.picture_prefix = prefix();
        job.work_folder = work_.path();
        job.bibliography = bibliography;
        job.measures = source_.measures;
        job.names_values = source_.names_values;
        job.draft = options_.gaps != nullptr;
        return job;
    }

    void check_characters(Complaints& complaints) const {
        const PrintableCharacters printable = PrintableCharacters::of_html();
        int number = 0;
        for (const std::string& line : lines_of(text_.markdown.text)) {
            ++number;
            if (const auto sentence = printable.complaint(line))
                complaints.add(text_.markdown.origin_of(number), *sentence);
        }
        for (const auto& [key, value] : text_.metadata)
            if (const auto sentence = printable.complaint(value))
                complaints.add({source_.template_file}, Message("in {}: {}", key, *sentence));
        check_record(printable, complaints);
    }

    /// Only what a slot shows: other entries never reach the document.
    void check_record(const PrintableCharacters& printable, Complaints& complaints) const {
        const auto check = [&](const std::string& slot, const std::string& text, const auto& message) {
            const Place where = find_in(text_.markdown, slot, source_.template_file);
            const auto sentence = where.line > 0 ? printable.complaint(text) : std::nullopt;
            if (sentence) complaints.add(where, message(*sentence));
        };
        for (const auto& [name, value] : record_->values)
            check("`" + name + "`", value.text, [&slot = name](const Message& what) {
                return Message("in the reported value \"{}\": {}", slot, what);
            });
        for (const auto& [name, text] : record_->texts)
            check("name=" + name, text.markdown, [&slot = name](const Message& what) {
                return Message("in the reported text \"{}\": {}", slot, what);
            });
        for (const auto& [name, figure] : record_->figures)
            check("figure:" + name, figure.caption, [&slot = name](const Message& what) {
                return Message("in the caption of the reported figure \"{}\": {}", slot, what);
            });
        for (const auto& [name, table] : record_->tables) {
            std::string cells;
            for (const std::string& cell : table.header) cells += cell + " ";
            for (const auto& row : table.rows)
                for (const std::string& cell : row) cells += cell + " ";
            check("name=" + name, cells, [&slot = name](const Message& what) {
                return Message("in the reported table \"{}\": {}", slot, what);
            });
        }
    }

    void write(const std::string& text, const std::vector<PlacedPicture>& pictures) const {
        if (format_ == DocumentFormat::kPdf) {
            for (const PlacedPicture& picture : pictures)
                fs::copy_file(picture.file, work_.path() / picture.written_name);
            place_file_atomically(latex(text), output_);
        } else if (format_ == DocumentFormat::kHtml) {
            write_file_atomically(output_, whole_web_page(text, shared_templates_, pictures));
        } else {
            const fs::path folder = output_.parent_path() / (output_.stem().string() + "_files");
            if (!pictures.empty()) fs::create_directories(folder);
            for (const PlacedPicture& picture : pictures)
                write_file_atomically(folder / fs::path(picture.written_name).filename(), read_file(picture.file));
            write_file_atomically(output_, text);
        }
    }

    fs::path latex(const std::string& body) const {
        const std::string identity = fs::absolute(output_).lexically_normal().string() + "\n" +
                                     fs::absolute(source_.template_file).lexically_normal().string();
        try {
            const LatexLayout layout{shared_templates_, text_.language, text_.rules.slides};
            const LatexDocument document =
                run_latex({body, layout, work_.path(), identity, options_.use_cache, options_.latex_format,
                           options_.timings, options_.begun_format, options_.lualatex_fonts});
            if (options_.notes) add_notes(document);
            return document.pdf;
        } catch (const LatexRefusal& refusal) {
            const Place where = origin_of_refusal(refusal, text_.markdown, source_.template_file);
            const std::string& before = refusal.text_before;
            const std::string end = before.substr(before.size() - std::min<std::size_t>(before.size(), 50));
            throw DocumentError(where, refusal_message(refusal.message(), section_of(body, refusal.line),
                                                       trimmed(before).empty() ? "" : trimmed(end)));
        }
    }

    /// With the letter's place, where the text has one.
    void add_note(char32_t letter, const Message& sentence) const {
        const Place place = find_in(text_.markdown, utf8_of(letter), source_.template_file);
        options_.notes->push_back(place.line > 0 ? placed(place, sentence) : sentence);
    }

    /// "Д (U+0414, line 3)", in the order of the lines.
    MessageList with_lines(const std::set<char32_t>& letters) const {
        std::vector<std::pair<int, char32_t>> placed;
        for (const char32_t letter : letters)
            placed.emplace_back(find_in(text_.markdown, utf8_of(letter), source_.template_file).line, letter);
        std::ranges::sort(placed);
        MessageList list{{}, Join::kComma};
        for (const auto& [line, letter] : placed)
            list.items.push_back(line > 0 ? Message("{} ({}, line {})", shown(letter), code_of(letter), line)
                                          : Message::verbatim(shown(letter) + " (" + code_of(letter) + ")"));
        return list;
    }

    void add_notes(const LatexDocument& document) const {
        if (!document.first_beyond) return;
        const char32_t first = *document.first_beyond;
        add_note(
            first,
            document.by_lualatex
                ? Message("Because pdflatex cannot print \"{}\" ({}), LuaLaTeX creates this PDF, which takes longer",
                          shown(first), code_of(first))
                : Message("LuaLaTeX is not installed, and pdflatex cannot print the following letters, which are "
                          "printed as \"?\": {}. To print them, run sudo apt install {}",
                          with_lines(document.replaced), kLualatexPackages));
        if (!document.by_lualatex || document.replaced.empty()) return;
        add_note(*document.replaced.begin(), Message("no installed font has the following letters, which are printed "
                                                     "as \"?\": {}. To add fonts, run sudo apt install {}",
                                                     with_lines(document.replaced), "fonts-noto-core fonts-noto-cjk"));
    }

    const DocumentSource& source_;
    const fs::path& output_;
    DocumentFormat format_;
    const DocumentMaker::Options& options_;
    fs::path shared_templates_;
    RunRecord nothing_reported_;
    PreparedText text_;
    const RunRecord* record_ = nullptr;
    TemporaryFolder work_;
};

}  // namespace

PreparedText prepared_text(const DocumentSource& source) {
    const TemplateFile file = read_template(source.template_file);
    PreparedText text{with_cells(file, source.cells), file.metadata, document_rules(file), "en"};
    for (const auto& [key, value] : source.metadata) {
        check_metadata(key, value, {source.template_file});
        text.metadata[key] = value;
    }
    const TemplateFile settings = read_settings(own_file(shared_folder() / "report_templates/settings.yaml"));
    if (text.metadata.contains("logo"))
        text.logo_named_in = source.template_file;
    else if (settings.metadata.contains("logo"))
        text.logo_named_in = settings.file;
    for (const auto& [key, value] : settings.metadata) text.metadata.emplace(key, value);
    if (text.metadata.count("lang") && !text.metadata.at("lang").empty()) text.language = text.metadata.at("lang");
    if (source.record && source.record->error && !shows_cells(file))
        begin_with_error(source.record->error->text({catalog_of(text.language)}), source.template_file, text.markdown);
    return text;
}

LatexLayout latex_layout(const DocumentSource& source) {
    const PreparedText text = prepared_text(source);
    return {shared_folder() / "report_templates", text.language, text.rules.slides};
}

std::string placed_bibliography(const DocumentSource& source, const PreparedText& text, const fs::path& work_folder,
                                Complaints& complaints) {
    const auto own = text.metadata.find("bibliography");
    const bool has_own = own != text.metadata.end() && !own->second.empty();
    const fs::path file = has_own ? source.template_file.parent_path() / own->second : source.bibliography;
    return file.empty() ? "" : place_bibliography(file, work_folder, complaints);
}

DocumentFormat document_format(const fs::path& file) {
    const std::string extension = file.extension().string();
    if (extension == ".pdf") return DocumentFormat::kPdf;
    if (extension == ".html") return DocumentFormat::kHtml;
    if (extension == ".md") return DocumentFormat::kMarkdown;
    throw DocumentError(Place{file}, Message("the name of a document must end in .pdf, .html or .md"));
}

void DocumentMaker::make(const DocumentSource& source, const fs::path& output, DocumentFormat format,
                         const std::function<void()>& wait_for_figures) const {
    DocumentSource named = source;
    named.template_file = own_file(source.template_file);
    DocumentBuilder(named, output, format, options_).make(wait_for_figures);
}

}  // namespace dynlab::inline documents
