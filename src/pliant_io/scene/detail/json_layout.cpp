#include "pliant_io/scene/detail/json_layout.h"

#include <algorithm>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant {
namespace {

constexpr std::size_t line_length = 120;
constexpr std::size_t indent = 2;

std::string scalar(const SceneJson& json) {
  try {
    return json.dump();
  } catch (const SceneJson::exception&) {
    fail_input("'" + printable(json.get_ref<const std::string&>()) +
               "' is not UTF-8, so JSON cannot have it; rename it");
  }
}

class Layout {
 public:
  std::string text;

  void write(const SceneJson& json, std::size_t depth, std::size_t column) {
    if (json.empty() || !json.is_structured()) {
      text += scalar(json);
    } else if (std::string line; depth > 0 && put_in_line(json, line, line_length - std::min(column, line_length))) {
      text += line;
    } else if (json.is_object()) {
      write_object(json, depth);
    } else {
      write_list(json, depth);
    }
  }

 private:
  /// False, with an unfinished line, where the value takes more than so many letters.
  static bool put_in_line(const SceneJson& json, std::string& line, std::size_t most) {
    if (json.empty() || !json.is_structured()) {
      line += scalar(json);
      return line.size() <= most;
    }
    const char* separator = json.is_object() ? "{" : "[";
    for (const auto& [key, value] : json.items()) {
      line += separator;
      if (json.is_object()) line += scalar(key) + ": ";
      if (!put_in_line(value, line, most)) return false;
      separator = ", ";
    }
    line += json.is_object() ? '}' : ']';
    return line.size() <= most;
  }

  void new_line(std::size_t depth) {
    text += '\n';
    text.append(depth * indent, ' ');
  }

  void write_object(const SceneJson& json, std::size_t depth) {
    char separator = '{';
    for (const auto& [key, value] : json.items()) {
      text += separator;
      new_line(depth + 1);
      const std::string name = scalar(key) + ": ";
      text += name;
      write(value, depth + 1, (depth + 1) * indent + name.size() + 1);
      separator = ',';
    }
    new_line(depth);
    text += '}';
  }

  void write_list(const SceneJson& json, std::size_t depth) {
    const bool fills = std::ranges::none_of(json, [](const SceneJson& entry) { return entry.is_structured(); });
    std::size_t column = line_length;
    text += '[';
    for (std::size_t i = 0; i < json.size(); ++i) {
      const std::string entry = fills ? scalar(json[i]) : "";
      if (i > 0) text += ',';
      if (!fills || column + entry.size() + 2 > line_length) {
        new_line(depth + 1);
        column = (depth + 1) * indent;
      } else {
        text += ' ';
      }
      column += entry.size() + 2;
      if (fills) {
        text += entry;
      } else {
        write(json[i], depth + 1, (depth + 1) * indent + 1);
      }
    }
    new_line(depth);
    text += ']';
  }
};

}  // namespace

std::string lay_out(const SceneJson& json) {
  Layout layout;
  layout.write(json, 0, 0);
  return std::move(layout.text);
}

}  // namespace pliant
