#include "pliant_io/files/compression.h"

#include <new>

#include <zlib.h>

namespace pliant {

namespace {

const Bytef* zlib_bytes(const char* bytes) {
  return reinterpret_cast<const Bytef*>(bytes);  // NOLINT: zlib's bytes are unsigned
}

}  // namespace

std::string compressed(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  auto* const out = reinterpret_cast<Bytef*>(result.data());  // NOLINT: zlib's bytes are unsigned
  const int code = compress2(out, &size, zlib_bytes(bytes.data()), static_cast<uLong>(bytes.size()), 6);
  if (code != Z_OK) throw std::bad_alloc();  // the one thing that can go wrong with room for the result
  result.resize(size);
  return result;
}

bool uncompress_into(std::string_view bytes, std::span<char> into) {
  auto size = static_cast<uLongf>(into.size());
  auto* const out = reinterpret_cast<Bytef*>(into.data());  // NOLINT: zlib's bytes are unsigned
  return uncompress(out, &size, zlib_bytes(bytes.data()), static_cast<uLong>(bytes.size())) == Z_OK &&
         size == into.size();
}

}  // namespace pliant
