#pragma once
// OptionType for one struct of options.
#include <cstdlib>

#include <cxxabi.h>

#include "annotations.h"
#include "option_types.h"
#include "pliant/constraints/attachment.h"
#include "pliant/materials/material_groups.h"

namespace pliant_python {

/// "TriangleStvk" of triangle_stvk.
inline std::string in_camel_case(std::string_view words) {
  std::string name;
  bool begins = true;
  for (const char letter : words) {
    const bool is_small = letter >= 'a' && letter <= 'z';
    if (letter != '_') name += begins && is_small ? static_cast<char>(letter - 'a' + 'A') : letter;
    begins = letter == '_';
  }
  return name;
}

/// "EdgeSpring" of pliant::EdgeSpring; of a template, which has no name of its own, that in scene files.
template <class Options>
std::string class_name_of() {
  char* const text = abi::__cxa_demangle(typeid(Options).name(), nullptr, nullptr, nullptr);
  std::string name = text;
  std::free(text);
  if constexpr (requires { Options::info.name; }) {
    if (name.ends_with('>')) return in_camel_case(Options::info.name);
  }
  return name.substr(name.rfind(':') + 1);
}

/// Visits all that a type has, what scene files have in another form as well.
template <class Self, class Visitor>
void visit_all(Self& self, Visitor&& field) {
  using Options = std::remove_const_t<Self>;
  using pliant::OptionInfo;
  if constexpr (std::is_same_v<Options, pliant::Attachment>) {
    field(OptionInfo{"on", "", "vertices that are tied"}, self.on);
    field(OptionInfo{"to", "", "the body that they are tied to, which may be the same"}, self.to);
    field(OptionInfo{"to_on", "", "and what of it"}, self.to_on);
  }
  Options::visit(self, field);
  if constexpr (std::is_same_v<Options, pliant::BodyContact>) {
    field(OptionInfo{"ignores", "", "bodies that it does not touch"}, self.ignores);
  }
}

template <class Options>
Options read_options(const py::dict& given, const pliant::Mesh* mesh, Options options = {}) {
  const std::string owner = class_name_of<Options>();
  std::vector<std::string_view> names;
  visit_all(options, [&](const pliant::OptionInfo& info, const auto&) { names.push_back(info.name); });
  check_keywords(owner, given, names);
  visit_all(options, OptionReader{given, owner, mesh});
  pliant::check_options(owner, options);
  return options;
}

template <class Options>
py::dict options_to_python(const Options& options) {
  py::dict result;
  visit_all(options, [&](const pliant::OptionInfo& info, const auto& value) {
    result[py::str(info.name.data(), info.name.size())] = to_python(value);
  });
  return result;
}

/// A default as Python shows it; None where there is none to be named.
template <class Value>
py::object default_of(const Value& value) {
  if constexpr (std::is_same_v<Value, pliant::BodyId>) {
    return py::none();
  } else {
    return to_python(value);
  }
}

template <class Options>
class TypedOptions : public OptionType {
 public:
  std::string class_name() const override { return class_name_of<Options>(); }
  std::string kind() const override { return "settings"; }
  std::string scene_name() const override { return ""; }
  std::string summary() const override { return ""; }
  void check(const py::dict& given) const override { read_options<Options>(given, nullptr); }

  py::list fields() const override {
    py::list list;
    const Options defaults;
    visit_all(defaults, [&](const pliant::OptionInfo& info, const auto& value) {
      py::dict field;
      field["name"] = std::string(info.name);
      field["unit"] = std::string(info.unit);
      field["doc"] = std::string(info.doc);
      field["type"] = annotation(info, value);
      field["default"] = default_of(value);
      list.append(field);
    });
    return list;
  }
};

}  // namespace pliant_python
