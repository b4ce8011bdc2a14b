#include "pliant_io/scene/document.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant {

void WordStore::push_back(Word word) {
  if (size_ / block_size == blocks_.size()) blocks_.push_back(nullptr);
  std::unique_ptr<Block>& block = blocks_[size_ / block_size];
  if (!block) block = std::make_unique_for_overwrite<Block>();
  (*block)[size_++ % block_size] = word;
}

void WordStore::move_tail(std::size_t begin, WordStore& target) {
  for (std::size_t i = begin; i < size_; ++i) {
    target.push_back((*this)[i]);
    const bool ends_block = i % block_size == block_size - 1;
    if (ends_block && i + 1 >= begin + block_size) blocks_[i / block_size].reset();
  }
  size_ = begin;
  const std::size_t kept = begin / block_size + 1;  // the block that the next word goes to stays
  if (blocks_.size() > kept) blocks_.resize(kept);
}

std::size_t TextStore::add(std::string_view text) {
  if (text.size() >= long_text) {
    blocks_.push_back(std::make_unique_for_overwrite<char[]>(text.size()));
    std::ranges::copy(text, blocks_.back().get());
    return (blocks_.size() - 1) * block_size;
  }
  const std::size_t units = (text.size() + unit - 1) / unit;
  if (used_ + units > block_size) {
    open_block_ = blocks_.size();
    blocks_.push_back(std::make_unique_for_overwrite<char[]>(block_size * unit));
    used_ = 0;
  }
  std::ranges::copy(text, blocks_[open_block_].get() + used_ * unit);
  const std::size_t place = open_block_ * block_size + used_;
  used_ += units;
  return place;
}

std::int64_t Document::integer(Place place) const {
  const Word word = words_[place];
  if (kind_of(word) == Kind::wide_integer) return std::bit_cast<std::int64_t>(words_[first_of(word)]);
  return std::bit_cast<std::int64_t>(word) >> kind_bits;
}

std::string Document::path_of(Place place) const {
  std::string path;
  Place container = root();
  while (container != place) {
    const bool is_object = kind(container) == Kind::object;
    const std::size_t count = kind(container) == Kind::list || is_object ? size(container) : 0;
    const auto child = [&](std::size_t i) { return is_object ? member(container, i) : entry(container, i); };
    // What is inside a container stands before the end of its own words, so the first that ends behind has it.
    const auto holds = [&](Place value) {
      if (value == place) return true;
      const Kind inner = kind(value);
      if (inner != Kind::list && inner != Kind::object) return false;
      const std::size_t words = size(value) * (inner == Kind::object ? 2 : 1);
      return words > 0 && place < first_of(words_[value]) + words;
    };
    std::size_t i = 0;
    while (i < count && !holds(child(i))) ++i;
    if (i == count) return path;  // of another document
    path = is_object ? join_key(path, text(key(container, i))) : fmt::format("{}[{}]", path, i);
    container = child(i);
  }
  return path;
}

std::string join_key(std::string_view path, std::string_view key) {
  return path.empty() ? printable(key) : fmt::format("{}.{}", path, printable(key));
}

void fail_at(std::string_view file, std::string_view path, std::string_view what) {
  const std::string place = path.empty() ? "" : printable_place(path) + ": ";
  fail_input(fmt::format("{}: {}{}", printable_place(file), place, what));
}

}  // namespace pliant
