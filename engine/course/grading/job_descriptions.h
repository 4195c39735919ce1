#pragma once
#include "course/findings/finding_description.h"
#include "course/grading/boxed_document.h"
#include "course/grading/check_run.h"
#include "course/grading/graded_run.h"
#include "course/grading/unpack.h"
#include "course/review/version_reading.h"
#include "documents/record_description.h"

namespace dynlab::inline course {

/// Jobs for boxes and what comes of them, as data_io/values/described.h stores them.

template <Is<GradedRun> T, class V>
void describe(T& object, V& member) {
    auto& [answers, figures, values, printed, error, seconds] = object;
    member("answers", answers), member("figures", figures), member("values", values);
    member("printed", printed), member("error", error), member("seconds", seconds);
}

template <Is<RunJob> T, class V>
void describe(T& object, V& member) {
    auto& [script, seed, answers, time_ms, memory_bytes] = object;
    member("script", script), member("seed", seed), member("answers", answers);
    member("time_ms", time_ms), member("memory_bytes", memory_bytes);
}

template <Is<CheckFile> T, class V>
void describe(T& object, V& member) {
    auto& [name, source, visible] = object;
    member("name", name), member("source", source), member("visible", visible);
}

template <Is<CheckedSubmission> T, class V>
void describe(T& object, V& member) {
    auto& [runs, findings] = object;
    member("runs", runs), member("findings", findings);
}

template <Is<CheckDescription> T, class V>
void describe(T& object, V& member) {
    auto& [id, about, hint, points, rerun, document, visible] = object;
    member("id", id), member("about", about), member("hint", hint), member("points", points);
    member("rerun", rerun), member("document", document), member("visible", visible);
}

template <Is<TriedCheck> T, class V>
void describe(T& object, V& member) {
    auto& [check, share, message, for_instructor] = object;
    member("check", check), member("share", share);
    member("message", message), member("for_instructor", for_instructor);
}

template <Is<CheckResults> T, class V>
void describe(T& object, V& member) {
    auto& [checks, error] = object;
    member("checks", checks), member("error", error);
}

template <Is<ChecksJob> T, class V>
void describe(T& object, V& member) {
    auto& [files, hidden_folder, specimens, time_ms, only, submission] = object;
    member("files", files), member("hidden_folder", hidden_folder), member("specimens", specimens);
    member("time_ms", time_ms), member("only", only), member("submission", submission);
}

template <Is<Unpacked> T, class V>
void describe(T& object, V& member) {
    auto& [left_out, error] = object;
    member("left_out", left_out), member("error", error);
}

template <Is<UnpackJob> T, class V>
void describe(T& object, V& member) {
    auto& [archive, to, bytes, files, keep_times] = object;
    member("archive", archive), member("to", to), member("bytes", bytes);
    member("files", files), member("keep_times", keep_times);
}

template <Is<DocumentJob> T, class V>
void describe(T& object, V& member) {
    auto& [template_name, record, latex_format, to] = object;
    member("template", template_name), member("record", record);
    member("latex_format", latex_format), member("to", to);
}

template <Is<VersionJob> T, class V>
void describe(T& object, V& member) {
    auto& [folder, to, pdf] = object;
    member("folder", folder), member("to", to), member("pdf", pdf);
}

template <Is<BoxedOutcome> T, class V>
void describe(T& object, V& member) {
    auto& [error] = object;
    member("error", error);
}

}  // namespace dynlab::inline course
