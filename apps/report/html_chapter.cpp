#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pliant_io/files/base64.h"
#include "report/html_parts.h"
#include "report/text.h"

namespace pliant_report {
namespace {

bool is_blank(std::string_view cell) {
  return cell.empty() || cell == "-" || cell == "–" || cell == "—" || cell == "−";
}

/// Whether a cell is a number as people write it: "−3.1", "1.2e-05", "≈ 40 %", "3×10⁻⁷", "2.1 ± 0.2".
bool is_number(std::string_view cell) {
  constexpr std::string_view words[] = {"nan", "inf", "-inf", "−inf", "∞", "−∞"};
  if (std::find(std::begin(words), std::end(words), cell) != std::end(words)) return true;
  bool has_digit = false;
  bool is_all_known = true;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const char c = cell[i];
    const bool is_digit = c >= '0' && c <= '9';
    const bool is_exponent = (c == 'e' || c == 'E') && has_digit && i + 1 < cell.size();
    // Bytes over 0x7F are those of signs such as − and ×; letters with accents would stand beside plain ones.
    const bool is_sign = std::string_view(" .,+-<>=~%").find(c) != std::string_view::npos || (c & 0x80) != 0;
    has_digit = has_digit || is_digit;
    is_all_known = is_all_known && (is_digit || is_exponent || is_sign);
  }
  return has_digit && is_all_known;
}

std::vector<bool> numeric_columns(const Table& table, std::size_t count) {
  std::vector<bool> is_numeric(count, false);
  for (std::size_t column = 0; column < count; ++column) {
    bool has_number = false;
    bool has_text = false;
    for (const std::vector<std::string>& row : table.rows) {
      if (column >= row.size() || is_blank(row[column])) continue;
      (is_number(row[column]) ? has_number : has_text) = true;
    }
    is_numeric[column] = has_number && !has_text;
  }
  return is_numeric;
}

double longest_word(std::string_view text) {
  double longest = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    longest = std::max(longest, text_width(std::string(text.substr(0, end))));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return longest;
}

/// Whether it cannot be squeezed into the page, by the widths of its longest words and its numbers.
bool is_wider_than_page(const Table& table) {
  constexpr double room = 720;
  constexpr double padding = 24;
  const std::vector<bool> is_numeric = numeric_columns(table, table.columns.size());
  double sum = 0;
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    double widest = longest_word(table.columns[column]);
    for (const std::vector<std::string>& row : table.rows) {
      if (column >= row.size()) continue;
      widest = std::max(widest, is_numeric[column] ? text_width(row[column]) : longest_word(row[column]));
    }
    sum += widest + padding;
  }
  return sum > room;
}

std::string table_element(const Table& table) {
  std::size_t count = table.columns.size();
  for (const std::vector<std::string>& row : table.rows) count = std::max(count, row.size());
  const std::vector<bool> is_numeric = numeric_columns(table, count);
  const auto line = [&](const std::vector<std::string>& cells, std::string_view tag) {
    std::string result = "<tr>";
    for (std::size_t i = 0; i < count; ++i) {
      result += fmt::format("<{}{}>{}</{}>", tag, is_numeric[i] ? " class=\"number\"" : "",
                            i < cells.size() ? escaped(cells[i]) : "", tag.substr(0, 2));
    }
    return result + "</tr>\n";
  };
  std::string result = "<table>\n";
  if (!table.columns.empty()) result += "<thead>\n" + line(table.columns, "th scope=\"col\"") + "</thead>\n";
  result += "<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) result += line(row, "td");
  return result + "</tbody>\n</table>\n";
}

std::string caption(std::string_view tag, std::string_view what, std::size_t chapter, int number,
                    std::string_view text) {
  return fmt::format("<{0}><b>{1} {2}.{3}</b>{4}{5}</{0}>\n", tag, what, chapter, number, text.empty() ? "" : " — ",
                     escaped(text));
}

/// Figures and tables of a chapter, each with a number of its own.
class Blocks {
 public:
  explicit Blocks(std::size_t chapter) : chapter_(chapter) {}

  std::string operator()(const Paragraph& paragraph) { return element("p", paragraph.text); }

  std::string operator()(const Plot& plot) {
    return fmt::format("<figure>\n<div class=\"scroll\">\n{}</div>\n{}</figure>\n", to_svg(plot, false),
                       caption("figcaption", "Figure", chapter_, ++figures_, plot.caption));
  }

  std::string operator()(const Picture& picture) {
    const std::string size = picture.width > 0 && picture.height > 0
                                 ? fmt::format(" width=\"{}\" height=\"{}\"", picture.width, picture.height)
                                 : std::string();
    return fmt::format("<figure class=\"picture\">\n<img src=\"data:image/png;base64,{}\" alt=\"{}\"{}>\n{}</figure>\n",
                       pliant::base64(picture.png), escaped(picture.caption), size,
                       caption("figcaption", "Figure", chapter_, ++figures_, picture.caption));
  }

  std::string operator()(const Table& table) {
    ++tables_;
    return fmt::format(
        "<figure class=\"table\">\n{}{}<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Table "
        "{}.{}\">\n"
        "{}</div>\n</figure>\n",
        caption("figcaption", "Table", chapter_, tables_, table.caption),
        is_wider_than_page(table) ? "<p class=\"sideways\">→ wider than the page: it scrolls sideways</p>\n" : "",
        chapter_, tables_, table_element(table));
  }

 private:
  std::size_t chapter_;
  int figures_ = 0;
  int tables_ = 0;
};

std::string claim_list(const std::vector<Claim>& claims) {
  if (claims.empty()) return "";
  std::string list = "<ul class=\"claims\">\n";
  for (const Claim& claim : claims) {
    list += fmt::format("<li>\n<div class=\"judged\">{}</div>\n<div>\n<p>{}{}</p>\n", badge(claim.verdict),
                        escaped(claim.text),
                        claim.by.empty() ? "" : fmt::format(" <span class=\"by\">{}</span>", escaped(claim.by)));
    list += element("p class=\"evidence\"", claim.evidence) + "</div>\n</li>\n";
  }
  return list + "</ul>\n";
}

std::string duration(double seconds) {
  if (!std::isfinite(seconds) || seconds <= 0) return "";
  if (seconds < 9.95) return fmt::format("{:.1f} s", std::max(seconds, 0.1));
  if (seconds < 119.5) return fmt::format("{:.0f} s", seconds);
  const double minutes = std::round(seconds / 60);
  if (minutes < 120) return fmt::format("{:.0f} min", minutes);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

std::string chapter_section(const Chapter& chapter, std::size_t number, std::string_view anchor) {
  std::string section = fmt::format(
      "<section class=\"chapter\" aria-labelledby=\"{0}\">\n"
      "<h2 id=\"{0}\"><a class=\"anchor\" href=\"#{0}\"><span class=\"count\">{1}</span>{2}</a></h2>\n",
      anchor, number, escaped(chapter.title));
  section += element("p class=\"question\"", chapter.question) + claim_list(chapter.claims);
  Blocks blocks(number);
  for (const Block& block : chapter.blocks) section += std::visit(blocks, block);
  const std::string time = duration(chapter.seconds);
  if (!time.empty()) section += fmt::format("<p class=\"took\">This chapter took {}.</p>\n", time);
  return section + "</section>\n";
}

}  // namespace pliant_report
