#pragma once

namespace dynlab::inline platform {

/// The Latin letter that a letter of another script, a small capital, a raised or an encircled letter looks like
/// (Unicode's table of confusable characters, UTS #39, and the characters' names), the ideograph of a radical, the
/// digit of a raised, lowered or encircled one; any other character as it is.
char32_t look_alike(char32_t character);

}  // namespace dynlab::inline platform
