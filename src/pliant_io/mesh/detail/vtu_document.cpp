#include "pliant_io/mesh/detail/vtu_document.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/mesh/detail/polygon_builder.h"
#include "pliant_io/mesh/detail/text_lexer.h"

namespace pliant {

namespace {

constexpr std::string_view appended_tag = "<AppendedData";
constexpr std::string_view appended_end = "</AppendedData";
constexpr std::string_view file_end = "</VTKFile>";
constexpr std::string_view xml_blanks = " \t\r\n";

/// Where the text first stands in the file; its size when it does not.
std::uint64_t find_in_source(const ByteSource& source, std::string_view text) {
  constexpr std::size_t block = 1 << 18;
  std::string bytes(block + text.size(), '\0');
  for (std::uint64_t offset = 0; offset < source.size(); offset += block) {
    const std::size_t count = source.read(offset, bytes.data(), bytes.size());
    const std::size_t found = std::string_view(bytes).substr(0, count).find(text);
    if (found != std::string_view::npos) return offset + found;
  }
  return source.size();
}

std::string read_part(const ByteSource& source, ByteRange range) {
  std::string bytes(static_cast<std::size_t>(range.end - range.begin), '\0');
  bytes.resize(source.read(range.begin, bytes.data(), bytes.size()));
  return bytes;
}

/// The next word of a text, taken from its front; empty at its end.
std::string_view take_xml_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(xml_blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(xml_blanks));
  text.remove_prefix(word.size());
  return word;
}

std::string describe_array(const pugi::xml_node& array) {
  return fmt::format("array {}", TextLexer::quoted(array.attribute("Name").value()));
}

}  // namespace

VtuDocument::VtuDocument(const ByteSource& source) : source_(source), decoder_({}, 0) {
  load();
  read_head();
  decoder_ = VtuDecoder(coding_, source.size());
}

/// What is appended may be any bytes and is cut off.
void VtuDocument::load() {
  const std::uint64_t tag = find_in_source(source_, appended_tag);
  std::uint64_t end = tag;
  const std::string behind = read_part(source_, {tag, std::min(source_.size(), tag + 1024)});
  if (!behind.empty()) end += std::min(behind.find('>') + 1, behind.size());
  text_ = read_part(source_, {0, end});
  check_text();
  if (!behind.empty()) {
    appended_ = {end, source_.size()};
    find_appended();
    text_ += std::string(appended_end) + ">" + std::string(file_end);
  }
  const pugi::xml_parse_result result =
      document_.load_buffer_inplace(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
  if (result) return;
  fail_at(static_cast<std::uint64_t>(std::max<std::ptrdiff_t>(0, result.offset)),
          fmt::format("this is not well-formed XML: {}; it may be cut short, save it anew", result.description()));
}

/// The tags of a file take far more memory than their bytes; a mesh has few of them.
void VtuDocument::check_text() const {
  if (const std::size_t nul = text_.find('\0'); nul != std::string::npos) {
    fail_at(nul, "a NUL byte; this is not text, save it anew");
  }
  const std::uint64_t most = (1 << 16) + source_.size() / 64;
  const auto marks = std::ranges::count_if(text_, [](char c) { return c == '<' || c == '='; });
  if (static_cast<std::uint64_t>(marks) > most + 2) {
    source_.fail(fmt::format("more than {} tags and attributes, which no mesh has; save it anew", most));
  }
}

/// Blanks and _ stand in front of the data, the end of the file behind it.
void VtuDocument::find_appended() {
  const std::string front = read_part(source_, {appended_.begin, std::min(appended_.end, appended_.begin + 1024)});
  const std::size_t first = front.find_first_not_of(xml_blanks);
  if (first == std::string::npos || front[first] != '_') {
    fail_at(appended_.begin, "appended data that does not begin with _; save the file anew");
  }
  appended_.begin += first + 1;
  const std::uint64_t near_end =
      std::max(appended_.begin, appended_.end - std::min<std::uint64_t>(appended_.end, 1024));
  const std::string tail = read_part(source_, {near_end, appended_.end});
  const std::size_t last = tail.rfind(appended_end);
  if (last == std::string::npos || tail.find(file_end, last) == std::string::npos) {
    source_.fail("the file ends within its appended data; it may be cut short");
  }
  appended_.end = near_end + last;
}

void VtuDocument::read_head() {
  const pugi::xml_node file = document_.child("VTKFile");
  if (!file) source_.fail("no element VTKFile; save the mesh as a file of VTK");
  const std::string_view type = file.attribute("type").value();
  if (type != "UnstructuredGrid") {
    fail(file, fmt::format("a dataset of type {}; save an UnstructuredGrid", TextLexer::quoted(type)));
  }
  grid_ = file.child("UnstructuredGrid");
  if (!grid_) fail(file, "no element UnstructuredGrid; save the mesh anew");
  if (file.attribute("byte_order").value() == std::string_view("BigEndian")) coding_.order = VtkByteOrder::big;
  const std::string_view head = file.attribute("header_type").as_string("UInt32");
  if (head != "UInt32" && head != "UInt64") {
    fail(file, fmt::format("header_type {}; save it as UInt32 or UInt64", TextLexer::quoted(head)));
  }
  coding_.head = head == "UInt32" ? VtkType::uint32 : VtkType::uint64;
  const std::string_view compressor = file.attribute("compressor").value();
  if (compressor == "vtkZLibDataCompressor") {
    coding_.compression = VtuCoding::Compression::zlib;
  } else if (!compressor.empty()) {
    fail(file,
         fmt::format("compressed by {}; save it compressed by zlib, or not at all", TextLexer::quoted(compressor)));
  }
  const std::string_view encoding = file.child("AppendedData").attribute("encoding").value();
  if (encoding == "base64") appended_form_ = VtuStream::Form::base64;
}

std::int64_t VtuDocument::components(const pugi::xml_node& array) const {
  return array.attribute("NumberOfComponents") ? count(array, "NumberOfComponents", max_index_count) : 1;
}

std::int64_t VtuDocument::count(const pugi::xml_node& element, const char* attribute, std::uint64_t most) const {
  std::int64_t count = 0;
  std::string message = parse_integer(element.attribute(attribute).value(), count);
  if (message.empty() && (count < 0 || static_cast<std::uint64_t>(count) > most)) {
    message = fmt::format("{}, where there is room for at most {}; it may be cut short", count, most);
  }
  if (!message.empty()) fail(element, fmt::format("{}: {}", attribute, message));
  return count;
}

bool VtuDocument::has_room(std::uint64_t numbers) const {
  const bool is_compressed = coding_.compression != VtuCoding::Compression::none;
  return numbers <= (is_compressed ? 64 * source_.size() + (16U << 20U) : source_.size());
}

VtkType VtuDocument::type_of(const pugi::xml_node& array) const {
  const std::string_view name = array.attribute("type").value();
  const auto type = xml_type(name);
  if (!type)
    fail(array, fmt::format("{}: type {}; save numbers, Float64 say", describe_array(array), TextLexer::quoted(name)));
  return *type;
}

/// Of an array that is no text.
std::string VtuDocument::bytes(const pugi::xml_node& array) {
  const std::string_view format = array.attribute("format").value();
  try {
    if (format == "binary") {
      const ByteSource text(std::string_view(array.text().get()), source_.name());
      VtuStream stream(text, {0, text.size()}, VtuStream::Form::base64);
      return decoder_.bytes(stream);
    }
    if (format != "appended") {
      throw VtuDecoder::Failure{
          fmt::format("format {}; save it as ascii, binary or appended", TextLexer::quoted(format))};
    }
    const std::int64_t offset = count(array, "offset", appended_.end - appended_.begin);
    VtuStream stream(source_, {appended_.begin + static_cast<std::uint64_t>(offset), appended_.end}, appended_form_);
    return decoder_.bytes(stream);
  } catch (const VtuDecoder::Failure& failure) {
    fail(array, fmt::format("{}: {}", describe_array(array), failure.message));
  }
}

void VtuDocument::read_reals(const pugi::xml_node& array, std::span<Real> into) {
  const VtkType type = type_of(array);
  const auto check_count = [&](std::uint64_t found) {
    if (found == into.size()) return;
    fail(array,
         fmt::format("{}: {} numbers in place of {}; it may be cut short", describe_array(array), found, into.size()));
  };
  if (array.attribute("format").value() == std::string_view("ascii")) {
    std::string_view text = array.text().get();
    for (std::size_t i = 0;; ++i) {
      const std::string_view word = take_xml_word(text);
      if (word.empty() || i == into.size()) return check_count(i + (word.empty() ? 0 : 1));
      if (const std::string message = parse_number(word, into[i]); !message.empty()) {
        fail(array, fmt::format("{}: {}", describe_array(array), message));
      }
    }
  }
  const std::string numbers = bytes(array);
  const std::size_t size = byte_count(type);
  check_count(numbers.size() / size);
  for (std::size_t i = 0; i < into.size(); ++i) into[i] = vtk_real(type, numbers.data() + i * size, coding_.order);
}

std::vector<Index> VtuDocument::read_indices(const pugi::xml_node& array, std::int64_t most, std::string_view what) {
  std::vector<Index> indices;
  const auto add = [&](std::int64_t index) {
    if (index < 0 || index > most) {
      fail(array, fmt::format("{}: {} {} is out of range; use 0 to {}", describe_array(array), what, index, most));
    }
    indices.push_back(static_cast<Index>(index));
  };
  const VtkType type = type_of(array);
  if (is_float(type)) fail(array, fmt::format("{}: floats; save whole numbers", describe_array(array)));
  if (array.attribute("format").value() == std::string_view("ascii")) {
    std::string_view text = array.text().get();
    for (std::string_view word = take_xml_word(text); !word.empty(); word = take_xml_word(text)) {
      std::int64_t index = 0;
      if (const std::string message = parse_integer(word, index); !message.empty()) {
        fail(array, fmt::format("{}: {}", describe_array(array), message));
      }
      add(index);
    }
    return indices;
  }
  const std::string numbers = bytes(array);
  const std::size_t size = byte_count(type);
  indices.reserve(numbers.size() / size);
  for (std::size_t i = 0; i + size <= numbers.size(); i += size) {
    add(vtk_integer(type, numbers.data() + i, coding_.order));
  }
  return indices;
}

void VtuDocument::fail(const pugi::xml_node& element, std::string_view message) const {
  fail_at(static_cast<std::uint64_t>(std::max<std::ptrdiff_t>(0, element.offset_debug())), message);
}

/// The lines are counted in the file: the document has changed the text.
void VtuDocument::fail_at(std::uint64_t offset, std::string_view message) const {
  std::int64_t line = 1;
  char last = '\0';
  for (const char c : read_part(source_, {0, std::min(offset, source_.size())})) {
    if (c == '\r' || (c == '\n' && last != '\r')) ++line;
    last = c;
  }
  fail_input(fmt::format("{}:{}: {}", printable_place(source_.name()), line, message));
}

}  // namespace pliant
