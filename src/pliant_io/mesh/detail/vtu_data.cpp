#include "pliant_io/mesh/detail/vtu_data.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant_io/files/compression.h"

namespace pliant {

namespace {

constexpr std::size_t vtu_block_size = 1 << 16;

/// What zlib makes of a byte at most, rounded up.
constexpr std::uint64_t most_inflation = 1040;

constexpr int no_digit = -1;
constexpr int padding = 64;

/// The digits of RFC 4648, Sec. 4.
int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  if (c == '/') return 63;
  return c == '=' ? padding : no_digit;
}

[[noreturn]] void fail_short(std::uint64_t count, std::uint64_t room) {
  throw VtuDecoder::Failure{
      fmt::format("{} bytes announced, where the file has room for at most {}; it may be cut short", count, room)};
}

}  // namespace

// ---- VtuStream

std::uint64_t VtuStream::remaining() const {
  const std::uint64_t left = range_.end - std::min(range_.begin, range_.end);
  if (form_ == Form::raw) return left;
  return group_.size() + (block_.size() - position_ + left) / 4 * 3 + 3;
}

bool VtuStream::read(char* into, std::size_t count) {
  if (form_ == Form::raw) return read_raw(into, count);
  while (count > 0) {
    if (group_.empty() && !next_group()) return false;
    const std::size_t taken = std::min(count, group_.size());
    std::copy_n(group_.data(), taken, into);
    group_.erase(0, taken);
    into += taken;
    count -= taken;
  }
  return true;
}

bool VtuStream::read_raw(char* into, std::size_t count) {
  if (count > remaining() || source_.read(range_.begin, into, count) < count) return false;
  range_.begin += count;
  return true;
}

int VtuStream::next_digit() {
  for (;;) {
    if (position_ == block_.size()) {
      const std::uint64_t left = range_.end - std::min(range_.begin, range_.end);
      block_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(left, vtu_block_size)));
      block_.resize(source_.read(range_.begin, block_.data(), block_.size()));
      range_.begin += block_.size();
      position_ = 0;
      if (block_.empty()) return no_digit;
    }
    const char c = block_[position_++];
    if (c != ' ' && c != '\t' && c != '\n' && c != '\r') return base64_digit(c);
  }
}

/// Four digits are three bytes; with padding fewer, but one at least.
bool VtuStream::next_group() {
  std::uint32_t bits = 0;
  std::size_t count = 3;
  for (std::size_t i = 0; i < 4; ++i) {
    const int digit = next_digit();
    if (digit == no_digit || (digit == padding && i < 2) || (digit != padding && count < 3)) return false;
    if (digit == padding) --count;
    bits = bits << 6U | (digit == padding ? 0U : static_cast<std::uint32_t>(digit));
  }
  for (std::size_t i = 0; i < count; ++i) group_ += static_cast<char>(bits >> (16 - 8 * i) & 0xFFU);
  return true;
}

// ---- VtuDecoder

std::uint64_t VtuDecoder::take_count(VtuStream& stream) const {
  std::array<char, 8> bytes{};
  if (!stream.read(bytes.data(), byte_count(coding_.head))) {
    throw Failure{"no count of bytes in front of its numbers; the file may be cut short"};
  }
  const std::int64_t count = vtk_integer(coding_.head, bytes.data(), coding_.order);
  return count < 0 ? std::numeric_limits<std::uint64_t>::max() : static_cast<std::uint64_t>(count);
}

void VtuDecoder::spend(std::uint64_t bytes) {
  if (bytes > budget_) {
    throw Failure{fmt::format("{} bytes, more than a file of this size holds; save it anew", bytes)};
  }
  budget_ -= bytes;
}

std::string VtuDecoder::bytes(VtuStream& stream) {
  if (coding_.compression == VtuCoding::Compression::zlib) return compressed_bytes(stream);
  const std::uint64_t count = take_count(stream);
  if (count > stream.remaining()) fail_short(count, stream.remaining());
  spend(count);
  std::string bytes(static_cast<std::size_t>(count), '\0');
  if (!stream.read(bytes.data(), bytes.size())) fail_short(count, 0);
  return bytes;
}

/// In front stand how many blocks there are, the size of each but the last, that of the last if it is another, and the
/// size of each when compressed.
std::string VtuDecoder::compressed_bytes(VtuStream& stream) {
  const std::uint64_t blocks = take_count(stream);
  const std::uint64_t size = take_count(stream);
  const std::uint64_t last = take_count(stream);
  const std::uint64_t room = stream.remaining() / byte_count(coding_.head);
  if (blocks > room) {
    throw Failure{
        fmt::format("{} compressed blocks, where the file has room for at most {}; it may be cut short", blocks, room)};
  }
  std::vector<std::uint64_t> sizes(static_cast<std::size_t>(blocks));
  for (std::uint64_t& each : sizes) each = take_count(stream);
  std::string bytes;
  std::string packed;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const std::uint64_t unpacked = i + 1 == sizes.size() && last > 0 ? last : size;
    if (sizes[i] > stream.remaining()) fail_short(sizes[i], stream.remaining());
    if (unpacked / most_inflation > sizes[i]) {
      throw Failure{fmt::format("a block of {} bytes that becomes {}, which zlib never makes; save the file anew",
                                sizes[i], unpacked)};
    }
    spend(unpacked);
    packed.resize(static_cast<std::size_t>(sizes[i]));
    if (!stream.read(packed.data(), packed.size())) fail_short(sizes[i], 0);
    const std::size_t first = bytes.size();
    bytes.resize(first + static_cast<std::size_t>(unpacked));
    if (!uncompress_into(packed, std::span(bytes).subspan(first))) {
      throw Failure{fmt::format("compressed block {} is damaged; save the file anew", i)};
    }
  }
  return bytes;
}

}  // namespace pliant
