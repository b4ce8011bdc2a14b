#pragma once
// Reads XML, and HTML as it is written here: every element is closed, but for those of HTML that have no content.
#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pliant_tests {

struct MarkupElement {
  std::string name;
  std::map<std::string, std::string> attributes{};
  std::string text{};  ///< all that stands in it, without tags, references replaced

  bool has_class(std::string_view wanted) const {
    std::istringstream classes(attribute("class"));
    for (std::string each; classes >> each;) {
      if (each == wanted) return true;
    }
    return false;
  }
  std::string attribute(const std::string& key) const {
    const auto found = attributes.find(key);
    return found == attributes.end() ? std::string() : found->second;
  }
};

/// The elements of a document in the order in which they begin. Throws std::runtime_error where it is not well formed.
class Markup {
 public:
  explicit Markup(std::string_view text) : text_(text) {
    if (text_.starts_with("<!DOCTYPE html>")) at_ = 15;
    while (at_ < text_.size()) {
      if (text_[at_] == '<') {
        read_tag();
      } else {
        read_text();
      }
    }
    check(open_.empty(), "an element is not closed");
  }

  const std::vector<MarkupElement>& elements() const& { return elements_; }

  std::vector<MarkupElement> of_class(std::string_view name) const {
    std::vector<MarkupElement> found;
    for (const MarkupElement& element : elements_) {
      if (element.has_class(name)) found.push_back(element);
    }
    return found;
  }
  std::vector<MarkupElement> named(std::string_view name) const {
    std::vector<MarkupElement> found;
    for (const MarkupElement& element : elements_) {
      if (element.name == name) found.push_back(element);
    }
    return found;
  }

 private:
  static void check(bool is_right, const char* what) {
    if (!is_right) throw std::runtime_error(what);
  }

  std::string until(std::string_view ends, const char* what) {
    const std::size_t end = text_.find_first_of(ends, at_);
    check(end != std::string_view::npos, what);
    const std::string part(text_.substr(at_, end - at_));
    at_ = end;
    return part;
  }

  static std::string plain(std::string_view text) {
    static const std::map<std::string, std::string, std::less<>> known = {{"amp", "&"},   {"lt", "<"},  {"gt", ">"},
                                                                          {"quot", "\""}, {"#39", "'"}, {"ensp", " "}};
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const auto byte = static_cast<unsigned char>(text[i]);
      check(byte >= 0x20U || byte == '\n', "a control character");
      check(byte != 0x7FU && text[i] != '<', "a character that is not escaped");
      if (text[i] != '&') {
        result += text[i];
        continue;
      }
      const std::size_t end = text.find(';', i);
      check(end != std::string_view::npos, "an ampersand that is not escaped");
      const auto found = known.find(text.substr(i + 1, end - i - 1));
      check(found != known.end(), "an unknown reference");
      result += found->second;
      i = end;
    }
    return result;
  }

  void read_text() {
    const std::size_t end = std::min(text_.find('<', at_), text_.size());
    const std::string part = plain(text_.substr(at_, end - at_));
    for (const std::size_t element : open_) elements_[element].text += part;
    at_ = end;
  }

  void read_tag() {
    ++at_;
    if (text_.substr(at_).starts_with('/')) {
      ++at_;
      const std::string name = until(">", "a closing tag without end");
      ++at_;
      check(!open_.empty() && elements_[open_.back()].name == name, "a closing tag of another element");
      open_.pop_back();
      return;
    }
    MarkupElement element{until(" />", "a tag without end")};
    while (text_[at_] == ' ') read_attribute(element);
    const bool is_void = element.name == "meta" || element.name == "img" || text_[at_] == '/';
    if (text_[at_] == '/') ++at_;
    check(at_ < text_.size() && text_[at_] == '>', "a tag without end");
    ++at_;
    elements_.push_back(std::move(element));
    if (!is_void) open_.push_back(elements_.size() - 1);
  }

  void read_attribute(MarkupElement& element) {
    ++at_;
    const std::string name = until("=> ", "an attribute without value");
    check(text_.substr(at_).starts_with("=\""), "an attribute without quotes");
    at_ += 2;
    const std::string value = plain(until("\"", "an attribute without end"));
    ++at_;
    check(element.attributes.emplace(name, value).second, "an attribute twice");
    check(at_ < text_.size(), "a tag without end");
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<MarkupElement> elements_;
  std::vector<std::size_t> open_;
};

}  // namespace pliant_tests
