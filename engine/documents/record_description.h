#pragma once
#include "data_io/values/described.h"
#include "data_io/values/message_values.h"
#include "documents/percent_script.h"
#include "documents/run_record.h"

namespace dynlab::inline documents {

/// Run results as data_io/values/described.h stores them. They do not contain a figure's curves: the figure's file has
/// the required data.

DYNLAB_DESCRIBE(RecordedValue, number, text)
DYNLAB_DESCRIBE(RecordedTable, header, rows)

template <Is<RecordedFigure> T, class V>
void describe(T& object, V& member) {
    auto& [figure, caption, file, order, plot, axes] = object;
    member("caption", caption), member.unless_empty("file", file), member.kept("order", order),
        member.kept("plot", plot), member.kept("axes", axes);
}

template <Is<CellOutput> T, class V>
void describe(T& object, V& member) {
    auto& [printed, figure] = object;
    member.unless_empty("printed", printed), member("figure", figure);
}

DYNLAB_DESCRIBE(RecordedSlider, value, initial, from, to, step, logarithmic, label, unit, cell, order)
DYNLAB_DESCRIBE(RecordedCall, what, file, line)

template <Is<RecordedError> T, class V>
void describe(T& object, V& member) {
    auto& [message, file, line, calls] = object;
    member("message", message), member("file", file), member("line", line), member.unless_empty("calls", calls);
}

template <Is<RunRecord> T, class V>
void describe(T& object, V& member) {
    auto& [script, seed, values, tables, figures, texts, answers, sliders, outputs, error, files_read, timings] =
        object;
    member("script", script), member("seed", seed), member("values", values), member("tables", tables);
    member("figures", figures), member("texts", texts), member("answers", answers);
    member.unless_empty("sliders", sliders), member("outputs", outputs);
    member("error", error), member("files_read", files_read), member.kept("timings", timings);
}

DYNLAB_DESCRIBE(ExpectedAnswer, name, kind)

/// An answer is stored as its JSON; CBOR stores the kind as well.
void write_whole_value(ValueWriter& writer, const RecordedAnswer& answer);
void read_whole_value(ValueReader& reader, RecordedAnswer& answer);

}  // namespace dynlab::inline documents

namespace dynlab::inline data_io {

template <>
struct StoredAs<RecordedText> {
    using Form = std::string;
    static Form form(const RecordedText& text) { return text.markdown; }
    static RecordedText value(Form&& markdown) { return {std::move(markdown)}; }
};

}  // namespace dynlab::inline data_io
