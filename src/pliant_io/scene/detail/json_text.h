#pragma once
// Texts of JSON, and CBOR of checkpoints, as values of nlohmann's library.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace pliant {

/// A value with its keys in the order of the text.
using SceneJson = nlohmann::ordered_json;

// What bounds the memory of a text, whatever it is filled with. A value takes at most some 70 bytes, so that the worst
// text needs less than 1 GB; a body of 250,000 vertices, with all its triangles, may still stand in a scene itself.

/// Lists and objects inside each other, at most.
inline constexpr std::size_t max_json_depth = 64;
/// Values in a text, at most.
inline constexpr std::size_t max_json_values = 10'000'000;
/// Bytes of the texts of a scene, together.
inline constexpr std::size_t max_json_bytes = 32U << 20U;
/// Bytes of CBOR, most of which are strings of bytes that take what they have.
inline constexpr std::size_t max_cbor_bytes = 1U << 30U;

/// Reads a text. `file` is what messages call it.
/// @throws Error (input): `file:line:column: what` for a slip of syntax; `file: path: what` for a key that stands twice
///   in an object, a number beyond the range of doubles, or what is past the limits above.
SceneJson parse_json(std::string_view text, std::string_view file);

/// The same for CBOR (RFC 8949), which may hold bytes besides; strings come in one piece each.
SceneJson parse_cbor(std::string_view bytes, std::string_view file);

/// Throws Error(input) `file: ...` for a text of so many bytes, which is past the limit.
void check_json_size(std::uintmax_t bytes, std::string_view file);

/// Whether the text is sound JSON.
bool is_json(std::string_view text);

/// "path.key", or the key alone where the path is empty; fit for a message.
std::string join_key(std::string_view path, std::string_view key);

/// Throws Error(input) `file: path: what`.
[[noreturn]] void fail_at(std::string_view file, std::string_view path, std::string_view what);

}  // namespace pliant
