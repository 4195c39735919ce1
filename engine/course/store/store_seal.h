#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "course/intake/course_clock.h"
#include "course/store/database.h"
#include "platform/signature.h"

namespace dynlab::inline course {

/// Seals form a chain over all changes of a course. Each seal contains the number of rows and the SHA-256 of every
/// table that changed since the previous seal, and is signed together with the previous signature. A row that another
/// program removed or altered therefore does not match the newest seal, and a removed seal breaks the chain. (Only
/// later receipts reveal that an old store was restored together with its seals.)

/// Within a transaction: seals what the tables hold now; nothing where that is what the newest seal says.
void seal_store(Database& database, const SigningKey& key, Instant at);

/// Sentences: seals that are missing or not signed by this key, and tables that are not as the seals say.
std::vector<std::string> seal_errors(Database& database, std::string_view public_key);

}  // namespace dynlab::inline course
