#include <cstring>
#include <new>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "numerics/estimators/method_catalog.h"
#include "platform/error.h"
#include "scripting/conversions/arguments.h"
#include "scripting/conversions/option_words.h"
#include "scripting/runtime/sandbox.h"

namespace dynlab::inline scripting {
namespace {

Message with_first_argument(const Message& message, MessageArgument first) {
    std::vector<MessageArgument> arguments = message.arguments();
    arguments.front() = std::move(first);
    return Message::stored(message.id(), message.many(), std::move(arguments));
}

/// The number of the argument that the message begins with; nullptr when it begins otherwise.
const std::int64_t* argument_number(const Message& message) {
    if (message.arguments().empty()) return nullptr;
    const MessageArgument& first = message.arguments().front();
    if (message.id().starts_with("argument {}")) return std::get_if<std::int64_t>(&first);
    const auto* const inner = message.id().starts_with("{}") ? std::get_if<MessageList>(&first) : nullptr;
    return inner != nullptr && inner->items.size() == 1 ? argument_number(inner->items.front()) : nullptr;
}

/// The same with another number of its argument.
Message with_argument_number(const Message& message, std::int64_t number) {
    if (message.id().starts_with("argument {}")) return with_first_argument(message, number);
    const auto& inner = std::get<MessageList>(message.arguments().front());
    return with_first_argument(message, message_argument(with_argument_number(inner.items.front(), number)));
}

/// Behind a name and a colon a sentence goes on in small letters; names and symbols (Phi, A) keep theirs.
Message going_on(const Message& message) {
    for (const std::string_view word : {"All ", "At ", "Each ", "Irregular ", "The ", "With "}) {
        if (!message.id().starts_with(word)) continue;
        std::string id = message.id(), many = message.many();
        id.front() += 'a' - 'A';
        if (!many.empty()) many.front() += 'a' - 'A';
        return Message::stored(std::move(id), std::move(many), message.arguments());
    }
    return message;
}

/// The word that a message begins with, before a colon or a space; empty where that is no name.
std::string first_word(const Message& message) {
    std::string_view begin = message.id();
    if (begin.starts_with("{}")) {
        const auto* const text = std::get_if<std::string>(&message.arguments().front());
        if (text == nullptr) return {};
        begin = *text;
    }
    return std::string(begin.substr(0, begin.find_first_of(": ")));
}

/// A failure with the called function's name before it, once. Where one method does the work of another, as lssvf
/// that of lsgpmf, the name is that of the one that was called.
Message with_name(const std::string& name, const Message& message) {
    const std::string first = first_word(message);
    if (first == name) return message;
    if (message.id().starts_with("{}: ") && find_method(first) && find_method(name))
        return with_first_argument(message, name);
    return Message("{}: {}", name, going_on(message));
}

/// Messages count the arguments of a method as the script writes them, without the object.
Message of_called_method(lua_State* L, const char* name, Message message) {
    lua_Debug call;
    const std::int64_t* const number = argument_number(message);
    if (number == nullptr || !lua_getstack(L, 0, &call) || !lua_getinfo(L, "n", &call) || call.namewhat == nullptr)
        return message;
    const std::string_view how = call.namewhat;
    if (how == "method" && *number > 1) return with_argument_number(message, *number - 1);
    if (how == "field" && *number == 1 && name != nullptr && std::strchr(name, '.') == nullptr) {
        push_library(L);
        lua_pushstring(L, name);
        const bool is_function = lua_rawget(L, -2) != LUA_TNIL;
        lua_pop(L, 2);
        if (!is_function) return Message("{}; a method is called with a colon: object:{}(...)", message, name);
    }
    return message;
}

}  // namespace

int run_guarded(lua_State* L, Binding body) {
    poll_stop(L);  // a loop around long calls counts few instructions
    Message message;
    try {
        context_of(L).recorder.note_time();
        Call call(L);
        return body(call);
    } catch (const Interrupted&) {
        message = Message();
    } catch (const std::bad_alloc&) {
        message = Message("not enough memory for this call; use less data");
    } catch (const std::exception& error) {
        message = with_script_options(message_of(error), {nullptr, context_of(L).option_name});
    }
    if (message.empty()) {
        poll_stop(L);  // of a limit, where it was one
        raise_stop(L, StopReason::kInterrupted);
    }
    const char* name = static_cast<const char*>(lua_touserdata(L, lua_upvalueindex(1)));
    message = of_called_method(L, name, std::move(message));
    raise_error(L, name == nullptr || name[0] == '_' ? message : with_name(name, message));
}

}  // namespace dynlab::inline scripting
