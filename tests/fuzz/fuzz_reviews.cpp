// Reviews and reports as text on pages: each word of the input is one of a line. Words and paragraphs hold no more than
// the input; a diff leads from one text to the other.
#include "course/review/word_diff.h"
#include "fuzz/fuzz_input.h"

using namespace dynlab;

namespace {

/// Lines of words; a line that begins with a digit has that size, a form feed begins a page.
PdfLayout pages_of(const std::string& text) {
    PdfLayout layout;
    layout.pages.push_back({595, 842, {}});
    double top = 50;
    std::string word;
    double left = 50, size = 10;
    for (const char c : text + "\n") {
        if (c != ' ' && c != '\n' && c != '\f') {
            if (word.empty() && left == 50 && c >= '1' && c <= '9') size = 6 + 2 * (c - '0');
            word += c;
            continue;
        }
        if (!word.empty()) {
            const double right = left + 0.5 * size * static_cast<double>(word.size());
            layout.pages.back().words.push_back(
                {left, top, right, top + size, size, size > 12, false, false, true, word});
            left = right + 0.3 * size;
            word.clear();
        }
        if (c == ' ') continue;
        top += 1.2 * size;
        left = 50;
        size = 10;
        if (c == '\f' || top > 800) {
            layout.pages.push_back({595, 842, {}});
            top = 50;
        }
    }
    return layout;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text = fuzz::text_of(data, size);
    const DocumentText document = text_of_layout(pages_of(text));
    for (const ReviewBlock& block : blocks_of_review(document)) fuzz::demand(!block.text.empty());
    const std::vector<ReportWord> printed = words_of_pdf(document), source = words_of_markdown(text);
    const WordDiff diff = word_diff(printed, source);
    std::size_t before = 0, after = 0;
    for (const MarkedWords& piece : diff.pieces) {
        before += piece.mark == '+' ? 0 : piece.words.size();
        after += piece.mark == '-' ? 0 : piece.words.size();
    }
    fuzz::demand(before == printed.size() && after == source.size());
    return 0;
}
