#pragma once
#include <string>
#include <type_traits>
#include <vector>

#include "course/intake/text_with_message.h"
#include "course/issues/document_issues.h"
#include "data_io/values/described.h"

namespace dynlab::inline course {

/// Outcomes of checks as data_io/values/described.h stores them.

constexpr std::array<const char*, 2> names_of(Severity) {
    return {"rule", "hint"};
}

template <Is<Issue> T, class V>
void describe(T& object, V& member) {
    auto& [id, severity, page, place, what, remedy] = object;
    member("id", id), member("severity", severity), member.null_if_empty("page", page);
    member.null_if_empty("place", place);
    store_text_with_message(member, "what", "what_message", what);
    store_text_with_message(member, "remedy", "remedy_message", remedy);
}

/// What was looked at, as text and as messages.
template <class V, class M>
void store_checked(V& member, M& checked) {
    std::vector<std::string> texts;
    if constexpr (std::is_const_v<M>) {
        for (const Message& part : checked) texts.push_back(message_text(part));
        member("checked", texts), member.unless_empty("checked_messages", checked);
    } else {
        member("checked", texts), member.unless_empty("checked_messages", checked);
        checked.resize(texts.size());
        for (std::size_t i = 0; i < texts.size(); ++i)
            if (message_text(checked[i]) != texts[i]) checked[i] = Message::verbatim(texts[i]);
    }
}

/// Without the lesson, which programs know.
template <Is<CheckResult> T, class V>
void describe(T& object, V& member) {
    auto& [subject, template_name, language, lesson, pages, checked, findings] = object;
    member("subject", subject), member.null_if_empty("template", template_name);
    member.null_if_empty("language", language), member.null_if_empty("pages", pages);
    store_checked(member, checked);
    member("findings", findings);
}

}  // namespace dynlab::inline course
