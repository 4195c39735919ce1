#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dynlab::inline base {

class Message;

/// A number with the digits that a reader sees. Make it with `significant` or `decimals`.
struct Number {
    enum class Digits : std::uint8_t { kSignificant, kDecimals };
    double value = 0;
    int digits = 5;
    Digits meaning = Digits::kSignificant;
    bool operator==(const Number&) const = default;
};

/// At most that many significant digits (1 to 17), without trailing zeros: "0.05".
inline Number significant(double value, int digits) {
    return {value, digits, Number::Digits::kSignificant};
}
/// Exactly that many digits (0 to 17) behind the decimal point: "93.20".
inline Number decimals(double value, int digits) {
    return {value, digits, Number::Digits::kDecimals};
}

/// An option of a numerical method by the name of its member in the options struct, `max_iterations`. Each reader has
/// another name for it: scripts write MaxIter.
struct OptionName {
    std::string member;
    bool operator==(const OptionName&) const = default;
};

/// Messages that are listed within another, and the words between them.
enum class Join : std::uint8_t { kComma, kAnd, kOr, kSemicolon, kSentences, kLines };
struct MessageList {
    std::vector<Message> items;
    Join join = Join::kComma;
    bool operator==(const MessageList&) const;
};

/// The possible values for a {}: a count, a number, text that no language changes (a file, a name of the script, a
/// unit), an option, or other messages.
using MessageArgument = std::variant<std::int64_t, Number, std::string, OptionName, MessageList>;

/// Defined where Message is complete.
MessageArgument message_argument(std::integral auto value) requires(!std::same_as<decltype(value), bool> &&
                                                                    !std::same_as<decltype(value), char>);
MessageArgument message_argument(double value);
MessageArgument message_argument(Number number);
MessageArgument message_argument(std::string text);
MessageArgument message_argument(std::string_view text);
MessageArgument message_argument(const char* text);
MessageArgument message_argument(OptionName option);
MessageArgument message_argument(const Message& message);
MessageArgument message_argument(MessageList list);

/// An English sentence, or a part of one, with {} for each argument. The compiler refuses a literal whose {} are not as
/// many as the arguments.
template <class... T>
class MessageId {
  public:
    consteval MessageId(const char* english) : english_(english) {  // NOLINT: literals become ids by themselves
        std::size_t slots = 0;
        for (const char* at = english; *at != '\0'; ++at)
            if (at[0] == '{' && at[1] == '}') ++slots;
        if (slots != sizeof...(T)) throw std::logic_error("a message needs one argument for each {}");
    }
    const char* english() const { return english_; }

  private:
    const char* english_;
};

/// What the program has to say: the English format, which is its id in the catalogs (engine/po), and typed arguments.
/// Text is made of it once, for its reader (base/reader.h). Messages are values: they are stored, compared and sent to
/// other processes.
class Message {
  public:
    /// Empty.
    Message() = default;

    template <class... T>
    Message(MessageId<std::type_identity_t<T>...> id, const T&... arguments)  // NOLINT: literals are messages
        : id_(id.english()), arguments_{message_argument(arguments)...} {}

    /// A text that depends on the number: `one` if the language has a singular for it, else `many`. The first {} is the
    /// number.
    template <class... T>
    static Message plural(std::int64_t count, MessageId<std::int64_t, std::type_identity_t<T>...> one,
                          MessageId<std::int64_t, std::type_identity_t<T>...> many, const T&... arguments) {
        Message message;
        message.id_ = one.english();
        message.many_ = many.english();
        message.arguments_ = {message_argument(count), message_argument(arguments)...};
        return message;
    }

    /// Text that has no translation: what another program printed, or what an author wrote. Empty where the text is.
    static Message verbatim(std::string text);

    /// From its parts, as another process or an earlier run stored them. Throws std::invalid_argument when the
    /// arguments are not as many as the {}, or a number has more than 17 digits.
    static Message stored(std::string id, std::string many, std::vector<MessageArgument> arguments);

    bool empty() const { return id_.empty(); }
    const std::string& id() const { return id_; }
    const std::string& many() const { return many_; }  ///< the plural's id; empty when there is none
    const std::vector<MessageArgument>& arguments() const { return arguments_; }

    bool operator==(const Message&) const = default;

  private:
    std::string id_, many_;
    std::vector<MessageArgument> arguments_;
};

MessageArgument message_argument(std::integral auto value) requires(!std::same_as<decltype(value), bool> &&
                                                                    !std::same_as<decltype(value), char>) {
    return static_cast<std::int64_t>(value);
}

/// "3 samples", as an argument or alone: `plural(n, "{} sample", "{} samples")`.
template <class... T>
Message plural(std::int64_t count, MessageId<std::int64_t, std::type_identity_t<T>...> one,
               MessageId<std::int64_t, std::type_identity_t<T>...> many, const T&... arguments) {
    return Message::plural(count, one, many, arguments...);
}

/// The texts as a list of messages without translation: names of channels, of parameters, of files.
MessageList listed(const std::vector<std::string>& texts, Join join = Join::kComma);

/// Several sentences as one message.
Message sentences(std::vector<Message> messages);

}  // namespace dynlab::inline base
