#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <list>

#include "base/reader.h"
#include "scripting/interpreter/catalogue.h"
#include "scripting/runtime/help.h"

namespace dynlab::inline scripting {
namespace {

std::string text_of(const MessageId<>& description) {
    return message_text(Message(description));
}

/// "number from 0 to 1"
std::string with_bounds(const char* kind, const OptionFacts& facts) {
    const bool least = std::isfinite(facts.least), most = std::isfinite(facts.most);
    std::string text = kind;
    if (least && most) return text + fmt::format(" from {} to {}", facts.least, facts.most);
    if (least) text += fmt::format(", at least {}", facts.least);
    if (most) text += fmt::format(", at most {}", facts.most);
    return text;
}

/// What the option takes, as far as one phrase says it.
std::string kind_of(const OptionEntry& option) {
    switch (option.kind) {
        case ValueKind::kNumber:
            return with_bounds("number", option.facts);
        case ValueKind::kCount:
            return with_bounds("whole number", option.facts);
        case ValueKind::kFlag:
            return "true or false";
        case ValueKind::kText:
            return "text";
        case ValueKind::kVector:
            return "vector";
        case ValueKind::kTable:
            return "table";
        case ValueKind::kChoice: {
            std::vector<std::string> texts;
            for (const char* choice : option.facts.choices) texts.push_back(fmt::format("`\"{}\"`", choice));
            return fmt::format("{}", fmt::join(texts, ", "));
        }
        default:
            return "";
    }
}

/// "- `Tol` (number, default 1e-6): relative change of the parameters at which the search stops."
std::string item_of(const OptionEntry& option) {
    std::vector<std::string> facts;
    if (const std::string kind = kind_of(option); !kind.empty()) facts.push_back(kind);
    if (*option.facts.unit != '\0') facts.push_back(option.facts.unit);
    if (const std::string initial = initial_text(option); !initial.empty())
        facts.push_back(fmt::format("default `{}`", initial));
    return fmt::format("- `{}`{}: {}.\n", option.name,
                       facts.empty() ? "" : fmt::format(" ({})", fmt::join(facts, ", ")), text_of(option.description));
}

std::string items_of(const FunctionEntry& function) {
    std::string items;
    for (const ArgumentEntry& argument : function.arguments)
        items += fmt::format("- `{}`: {}.\n", argument.name, text_of(argument.description));
    for (const OptionTable& table : function.options)
        for (const OptionEntry& option : table) items += item_of(option);
    return items;
}

/// The page with the items at the beginning of its part "Arguments", which it is given where it has none.
std::string with_items(std::string page, const std::string& items) {
    if (items.empty()) return page;
    static constexpr std::string_view kHeading = "## Arguments\n\n";
    if (const std::size_t at = page.find(kHeading); at != page.npos) {
        const std::size_t begin = at + kHeading.size();
        const bool list = page.compare(begin, 2, "- ") == 0;
        return page.insert(begin, items + (list ? "" : "\n"));
    }
    const std::size_t next = page.find("\n## ");
    if (next == page.npos) return page + "\n" + std::string(kHeading) + items;
    return page.insert(next + 1, std::string(kHeading) + items + "\n");
}

}  // namespace

std::span<const HelpPage> help_pages() {
    static std::list<std::string> texts;  // which the pages view
    static const std::vector<HelpPage> pages = [] {
        std::vector<HelpPage> all;
        for (const HelpPage& page : stored_pages()) {
            const FunctionEntry* const function = find_function(std::string(page.name));
            if (function == nullptr) {
                all.push_back(page);
                continue;
            }
            texts.push_back(with_items(std::string(page.text), items_of(*function)));
            all.push_back({page.name, texts.back()});
        }
        return all;
    }();
    return pages;
}

}  // namespace dynlab::inline scripting
