#pragma once
// The outside of a checkpoint: what makes a file that was cut, or of which a single byte changed, known as such.
//
//     bytes 0-7     "PLIANTCP"
//     bytes 8-11    version of the format, 4; 1 is that of Pliant 0.1.0, 2 had no contact, 3 is still read:
//                   surfaces touched only where its scene said so
//     bytes 12-15   CRC-32 of everything behind, and of the version
//     bytes 16-23   number of bytes behind
//     bytes 24-     the content: CBOR (RFC 8949)
//
// Numbers are little-endian.
#include <string>
#include <string_view>

namespace pliant {

/// The bytes of a file with that content.
std::string seal(std::string_view content);

struct Unsealed {
  std::string_view content;
  bool has_old_contact = false;  ///< of format 3: without "surfaces" the scene's contact is with colliders alone
};

/// What messages call such a file, and what helps where it cannot be used.
struct FileWords {
  std::string_view kind = "checkpoint";
  std::string_view writer = "`pliant run`";
  std::string_view remedy = "run the scene from its start";
};

/// The content of a file; `name` is what messages call it.
/// @throws Error (input): not a checkpoint, of another version, cut or longer than it says, damaged.
Unsealed unseal(std::string_view bytes, std::string_view name, const FileWords& words = {});

}  // namespace pliant
