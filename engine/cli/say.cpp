#include "cli/say.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "base/languages.h"
#include "data_io/values/command_messages.h"
#include "platform/terminal/terminal_text.h"
#include "scripting/interpreter/catalog.h"

namespace dynlab::inline cli {
namespace {

/// As POSIX finds it: the first of the variables that is set, "fr_FR.UTF-8" for one.
const Catalog* catalog_of_environment() {
    for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"})
        if (const char* const locale = std::getenv(name); locale != nullptr && *locale != '\0') {
            const std::string_view text = locale;
            return catalog_of(text.substr(0, text.find_first_of("_.@")));
        }
    return nullptr;
}

Reader& changeable_user() {
    static Reader reader{catalog_of_environment(), &option_name};
    return reader;
}

std::string text_for_user(const Message& message) {
    return terminal_text(message_text(message, user()));
}

void save_entry(std::vector<Message> CommandMessages::*kind, const Message& message) {
    static CommandMessages said;
    const char* const file = std::getenv(kFileOfCommandMessages);
    if (file == nullptr || *file == '\0') return;
    (said.*kind).push_back(message);
    write_command_messages(file, said);
}

void put_on_error_output(const Message& message) {
    std::fflush(stdout);
    std::cerr << "dynlab: " << text_for_user(message) << std::endl;
}

}  // namespace

void speak(const std::string& language) {
    if (const Catalog* const catalog = catalog_of(language)) changeable_user().catalog = catalog;
}

void speak_as_environment() {
    changeable_user().catalog = catalog_of_environment();
}

const Reader& user() {
    return changeable_user();
}

void say(const Message& result) {
    std::cout << text_for_user(result) << '\n';
    save_entry(&CommandMessages::results, result);
}

void complain(const Message& complaint) {
    put_on_error_output(complaint);
    save_entry(&CommandMessages::complaints, complaint);
}

void note(const Message& remark) {
    put_on_error_output(Message("note: {}", remark));
    save_entry(&CommandMessages::notes, remark);
}

}  // namespace dynlab::inline cli
