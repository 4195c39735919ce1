// PDFs of others: their pages and everything inside, in guarded copies.
#include "course/anonymity/anonymity_issues.h"
#include "fuzz/fuzz_input.h"
#include "platform/error.h"

using namespace dynlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Student student;
    student.id = "20214711";
    student.name = "Zoé Brandtner";
    student.group = "group-07";
    IdentityMatcher names;
    names.add(student, true);
    const std::filesystem::path file = fuzz::file_of(fuzz::text_of(data, size), "input.pdf");
    try {
        const PdfLayout layout = read_pdf_layout(file);
        fuzz::demand(anonymity_findings(file, layout, names).size() <= 45);
    } catch (const PdfRefusal& refusal) {
        fuzz::demand(*refusal.what() != '\0');
    }
    return 0;
}
