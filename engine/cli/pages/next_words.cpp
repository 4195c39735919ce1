#include "cli/pages/next_words.h"

#include <cctype>
#include <set>

namespace dynlab::inline cli {
namespace {

bool is_shown(const CLI::Option* option) {
    return !option->get_group().empty();
}

/// Where the words before the last one lead to.
struct Place {
    const CLI::App* command;
    const CLI::Option* waiting = nullptr;  ///< the option whose value comes next
    int positionals = 0;                   ///< given so far
};

const CLI::App* subcommand(const CLI::App& command, const std::string& name) {
    const auto found = command.get_subcommands([&](const CLI::App* one) { return one->get_name() == name; });
    return found.empty() ? nullptr : found.front();
}

/// The option of that name of a command or of those that it belongs to.
const CLI::Option* option_of(const CLI::App* command, const std::string& name) {
    for (; command != nullptr; command = command->get_parent())
        for (const CLI::Option* option : command->get_options())
            if (option->nonpositional() && option->check_name(name)) return option;
    return nullptr;
}

Place place_behind(const CLI::App& program, const std::vector<std::string>& words) {
    Place place{&program};
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        const std::string& word = words[i];
        if (place.waiting != nullptr) {
            place.waiting = nullptr;
        } else if (word.starts_with("-")) {
            const CLI::Option* option = option_of(place.command, word);
            if (option != nullptr && option->get_expected_max() > 0) place.waiting = option;
        } else if (const CLI::App* next = subcommand(*place.command, word)) {
            place = {next};
        } else {
            ++place.positionals;
        }
    }
    return place;
}

/// The positional that comes next; the last one may take several words.
const CLI::Option* next_positional(const Place& place) {
    int left = place.positionals;
    for (const CLI::Option* option :
         place.command->get_options([](const CLI::Option* one) { return one->get_positional() && is_shown(one); })) {
        left -= option->get_expected_max();
        if (left < 0) return option;
    }
    return nullptr;
}

/// "best|newest" -> best, newest; "{en,fr}" -> en, fr.
std::vector<std::string> alternatives(const std::string& text, char separator) {
    std::vector<std::string> words(1);
    for (const char letter : text) {
        if (letter == separator)
            words.emplace_back();
        else
            words.back() += letter;
    }
    return words;
}

/// What an option's value may be, by how the help calls it: "LESSON|FOLDER|FILE.lua", "N|auto", "TEXT:{en,fr}".
NextWords values_of(const CLI::Option& option, const NamesOf& names) {
    static const std::set<std::string> kFiles = {"CSV",  "DATA",   "DIR", "FILE",   "FOLDER",
                                                 "JSON", "LESSON", "OUT", "RECEIPT"};
    NextWords values;
    const std::string type = option.get_type_name();
    if (const auto open = type.find('{'); open != std::string::npos) {
        for (const std::string& word : alternatives(type.substr(open + 1, type.find('}') - open - 1), ','))
            values.words.push_back({word, ""});
        return values;
    }
    for (const std::string& word : alternatives(option.get_positional() ? option.get_name(true) : type, '|')) {
        const std::string kind = word.substr(0, word.find('.'));
        if (std::islower(static_cast<unsigned char>(word.front())) != 0) values.words.push_back({word, ""});
        for (const Suggestion& name : names(kind)) values.words.push_back(name);
        values.files = values.files || kFiles.contains(kind);
    }
    return values;
}

void add_options(const Place& place, std::vector<Suggestion>& words) {
    for (const CLI::App* command = place.command; command != nullptr; command = command->get_parent()) {
        if (command->get_parent() == nullptr && command != place.command) break;
        for (const CLI::Option* option : command->get_options()) {
            if (!is_shown(option)) continue;
            for (const std::string& name : option->get_lnames())
                words.push_back({"--" + name, option->get_description()});
            for (const std::string& name : option->get_snames())
                words.push_back({"-" + name, option->get_description()});
        }
    }
}

}  // namespace

NextWords next_words(const CLI::App& program, const std::vector<std::string>& words, const NamesOf& names) {
    const Place place = place_behind(program, words);
    const std::string begun = words.empty() ? "" : words.back();
    NextWords all;
    if (place.waiting != nullptr) {
        all = values_of(*place.waiting, names);
    } else if (begun.starts_with("-")) {
        add_options(place, all.words);
    } else {
        if (const CLI::Option* positional = next_positional(place)) all = values_of(*positional, names);
        if (place.positionals == 0)
            for (const CLI::App* one : place.command->get_subcommands({}))
                if (!one->get_group().empty()) all.words.push_back({one->get_name(), one->get_description()});
    }
    std::erase_if(all.words, [&](const Suggestion& one) { return !one.word.starts_with(begun); });
    return all;
}

}  // namespace dynlab::inline cli
