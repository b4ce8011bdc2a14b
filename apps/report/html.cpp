#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "report/html_parts.h"
#include "report/text.h"
#include "report/typeset.h"

namespace pliant_report {
namespace {

constexpr std::string_view summary_anchor = "summary";
constexpr std::string_view sources_anchor = "sources";

/// Texts may have several paragraphs, with an empty line between them.
std::string paragraphs(std::string_view text, std::string_view tag) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find("\n\n"), text.size());
    result += element(tag, text.substr(0, end));
    text.remove_prefix(std::min(end + 2, text.size()));
  }
  return result;
}

std::string facts_list(const Report& report) {
  if (report.facts.empty()) return "";
  std::string list = "<dl class=\"facts\">\n";
  for (const auto& [name, value] : report.facts) {
    list += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(name), escaped(value));
  }
  return list + "</dl>\n";
}

std::string contents(const Report& report, const std::vector<std::string>& names) {
  if (report.chapters.empty()) return "";
  std::string list = "<nav aria-label=\"Contents\">\n<h2 class=\"small\">Contents</h2>\n<ol>\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    list += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", names[i], escaped(report.chapters[i].title));
  }
  return list + "</ol>\n</nav>\n";
}

std::string summary_rows(const Chapter& chapter, std::size_t number, std::string_view anchor) {
  std::string rows =
      fmt::format("<tbody>\n<tr><th scope=\"rowgroup\" colspan=\"3\"><a href=\"#{}\">{}&ensp;{}</a></th></tr>\n",
                  anchor, number, escaped(chapter.title));
  for (const Claim& claim : chapter.claims) {
    rows += fmt::format("<tr><td class=\"judged\">{}</td><td>{}</td><td class=\"by\">{}</td></tr>\n",
                        badge(claim.verdict), escaped(claim.text), escaped(claim.by));
  }
  return rows + "</tbody>\n";
}

/// Of all claims; nothing where there are none.
std::string summary(const Report& report, const std::vector<std::string>& names) {
  std::vector<Claim> claims;
  std::string rows;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Chapter& chapter = report.chapters[i];
    claims.insert(claims.end(), chapter.claims.begin(), chapter.claims.end());
    if (!chapter.claims.empty()) rows += summary_rows(chapter, i + 1, names[i]);
  }
  if (claims.empty()) return "";
  std::string section = fmt::format("<section aria-labelledby=\"{0}\">\n<h2 id=\"{0}\">Summary</h2>\n", summary_anchor);
  section += element("p class=\"tally\"", tally(claims));
  section +=
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"All claims\">\n"
      "<table class=\"summary\">\n<thead><tr><th scope=\"col\">Verdict</th><th scope=\"col\">Claim</th>"
      "<th scope=\"col\">By</th></tr></thead>\n" +
      rows + "</table>\n</div>\n";
  return section + "</section>\n";
}

std::string sources_section(const Report& report) {
  if (report.sources.empty()) return "";
  std::string list =
      "<section class=\"chapter\" aria-labelledby=\"sources\">\n<h2 id=\"sources\">Sources</h2>\n<dl "
      "class=\"sources\">\n";
  for (const auto& [name, text] : report.sources) {
    list += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(text));
  }
  return list + "</dl>\n</section>\n";
}

}  // namespace

std::string element(std::string_view tag, std::string_view text) {
  if (text.empty()) return "";
  return fmt::format("<{}>{}</{}>\n", tag, escaped(text), tag.substr(0, tag.find(' ')));
}

std::string_view word(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::fails:
      return "does not hold";
    case Verdict::reported:
      break;
  }
  return "reported";
}

std::string badge(Verdict verdict) {
  struct Badge {
    std::string_view name;
    std::string_view shape;
  };
  constexpr std::array<Badge, 3> badges = {{
      {"holds", "<circle cx=\"8\" cy=\"8\" r=\"7\"/><path class=\"sign\" d=\"M4.6 8.3l2.4 2.5l4.4-5.2\"/>"},
      {"fails",
       "<path d=\"M8 .2l7.8 7.8l-7.8 7.8l-7.8-7.8z\"/><path class=\"sign\" d=\"M5.6 5.6l4.8 4.8m0-4.8l-4.8 4.8\"/>"},
      {"reported", "<circle class=\"ring\" cx=\"8\" cy=\"8\" r=\"5.5\"/>"},
  }};
  const Badge& shown = badges[verdict == Verdict::holds ? 0 : verdict == Verdict::fails ? 1 : 2];
  return fmt::format(
      "<span class=\"verdict {}\"><svg viewBox=\"0 0 16 16\" width=\"14\" height=\"14\" aria-hidden=\"true\">{}</svg>{}"
      "</span>",
      shown.name, shown.shape, word(verdict));
}

std::string tally(const std::vector<Claim>& claims) {
  const auto number = [&](Verdict verdict) {
    return std::count_if(claims.begin(), claims.end(), [=](const Claim& claim) { return claim.verdict == verdict; });
  };
  const auto holding = number(Verdict::holds);
  const auto failing = number(Verdict::fails);
  const auto reported = number(Verdict::reported);
  std::string text = fmt::format("{} claim{}", claims.size(), claims.size() == 1 ? "" : "s");
  std::string_view separator = ": ";
  const auto add = [&](const std::string& part) {
    text += fmt::format("{}{}", separator, part);
    separator = ", ";
  };
  if (holding > 0) add(fmt::format("{} {}", holding, holding == 1 ? "holds" : "hold"));
  if (failing > 0) add(fmt::format("{} {} not{}", failing, failing == 1 ? "does" : "do", holding > 0 ? "" : " hold"));
  if (reported > 0) add(fmt::format("{} only reported", reported));
  return text;
}

std::vector<std::string> anchors(const std::vector<Chapter>& chapters) {
  std::vector<std::string> result;
  for (const Chapter& chapter : chapters) {
    std::string name;
    for (const char c : chapter.name) {
      const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
      name += is_plain ? c : '-';
    }
    if (name.empty()) name = "chapter";
    std::string anchor = name;
    const auto is_taken = [&] {
      return anchor == summary_anchor || anchor == sources_anchor ||
             std::find(result.begin(), result.end(), anchor) != result.end();
    };
    for (int i = 2; is_taken(); ++i) anchor = fmt::format("{}-{}", name, i);
    result.push_back(std::move(anchor));
  }
  return result;
}

std::string to_html(const Report& given) {
  const Report report = with_powers(given);
  const std::vector<std::string> names = anchors(report.chapters);
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n"
      "<main>\n<header>\n<h1>{}</h1>\n",
      escaped(report.title), page_style(), escaped(report.title));
  page += paragraphs(report.introduction, "p class=\"introduction\"") + facts_list(report) + "</header>\n";
  page += contents(report, names) + summary(report, names);
  for (std::size_t i = 0; i < names.size(); ++i) page += chapter_section(report.chapters[i], i + 1, names[i]);
  page += sources_section(report);
  return page + "</main>\n</body>\n</html>\n";
}

}  // namespace pliant_report
