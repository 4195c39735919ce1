#pragma once
#include "scripting/conversions/userdata.h"
#include "scripting/runtime/recorder.h"

namespace dynlab::inline scripting {

template <>
struct Userdata<FigurePointer> {
    static constexpr ObjectType type{"figure"};
    static std::size_t outside_bytes(const FigurePointer& figure);
};

/// Pushes a new figure, validated, and registers it with the recorder, so that its cell shows it unless it is used
/// elsewhere.
int give_figure(const Call& call, Figure figure);

/// The figure of an argument that puts it somewhere: it no longer belongs to its cell alone.
ScriptFigure& used_figure(const Call& call, int index, ArgumentName what);

}  // namespace dynlab::inline scripting
