#include "figures/readable_figure.h"

#include <cctype>
#include <utility>
#include <variant>
#include <vector>

#include "base/catalog.h"
#include "figures/figure.h"

namespace dynlab::inline figures {
namespace {

bool is_of_author(const Message& message) {
    return message.id() == "{}" && std::holds_alternative<std::string>(message.arguments().front());
}

/// Also applies to an author's text inside a message: the name of a model before its fit.
Message with_commas_of_authors(const Message& message, const Reader& reader) {
    if (is_of_author(message)) return Message::verbatim(with_decimal_commas(message_text(message, reader)));
    std::vector<MessageArgument> arguments = message.arguments();
    for (MessageArgument& argument : arguments)
        if (auto* list = std::get_if<MessageList>(&argument))
            for (Message& item : list->items) item = with_commas_of_authors(item, reader);
    return Message::stored(message.id(), message.many(), std::move(arguments));
}

}  // namespace

std::string with_decimal_commas(const std::string& text) {
    const auto digit = [&text](std::size_t i) {
        return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i]));
    };
    std::string result = text;
    for (std::size_t i = 0; i < text.size();) {
        if (!digit(i)) {
            ++i;
            continue;
        }
        const std::size_t first = i;
        std::size_t points = 0, place = 0;
        for (; digit(i) || (text[i] == '.' && digit(i + 1)); ++i)
            if (text[i] == '.') {
                ++points;
                place = i;
            }
        if (points == 1 && (first == 0 || text[first - 1] != '.')) result[place] = ',';
    }
    return result;
}

bool has_decimal_comma(const Reader& reader) {
    return reader.catalog != nullptr && reader.catalog->decimal_sign() == ",";
}

Figure readable(const Figure& figure, const Reader& reader) {
    const bool commas = has_decimal_comma(reader);
    const auto change = [&](Message& label) {
        label = Message::verbatim(message_text(commas ? with_commas_of_authors(label, reader) : label, reader));
    };
    Figure result = figure;
    change(result.title);
    for (Panel& panel : result.panels) {
        for (Message* label : {&panel.title, &panel.x_label, &panel.y_label}) change(*label);
        for (Curve& curve : panel.curves) change(curve.label);
        for (ReferenceLine& reference : panel.references) change(reference.label);
        for (Annotation& annotation : panel.annotations) change(annotation.text);
        for (Arrow& arrow : panel.arrows) change(arrow.text);
    }
    return result;
}

}  // namespace dynlab::inline figures
