// What the search for names reads of PDFs, in this process.
#include "course/anonymity/identity_matcher.h"
#include "documents/pdf/plain_streams.h"
#include "fuzz/fuzz_input.h"

using namespace dynlab;

namespace {

IdentityMatcher people() {
    IdentityMatcher names;
    const auto know = [&names](const char* id, const char* name, const char* group, bool own) {
        Student student;
        student.id = id;
        student.name = name;
        student.group = group;
        names.add(student, own);
    };
    know("20214711", "Ada Lovelace", "group-01", true);
    know("20214712", "Bo Li", "group-01", true);
    know("20215001", "Renée Müller-Lüdenscheid", "group-11", false);
    return names;
}

void search(const std::string& text) {
    static const IdentityMatcher names = people();
    for (const TextManner manner : {TextManner::kProse, TextManner::kData})
        for (const NameHit& hit : names.find(text, manner))
            fuzz::demand(hit.begin < hit.end && !hit.written.empty() && !hit.who.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string text = fuzz::text_of(data, size);
    if (fuzz::take_choice(text) % 2 == 0)
        search(text);
    else
        with_plain_streams(text);
    return 0;
}
