#include "base/error.h"

namespace dynlab::inline base {

Message message_of(const std::exception& error) {
    const auto* carrier = dynamic_cast<const WithMessage*>(&error);
    return carrier == nullptr ? Message::verbatim(error.what()) : carrier->message();
}

}  // namespace dynlab::inline base
