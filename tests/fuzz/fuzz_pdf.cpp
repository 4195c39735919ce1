// PDFs of others: their pages and everything inside, in guarded copies, and the copy that is cleaned.
#include "course/anonymity/anonymous_copy.h"
#include "course/anonymity/anonymity_findings.h"
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
        const Findings findings = name_findings(file, layout, names, {});
        fuzz::demand(findings.size() <= 42);
        const std::string clean = clean_pdf(file);
        const std::filesystem::path copy = fuzz::file_of(clean, "clean.pdf");
        for (const Finding& finding : name_findings(copy, read_pdf_layout(copy), names, {}))
            fuzz::demand(finding.id != "name-in-metadata" && finding.id != "name-in-attachment");
    } catch (const PdfRefusal& refusal) {
        fuzz::demand(*refusal.what() != '\0');
    }
    return 0;
}
