#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dynlab::inline platform {

/// Random numbers that no one can predict or compute afterwards: libsodium's generator, which the operating system
/// seeds. Every secret comes from here (pseudonyms, review pairs, keys, tokens). There is no seed to give, store or
/// print; numerics' RandomStream is for simulated data only.

/// Prepares libsodium, once a process. Throws std::runtime_error where the library cannot be used.
void prepare_sodium();

std::string secure_bytes(std::size_t count);
std::string secure_hex(std::size_t count);  ///< so many random bytes as lower-case hexadecimal digits, two a byte
/// A number from 0 to below - 1, each with the same probability. Throws std::invalid_argument for 0 or 2^32 and more.
std::size_t secure_below(std::size_t below);

/// A source of such numbers. Programs pass secure_below; tests pass fixed numbers.
using UniformDraw = std::function<std::size_t(std::size_t below)>;

/// Puts the items into a random order, each order with the same probability (Fisher and Yates).
template <class Item>
void shuffle_items(std::vector<Item>& items, const UniformDraw& draw) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[draw(i)]);
}

}  // namespace dynlab::inline platform
