#pragma once
// The numbers of a .vtu file, however its arrays are kept: as text, in base64, or behind the XML; compressed or not.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pliant_io/files/detail/byte_source.h"
#include "pliant_io/mesh/detail/vtk_numbers.h"

namespace pliant {

/// A part of a file.
struct ByteRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

/// Bytes one after the other, as they are or in base64.
class VtuStream {
 public:
  enum class Form { raw, base64 };
  VtuStream(const ByteSource& source, ByteRange range, Form form) : source_(source), range_(range), form_(form) {}

  /// Takes the next bytes. Whether there were so many; base64 ends with its first character that is none, and padding
  /// may stand between groups, since some programs encode the head of an array by itself.
  bool read(char* into, std::size_t count);

  /// The most bytes that are still to come.
  std::uint64_t remaining() const;

 private:
  bool read_raw(char* into, std::size_t count);
  bool next_group();
  int next_digit();

  const ByteSource& source_;
  ByteRange range_;
  Form form_;
  std::string block_{};       ///< of the text
  std::size_t position_ = 0;  ///< in the block
  std::string group_{};       ///< bytes of base64 that were decoded and not taken
};

/// What the head of the file says of its arrays.
struct VtuCoding {
  VtkByteOrder order = VtkByteOrder::little;
  VtkType head = VtkType::uint32;  ///< of the counts in front of the numbers
  enum class Compression { none, zlib } compression = Compression::none;
};

/// Arrays become vectors of numbers. What one says of its size is held against the bytes that there are before anything
/// is allocated. Members throw Error (input) by `fail`, which knows the place.
class VtuDecoder {
 public:
  /// All arrays of a file together hold no more bytes than the file or, compressed, 64 for each of its bytes and 16
  /// MiB.
  VtuDecoder(const VtuCoding& coding, std::uint64_t file_size)
      : coding_(coding),
        budget_(coding.compression == VtuCoding::Compression::none ? file_size : 64 * file_size + (16U << 20U)) {}

  struct Failure {
    std::string message;
  };

  /// The bytes of an array. @throws Failure
  std::string bytes(VtuStream& stream);

  VtkByteOrder order() const { return coding_.order; }

 private:
  std::uint64_t take_count(VtuStream& stream) const;
  void spend(std::uint64_t bytes);
  std::string compressed_bytes(VtuStream& stream);

  VtuCoding coding_;
  std::uint64_t budget_;
};

}  // namespace pliant
