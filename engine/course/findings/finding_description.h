#pragma once
#include "course/findings/document_findings.h"
#include "data_io/values/described.h"

namespace dynlab::inline course {

/// Outcomes of checks as data_io/values/described.h stores them.

constexpr std::array<const char*, 2> names_of(Severity) {
    return {"rule", "hint"};
}

template <Is<Finding> T, class V>
void describe(T& object, V& member) {
    auto& [id, severity, page, place, what, remedy] = object;
    member("id", id), member("severity", severity), member.null_if_empty("page", page);
    member.null_if_empty("place", place), member("what", what), member("remedy", remedy);
}

/// Without the lesson, which programs know.
template <Is<CheckResult> T, class V>
void describe(T& object, V& member) {
    auto& [subject, template_name, language, lesson, pages, checked, findings] = object;
    member("subject", subject), member.null_if_empty("template", template_name);
    member.null_if_empty("language", language), member.null_if_empty("pages", pages);
    member("checked", checked), member("findings", findings);
}

}  // namespace dynlab::inline course
