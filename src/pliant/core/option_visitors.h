#pragma once
// The options of a type that is not known: told one after the other, or changed. Which kinds of options can be listed
// and set stands here once; lists with a number for each vertex, selections and whatever else there is are passed over.
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "pliant/core/options.h"

namespace pliant {

/// Is told every option, with its value.
class OptionLister {
 public:
  virtual ~OptionLister() = default;
  virtual void list(const OptionInfo& info, const Real& number) = 0;
  virtual void list(const OptionInfo& info, const Index& number) = 0;
  virtual void list(const OptionInfo& info, const std::optional<Real>& number) = 0;
  virtual void list(const OptionInfo& info, const bool& flag) = 0;
  virtual void list(const OptionInfo& info, const Vec3& vector) = 0;
  virtual void list(const OptionInfo& info, const Values& values) = 0;
  virtual void list(const OptionInfo& info, const Points& points) = 0;
  /// `chosen`: the index of the name.
  virtual void list(const OptionInfo& info, std::span<const std::string_view> names, int chosen) = 0;
};

/// May change options, at most one of them.
class OptionSetter {
 public:
  virtual ~OptionSetter() = default;
  /// Whether it is this one that it has changed.
  bool has_changed(const void* option) const { return option != nullptr && option == changed_; }
  virtual void set(const OptionInfo& info, Real& number) = 0;
  virtual void set(const OptionInfo& info, Index& number) = 0;
  virtual void set(const OptionInfo& info, std::optional<Real>& number) = 0;
  virtual void set(const OptionInfo& info, bool& flag) = 0;
  virtual void set(const OptionInfo& info, Vec3& vector) = 0;
  virtual void set(const OptionInfo& info, Values& values) = 0;
  virtual void set(const OptionInfo& info, Points& points) = 0;
  /// `chosen`: the index of a name.
  virtual void set_choice(const OptionInfo& info, int& chosen) = 0;

 protected:
  const void* changed_ = nullptr;
};

namespace detail {

template <class Option, class... Kinds>
inline constexpr bool is_one_of = (std::is_same_v<Option, Kinds> || ...);

template <class Option>
inline constexpr bool is_listed = is_one_of<Option, Real, Index, std::optional<Real>, bool, Vec3, Values, Points>;

template <class Option>
concept is_choice = std::is_enum_v<Option> && !std::is_const_v<Option> && requires {
  choice_names(Option{});
};

}  // namespace detail

template <class Options>
void list_options(const Options& options, OptionLister& lister) {
  Options::visit(options, [&lister]<class Option>(const OptionInfo& info, const Option& option) {
    if constexpr (detail::is_choice<Option>) {
      static constexpr auto names = choice_names(Option{});
      lister.list(info, names, static_cast<int>(option));
    } else if constexpr (detail::is_listed<Option>) {
      lister.list(info, option);
    }
  });
}

template <class Options>
void set_options(Options& options, OptionSetter& setter) {
  Options::visit(options, [&setter]<class Option>(const OptionInfo& info, Option& option) {
    if constexpr (detail::is_choice<Option>) {
      int chosen = static_cast<int>(option);
      setter.set_choice(info, chosen);
      option = static_cast<Option>(chosen);
    } else if constexpr (detail::is_listed<Option>) {
      setter.set(info, option);
    }
  });
}

}  // namespace pliant
