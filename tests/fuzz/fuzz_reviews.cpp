// Forms of reviews and reports as text on pages: each word of the input is one of a line. Remarks, headings and
// sentences hold no more than what was there.
#include "course/review/remarks.h"
#include "course/review/report_text.h"
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
    const ReviewForm form{{"Greatest strength"}, {"Scores"}};
    for (const Remark& remark : remarks_in(document, form)) fuzz::demand(!remark.text.empty() && remark.page >= 1);
    for (const ReportText& report : {report_text_of_pdf(document), report_text_of_markdown(text)})
        for (const ReportSentence& sentence : report.sentences) fuzz::demand(sentence.section < report.sections.size());
    sentences_of(text);
    return 0;
}
