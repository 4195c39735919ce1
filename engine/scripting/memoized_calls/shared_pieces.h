#pragma once
#include <functional>
#include <string>
#include <vector>

#include "data_io/values/cbor_values.h"
#include "numerics/validation/elsewhere.h"
#include "scripting/runtime/context.h"

namespace dynlab::inline scripting {

/// A service of programs whose scripts share their long calls with other machines.
class SharedPieces {
  public:
    using Some = std::function<std::string(std::size_t first, std::size_t count)>;

    virtual ~SharedPieces() = default;
    /// What `some` gives for the parts that `pieces` are made in, in their order, whoever made them. `what`: the call's
    /// name.
    virtual std::vector<std::string> all(const std::string& what, std::size_t pieces, const Some& some) = 0;
};

/// Who makes the pieces of a call; nobody else where the program has no such service.
template <class Piece>
Elsewhere<Piece> shared_out(lua_State* L, const std::string& what) {
    const auto& services = context_of(L).services;
    const auto found = services.find(typeid(SharedPieces).hash_code());
    if (found == services.end() || found->second == nullptr) return {};
    return
        [shared = static_cast<SharedPieces*>(found->second), what](std::size_t pieces, const SomePieces<Piece>& some) {
            const std::vector<std::string> parts = shared->all(
                what, pieces, [&](std::size_t first, std::size_t count) { return cbor_of(some(first, count)); });
            std::vector<Piece> all;
            for (const std::string& part : parts)
                for (Piece& piece : from_cbor<std::vector<Piece>>(part)) all.push_back(std::move(piece));
            if (all.size() != pieces) throw EnvironmentError("the parts of " + what + " do not make up the whole");
            return all;
        };
}

}  // namespace dynlab::inline scripting
