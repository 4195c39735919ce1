#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "course/intake/course_clock.h"
#include "course/store/database.h"
#include "platform/signature.h"

namespace dynlab::inline course {

/// Seals are a chain over all changes of a course: each tells the number of rows and the SHA-256 of every table that
/// changed since the one before, and is signed together with that one's signature. So a row that was taken away or
/// altered behind dynlab's back does not fit the newest seal, and a seal that was taken away breaks the chain. (Who
/// puts back an old store with its seals is betrayed by later receipts only.)

/// Within a transaction: seals what the tables hold now; nothing where that is what the newest seal says.
void seal_store(Database& database, const SigningKey& key, Instant at);

/// Sentences: seals that are missing or not signed by this key, and tables that are not as the seals say.
std::vector<std::string> seal_errors(Database& database, std::string_view public_key);

}  // namespace dynlab::inline course
