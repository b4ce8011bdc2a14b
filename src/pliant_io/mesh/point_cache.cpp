#include "pliant_io/mesh/point_cache.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant_io/files/read_file.h"

namespace pliant {
namespace {

static_assert(std::endian::native == std::endian::little, "PC2 and '<f8' are read as they lie in memory");

constexpr std::size_t bytes_of_float = 4;
constexpr std::size_t bytes_of_double = 8;

/// The number of type Number at a byte; it must be there.
template <typename Number>
Number number_at(std::string_view bytes, std::size_t first) {
  Number number;
  std::memcpy(&number, bytes.data() + first, sizeof number);
  return number;
}

template <typename Number>
Number big_endian_at(std::string_view bytes, std::size_t first) {
  static_assert(sizeof(Number) == 4);
  const auto bits = __builtin_bswap32(number_at<std::uint32_t>(bytes, first));
  return std::bit_cast<Number>(bits);
}

/// What a header says.
struct CacheCounts {
  std::int64_t frames = 0;
  std::int64_t vertices = 0;
};

[[noreturn]] void fail(std::string_view name, std::string_view what) {
  fail_input(fmt::format("{}: {}", name, what));
}

/// What a file of another kind is told; `magic` is what its first bytes should be.
[[noreturn]] void fail_kind(std::string_view name, std::string_view magic) {
  fail(name, fmt::format("does not begin with {}; give a file of the format that its name says", magic));
}

enum class Tail { allowed, refused };

/// The numbers from `first_byte` on must be there, and nothing behind them unless a file that is still written to may
/// have a part of its next frame there.
void check_size(std::string_view name, std::string_view bytes, std::size_t first_byte, CacheCounts counts,
                std::size_t number_size, Tail tail) {
  if (counts.frames < 1) fail(name, fmt::format("header: {} frames; there must be at least one", counts.frames));
  if (counts.vertices < 1 || counts.vertices > std::numeric_limits<Index>::max()) {
    fail(name, fmt::format("header: {} vertices; there must be from 1 to {}", counts.vertices,
                           std::numeric_limits<Index>::max()));
  }
  const std::size_t available = bytes.size() - std::min(first_byte, bytes.size());
  const std::size_t frame_size = static_cast<std::size_t>(counts.vertices) * 3 * number_size;
  const std::size_t frames = available / frame_size;
  const auto wanted = static_cast<std::size_t>(counts.frames);
  const bool is_longer = tail == Tail::refused && (frames > wanted || available % frame_size != 0);
  if (first_byte <= bytes.size() && frames >= wanted && !is_longer) return;
  fail(name,
       fmt::format("header: {} frames of {} vertices do not fit a file of {} bytes, which has {} such frames; the "
                   "file is cut off or its header wrong: write it again",
                   counts.frames, counts.vertices, bytes.size(), frames));
}

void check_times(std::string_view name, const std::vector<Real>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i])) {
      fail(name, fmt::format("frame {}: its time is not finite; write the file again", i));
    }
    if (!std::isfinite(times[i] - times.front())) {
      fail(name,
           fmt::format("frame {}: its time, {} s, is further from the first, {} s, than numbers go; give times in "
                       "seconds",
                       i, times[i], times.front()));
    }
    if (i > 0 && !(times[i] > times[i - 1])) {
      fail(name,
           fmt::format("frame {}: its time, {} s, is not after that of the frame before, {} s; give frames rising "
                       "times",
                       i, times[i], times[i - 1]));
    }
  }
}

std::vector<Real> even_times(std::int64_t count, Real start, Real rate, Real frames_per_second) {
  std::vector<Real> times(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = (start + static_cast<Real>(i) * rate) / frames_per_second;
  return times;
}

/// The dictionary at the start of an NPY file (numpy.lib.format), as far as point caches need it.
class NpyHeader {
 public:
  NpyHeader(std::string_view bytes, std::string_view name) : name_(name) {
    constexpr std::string_view magic = "\x93NUMPY";
    constexpr std::size_t sizes_at = 8;  // behind two bytes of version
    if (!bytes.starts_with(magic) || bytes.size() < sizes_at + 4) fail_kind(name, "\\x93NUMPY and a version");
    const bool is_first_version = bytes[magic.size()] == 1;
    const std::size_t size =
        is_first_version ? number_at<std::uint16_t>(bytes, sizes_at) : number_at<std::uint32_t>(bytes, sizes_at);
    const std::size_t first = sizes_at + (is_first_version ? 2 : 4);
    if (size > bytes.size() - first) fail(name, "header: is cut off; write the file again");
    dictionary_ = bytes.substr(first, size);
    first_byte_ = first + size;
  }

  std::size_t first_byte() const { return first_byte_; }

  bool is_double() const {
    const std::string_view type = value("descr");
    if (type.starts_with("'<f8'")) return true;
    if (type.starts_with("'<f4'")) return false;
    fail(name_, "header: 'descr' is neither '<f4' nor '<f8'; save the array with dtype float32 or float64");
  }

  CacheCounts counts() const {
    if (!value("fortran_order").starts_with("False")) {
      fail(name_, "header: 'fortran_order' is not False; save numpy.ascontiguousarray(positions)");
    }
    std::string_view shape = value("shape");
    if (!shape.starts_with('(')) fail_shape();
    const std::int64_t frames = next_count(shape);
    const std::int64_t vertices = next_count(shape);
    if (next_count(shape) != 3) fail_shape();
    if (shape.starts_with(',')) shape.remove_prefix(1);
    skip_blanks(shape);
    if (!shape.starts_with(')')) fail_shape();
    return {frames, vertices};
  }

 private:
  static void skip_blanks(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  }

  /// What stands behind `'key':`.
  std::string_view value(std::string_view key) const {
    const std::string quoted = fmt::format("'{}'", key);
    const std::size_t place = dictionary_.find(quoted);
    if (place == dictionary_.npos) fail(name_, fmt::format("header: has no {}; write the file by numpy.save", quoted));
    std::string_view rest = dictionary_.substr(place + quoted.size());
    skip_blanks(rest);
    if (!rest.starts_with(':'))
      fail(name_, fmt::format("header: no value of {}; write the file by numpy.save", quoted));
    rest.remove_prefix(1);
    skip_blanks(rest);
    return rest;
  }

  /// Takes one character, a bracket or a comma, and the number behind it.
  std::int64_t next_count(std::string_view& shape) const {
    if (!shape.starts_with('(') && !shape.starts_with(',')) fail_shape();
    shape.remove_prefix(1);
    skip_blanks(shape);
    std::int64_t count = 0;
    const auto [end, error] = std::from_chars(shape.data(), shape.data() + shape.size(), count);
    if (error != std::errc()) fail_shape();
    shape.remove_prefix(static_cast<std::size_t>(end - shape.data()));
    skip_blanks(shape);
    return count;
  }

  [[noreturn]] void fail_shape() const {
    fail(name_, "header: 'shape' is not (frames, vertices, 3); save the positions as such an array");
  }

  std::string_view name_;
  std::string_view dictionary_;
  std::size_t first_byte_ = 0;
};

void check_options(const PointCacheOptions& options) {
  if (std::isfinite(options.frames_per_second) && options.frames_per_second > 0) return;
  fail_input(
      fmt::format("{} frames per second are not possible; give a number greater than 0", options.frames_per_second));
}

}  // namespace

PointCache::PointCache(std::string bytes, std::size_t first_byte, Scalar scalar, Index vertex_count,
                       std::vector<Real> times)
    : bytes_(std::move(bytes)),
      first_byte_(first_byte),
      scalar_(scalar),
      vertex_count_(vertex_count),
      times_(std::move(times)) {}

PointCache PointCache::parse_pc2(std::string bytes, std::string_view name, Real frames_per_second) {
  constexpr std::string_view magic("POINTCACHE2\0", 12);
  constexpr std::size_t header_size = 32;
  if (!bytes.starts_with(magic) || bytes.size() < header_size) fail_kind(name, "POINTCACHE2 and a header of 32 bytes");
  if (const auto version = number_at<std::int32_t>(bytes, 12); version != 1) {
    fail(name, fmt::format("header: version {}; only version 1 is known, export the cache as that", version));
  }
  const CacheCounts counts = {number_at<std::int32_t>(bytes, 28), number_at<std::int32_t>(bytes, 16)};
  const Real start = number_at<float>(bytes, 20);
  const Real rate = number_at<float>(bytes, 24);
  check_size(name, bytes, header_size, counts, bytes_of_float, Tail::allowed);
  return {std::move(bytes), header_size, Scalar::float32, static_cast<Index>(counts.vertices),
          even_times(counts.frames, start, rate, frames_per_second)};
}

PointCache PointCache::parse_mdd(std::string bytes, std::string_view name) {
  constexpr std::size_t counts_size = 8;
  if (bytes.size() < counts_size) fail(name, "header: is cut off; an MDD file begins with two counts of 4 bytes");
  const CacheCounts counts = {big_endian_at<std::int32_t>(bytes, 0), big_endian_at<std::int32_t>(bytes, 4)};
  const std::size_t first =
      counts_size + static_cast<std::size_t>(std::max<std::int64_t>(0, counts.frames)) * bytes_of_float;
  check_size(name, bytes, first, counts, bytes_of_float, Tail::refused);
  std::vector<Real> times(static_cast<std::size_t>(counts.frames));
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i] = static_cast<Real>(big_endian_at<float>(bytes, counts_size + i * bytes_of_float));
  }
  return {std::move(bytes), first, Scalar::float32_big_endian, static_cast<Index>(counts.vertices), std::move(times)};
}

PointCache PointCache::parse_npy(std::string bytes, std::string_view name, Real frames_per_second) {
  const NpyHeader header(bytes, name);
  const CacheCounts counts = header.counts();
  const bool is_double = header.is_double();
  const std::size_t first = header.first_byte();
  check_size(name, bytes, first, counts, is_double ? bytes_of_double : bytes_of_float, Tail::allowed);
  return {std::move(bytes), first, is_double ? Scalar::float64 : Scalar::float32, static_cast<Index>(counts.vertices),
          even_times(counts.frames, 0, 1, frames_per_second)};
}

PointCache PointCache::parse(std::string bytes, std::string_view name, PointCacheFormat format,
                             const PointCacheOptions& options) {
  check_options(options);
  const auto parse_format = [&] {
    switch (format) {
      case PointCacheFormat::pc2:
        return parse_pc2(std::move(bytes), name, options.frames_per_second);
      case PointCacheFormat::mdd:
        return parse_mdd(std::move(bytes), name);
      case PointCacheFormat::npy:
        break;
    }
    return parse_npy(std::move(bytes), name, options.frames_per_second);
  };
  PointCache cache = parse_format();
  check_times(name, cache.times_);
  cache.check_numbers(name);
  return cache;
}

PointCache PointCache::read(const std::filesystem::path& path, const PointCacheOptions& options) {
  const std::optional<PointCacheFormat> format = point_cache_format(path);
  if (!format) {
    fail(path.string(), "its extension tells no point cache; give a .pc2, .mdd or .npy file");
  }
  return parse(read_file(path), path.string(), *format, options);
}

PointCache PointCache::from_frames(std::span<const Positions> frames, std::vector<Real> times) {
  if (frames.empty()) fail_input("a point cache of no frames; give at least one");
  std::string bytes;
  const Eigen::Index vertex_count = frames.front().rows();
  bytes.reserve(frames.size() * static_cast<std::size_t>(vertex_count) * 3 * bytes_of_double);
  for (const Positions& positions : frames) {
    if (positions.rows() != vertex_count || vertex_count == 0) {
      fail_input(fmt::format("a frame of {} vertices among frames of {}; give all frames the same, one or more",
                             positions.rows(), vertex_count));
    }
    bytes.append(reinterpret_cast<const char*>(positions.data()),
                 static_cast<std::size_t>(positions.size()) * bytes_of_double);
  }
  PointCache cache(std::move(bytes), 0, Scalar::float64, static_cast<Index>(vertex_count),
                   std::vector<Real>(frames.size()));
  cache.check_numbers("frames");
  cache.set_times(std::move(times));
  return cache;
}

void PointCache::set_times(std::vector<Real> times) {
  if (times.empty() || times.size() > times_.size()) {
    fail_input(fmt::format("{} times for {} frames; give at least one, and not more than frames", times.size(),
                           times_.size()));
  }
  check_times("times", times);
  times_ = std::move(times);
}

Real PointCache::number(std::size_t i) const {
  switch (scalar_) {
    case Scalar::float32:
      return static_cast<Real>(number_at<float>(bytes_, first_byte_ + i * bytes_of_float));
    case Scalar::float32_big_endian:
      return static_cast<Real>(big_endian_at<float>(bytes_, first_byte_ + i * bytes_of_float));
    case Scalar::float64:
      break;
  }
  return number_at<double>(bytes_, first_byte_ + i * bytes_of_double);
}

void PointCache::check_numbers(std::string_view name) const {
  const auto frame_size = static_cast<std::size_t>(vertex_count_) * 3;
  const std::size_t count = frame_size * times_.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isfinite(number(i))) continue;
    fail(name, fmt::format("frame {}, vertex {}: its position is not finite; write the frames before it only",
                           i / frame_size, i % frame_size / 3));
  }
}

Vec3 PointCache::position(std::int64_t frame, Index vertex) const {
  const std::size_t first =
      (static_cast<std::size_t>(frame) * static_cast<std::size_t>(vertex_count_) + static_cast<std::size_t>(vertex)) *
      3;
  return {number(first), number(first + 1), number(first + 2)};
}

void PointCache::frame(std::int64_t frame, Positions& positions) const {
  positions.resize(vertex_count_, 3);
  const auto size = static_cast<std::size_t>(positions.size());
  const std::size_t first = static_cast<std::size_t>(frame) * size;
  for (std::size_t i = 0; i < size; ++i) positions.data()[i] = number(first + i);
}

void PointCache::sample(Real time, Positions& positions) const {
  const auto next = std::ranges::upper_bound(times_, time) - times_.begin();
  if (next == 0 || next == frame_count()) return frame(std::max<std::int64_t>(0, next - 1), positions);
  const Real before = this->time(next - 1);
  const Real share = (time - before) / (this->time(next) - before);
  positions.resize(vertex_count_, 3);
  const auto size = static_cast<std::size_t>(positions.size());
  const std::size_t first = static_cast<std::size_t>(next - 1) * size;
  for (std::size_t i = 0; i < size; ++i) {
    positions.data()[i] = (1 - share) * number(first + i) + share * number(first + size + i);
  }
}

std::optional<PointCacheFormat> point_cache_format(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension.empty()) return {};
  constexpr auto names = choice_names(PointCacheFormat{});
  const auto found = std::ranges::find(names, std::string_view(extension).substr(1));
  if (found == names.end()) return {};
  return static_cast<PointCacheFormat>(found - names.begin());
}

}  // namespace pliant
