// RE2 without Unicode's classes (\p{...}) and case folding, which no pattern of engine/ uses: Debian makes these tables from a
// package of Unicode's data when it builds the library.
#include "re2/unicode_casefold.h"
#include "re2/unicode_groups.h"

namespace re2 {

const UGroup unicode_groups[] = {{}};
const int num_unicode_groups = 0;
const CaseFold unicode_casefold[] = {{}};
const int num_unicode_casefold = 0;
const CaseFold unicode_tolower[] = {{}};
const int num_unicode_tolower = 0;

}  // namespace re2
