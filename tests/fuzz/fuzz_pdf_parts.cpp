// What the search for names reads inside of PDFs, piece by piece in this process.
#include "course/anonymity/byte_text.h"
#include "course/anonymity/content_text.h"
#include "course/anonymity/jpeg_parts.h"
#include "course/anonymity/identity_matcher.h"
#include "documents/pdf/inflate.h"
#include "documents/pdf/plain_streams.h"
#include "fuzz/fuzz_input.h"

using namespace dynlab;

namespace {

IdentityMatcher names_to_seek() {
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

void seek(const std::string& text) {
    static const IdentityMatcher names = names_to_seek();
    for (const TextManner manner : {TextManner::kProse, TextManner::kData, TextManner::kBytes})
        for (const NameHit& hit : names.find(text, manner))
            fuzz::demand(hit.begin < hit.end && hit.end <= text.size() && !hit.who.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string text = fuzz::text_of(data, size);
    switch (fuzz::take_choice(text) % 8) {
        case 0: {
            const std::string picture = parts_of_jpeg(text).picture;
            fuzz::demand(parts_of_jpeg(picture).picture.size() <= picture.size());
            break;
        }
        case 1: {
            UnshownText unshown;
            shows_text(text);
            seek(shown_text(shown_pieces(text, &unshown)));
            break;
        }
        case 2: {
            const CodeMap map = code_map(text);
            fuzz::demand(map.bytes > 0);
            shown_text(shown_pieces(text), &map);
            break;
        }
        case 3:
            seek(text);
            break;
        case 4:
            seek(without_references(text_in(text)));
            break;
        case 5:
            texts_of_archive(text);
            compressed_inside(text);
            break;
        case 6:
            fuzz::demand(inflate(text, 1u << 20).bytes.size() <= (2u << 20));
            text_of_glyph(text);
            break;
        default:
            with_plain_streams(text);
    }
    return 0;
}
