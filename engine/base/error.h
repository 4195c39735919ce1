#pragma once
#include <exception>
#include <string>
#include <utility>

#include "base/message.h"
#include "base/reader.h"

namespace dynlab::inline base {

/// What the errors of all layers have: a message, of which what() is the English text.
class WithMessage {
  public:
    const Message& message() const { return message_; }

  protected:
    explicit WithMessage(Message message) : message_(std::move(message)) {}
    ~WithMessage() = default;
    WithMessage(const WithMessage&) = default;
    WithMessage& operator=(const WithMessage&) = default;

  private:
    Message message_;
};

/// An error on top of one of the standard library's: `class InvalidArgument : public ErrorOf<std::invalid_argument>`.
template <class StandardError>
class ErrorOf : public StandardError, public WithMessage {
  public:
    explicit ErrorOf(Message message) : StandardError(message_text(message)), WithMessage(std::move(message)) {}

    template <class... T>
    explicit ErrorOf(MessageId<std::type_identity_t<T>...> id, const T&... arguments)
        : ErrorOf(Message(id, arguments...)) {}

    /// Text that has no translation. Not for literals: those are ids.
    template <std::same_as<std::string> Text>
    explicit ErrorOf(const Text& verbatim) : ErrorOf(Message::verbatim(verbatim)) {}
};

/// The message of an error; what another library says is verbatim.
Message message_of(const std::exception& error);

}  // namespace dynlab::inline base
