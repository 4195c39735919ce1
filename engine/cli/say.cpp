#include "cli/say.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "base/reader.h"
#include "data_io/values/said_messages.h"
#include "platform/terminal/terminal_text.h"
#include "scripting/conversions/option_words.h"

namespace dynlab::inline cli {
namespace {

/// On a terminal, in English.
std::string text_for_user(const Message& message) {
    return terminal_text(message_text(message, {nullptr, &option_name}));
}

void remember(std::vector<Message> SaidMessages::*kind, const Message& message) {
    static SaidMessages said;
    const char* const file = std::getenv(kFileOfSaidMessages);
    if (file == nullptr || *file == '\0') return;
    (said.*kind).push_back(message);
    write_said_messages(file, said);
}

void put_on_error_output(const char* begin, const Message& message) {
    std::fflush(stdout);
    std::cerr << begin << text_for_user(message) << std::endl;
}

}  // namespace

void say(const Message& result) {
    std::cout << text_for_user(result) << '\n';
    remember(&SaidMessages::results, result);
}

void complain(const Message& complaint) {
    put_on_error_output("dynlab: ", complaint);
    remember(&SaidMessages::complaints, complaint);
}

void note(const Message& remark) {
    put_on_error_output("dynlab: note: ", remark);
    remember(&SaidMessages::notes, remark);
}

}  // namespace dynlab::inline cli
