#pragma once
#include <string>
#include <vector>

#include "data_io/values/cbor_values.h"
#include "numerics/validation/elsewhere.h"
#include "scripting/runtime/context.h"

namespace dynlab::inline scripting {

/// Who makes the pieces of a call; nobody else where the program has no such service.
template <class Piece>
Elsewhere<Piece> shared_out(lua_State* L, const std::string& what) {
    SharedPieces* const shared = context_of(L).services.shared;
    if (shared == nullptr) return {};
    return [shared, what](std::size_t pieces, const SomePieces<Piece>& some) {
        const std::vector<std::string> parts = shared->all(
            what, pieces, [&](std::size_t first, std::size_t count) { return cbor_of(some(first, count)); });
        std::vector<Piece> all;
        for (const std::string& part : parts)
            for (Piece& piece : from_cbor<std::vector<Piece>>(part)) all.push_back(std::move(piece));
        if (all.size() != pieces) throw EnvironmentError("the parts of {} do not make up the whole", what);
        return all;
    };
}

}  // namespace dynlab::inline scripting
