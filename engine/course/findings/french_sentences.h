#pragma once
#include <string>

#include "documents/words/sentence_catalogue.h"

namespace dynlab::inline course {

/// The shared French sentences, and those of checks.fr.txt of the lesson where it is installed and has one.
SentenceCatalogue french_sentences(const std::string& lesson = "");

}  // namespace dynlab::inline course
