#include "course/findings/french_sentences.h"

#include <filesystem>

#include "workflow/lesson_catalogue.h"

namespace dynlab::inline course {

SentenceCatalogue french_sentences(const std::string& lesson) {
    SentenceCatalogue sentences = shared_french_sentences();
    for (const Lesson& one : lessons()) {
        const std::filesystem::path file = one.folder / "checks.fr.txt";
        if (one.slug == lesson && std::filesystem::is_regular_file(file)) sentences.add(file);
    }
    return sentences;
}

}  // namespace dynlab::inline course
