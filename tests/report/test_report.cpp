#include <algorithm>
#include <limits>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "pliant_io/files/base64.h"
#include "report/report.h"
#include "tests/report/markup.h"

namespace test_report {

using namespace pliant_report;
using namespace pliant_tests;
using Json = nlohmann::json;

namespace {

Plot line_plot(std::string caption) {
  return {"speed", std::move(caption), {"time [s]"}, {"speed [m/s]"}, {{"measured", {0, 1, 2}, {3, 4, 5}}}};
}

Report small_report() {
  Report report{"Experiments", "First.\n\nSecond."};
  report.facts = {{"machine", "a small one"}, {"date", "2024-05-06"}};
  Chapter damping{"damping", "Damping by iterations", "Does it hang still?"};
  damping.claims = {{"More iterations damp less", "thesis, Sec. 6.2", Verdict::holds, "222 and 284 m/s"},
                    {"Ten are enough", "paper", Verdict::fails, "they are not"},
                    {"Time of a step", "", Verdict::reported, "3 ms"}};
  damping.blocks = {Paragraph{"What was seen."},
                    line_plot("speeds over time"),
                    Table{"steps", {"scene", "time [ms]"}, {{"curtain", "1.5"}, {"rope", "−0.25e-3"}, {"none", "—"}}},
                    Picture{"the curtain", "\x89PNG", 8, 4},
                    Table{"more", {}, {{"a", "b", "c"}}},
                    line_plot("")};
  damping.seconds = 12.3;
  Chapter cost{"cost", "Cost", ""};
  cost.claims = {{"The local step is cheap", "paper", Verdict::holds, ""}};
  cost.blocks = {line_plot("costs")};
  report.chapters = {damping, cost};
  return report;
}

std::vector<std::string> texts(const std::vector<MarkupElement>& elements) {
  std::vector<std::string> result;
  for (const MarkupElement& element : elements) result.push_back(element.text);
  return result;
}

using Texts = std::vector<std::string>;

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

/// Every text that a report takes is this one.
Report report_of(const std::string& text) {
  Plot plot{text, text, {text}, {text}, {{text, {1, 2}, {1, 2}}}, {{1.5, text}}};
  Chapter chapter{text, text, text, {{text, text, Verdict::fails, text}}, {}, 1};
  chapter.blocks = {Paragraph{text}, plot, Table{text, {text}, {{text}}}, Picture{text, text, 1, 1}};
  return {text, text, {{text, text}}, {chapter, chapter}};
}

}  // namespace

TEST_CASE("the page tells its claims by verdict, in the summary and in their chapters") {
  const Report report = small_report();
  CHECK(count(report, Verdict::holds) == 2);
  CHECK(count(report, Verdict::fails) == 1);
  CHECK(count(report, Verdict::reported) == 1);
  const Markup page(to_html(report));
  CHECK(texts(page.of_class("tally")) == Texts{"4 claims: 2 hold, 1 does not, 1 only reported"});
  const std::vector<MarkupElement> verdicts = page.of_class("verdict");
  CHECK(texts(verdicts) == Texts{"holds", "does not hold", "reported", "holds",  // in the summary
                                 "holds", "does not hold", "reported", "holds"});
  CHECK(verdicts[0].has_class("holds"));
  CHECK(verdicts[1].has_class("fails"));
  CHECK(verdicts[2].has_class("reported"));
  const std::string summary = page.of_class("summary").front().text;
  for (const Chapter& chapter : report.chapters) {
    CHECK(summary.find(chapter.title) != std::string::npos);
    for (const Claim& claim : chapter.claims) {
      CHECK(summary.find(claim.text) != std::string::npos);
      CHECK(summary.find(claim.by) != std::string::npos);
    }
  }
  CHECK(texts(page.of_class("evidence")) == Texts{"222 and 284 m/s", "they are not", "3 ms"});
}

TEST_CASE("the summary's sentence has the number that it needs") {
  const auto tally = [](std::vector<Verdict> verdicts) {
    Report report{"", "", {}, {{"a", "A"}}};
    for (const Verdict verdict : verdicts) report.chapters[0].claims.push_back({"claim", "", verdict, ""});
    const std::vector<MarkupElement> found = Markup(to_html(report)).of_class("tally");
    return found.empty() ? std::string("(none)") : found.front().text;
  };
  CHECK(tally({}) == "(none)");
  CHECK(tally({Verdict::holds}) == "1 claim: 1 holds");
  CHECK(tally({Verdict::fails}) == "1 claim: 1 does not hold");
  CHECK(tally({Verdict::fails, Verdict::fails, Verdict::reported}) == "3 claims: 2 do not hold, 1 only reported");
  CHECK(tally({Verdict::holds, Verdict::fails, Verdict::fails}) == "3 claims: 1 holds, 2 do not");
}

TEST_CASE("chapters stand in order, with their blocks numbered, their links and their time") {
  const Report report = small_report();
  const std::string html = to_html(report);
  const Markup page(html);
  CHECK(texts(page.named("h1")) == Texts{"Experiments"});
  CHECK(texts(page.named("dd")) == Texts{"a small one", "2024-05-06"});
  CHECK(texts(page.of_class("introduction")) == Texts{"First.", "Second."});
  CHECK(texts(page.of_class("chapter")).size() == 2);
  CHECK(texts(page.of_class("took")) == Texts{"This chapter took 12 s."});
  CHECK(texts(page.named("figcaption")) == Texts{"Figure 1.1 — speeds over time", "Table 1.1 — steps",
                                                 "Figure 1.2 — the curtain", "Table 1.2 — more", "Figure 1.3",
                                                 "Figure 2.1 — costs"});
  Texts anchors;
  for (const MarkupElement& element : page.elements()) anchors.push_back(element.attribute("id"));
  for (const MarkupElement& link : page.named("a")) {
    REQUIRE(link.attribute("href").starts_with('#'));
    CHECK(std::count(anchors.begin(), anchors.end(), link.attribute("href").substr(1)) == 1);
  }
  CHECK(page.named("nav").front().text.find("Damping by iterations") != std::string::npos);
  CHECK(html.find("id=\"damping\"") != std::string::npos);
}

TEST_CASE("a picture is in the page, with its words and its size") {
  const Report report = small_report();
  const std::vector<MarkupElement> pictures = Markup(to_html(report)).named("img");
  REQUIRE(pictures.size() == 1);
  CHECK(pictures[0].attribute("src") == "data:image/png;base64," + pliant::base64("\x89PNG"));
  CHECK(pictures[0].attribute("alt") == "the curtain");
  CHECK(pictures[0].attribute("width") == "8");
  CHECK(pictures[0].attribute("height") == "4");
}

TEST_CASE("columns of numbers stand to the right, those with texts to the left") {
  const auto is_right = [](const std::vector<std::string>& cells) {
    Table table{"", {"head"}, {}};
    for (const std::string& cell : cells) table.rows.push_back({cell});
    Report report{"", "", {}, {{"a", "A", "", {}, {table}}}};
    return !Markup(to_html(report)).of_class("number").empty();
  };
  CHECK(is_right({"1", "−2.5", "1.2e-05", "3×10⁻⁷", "≈ 40 %", "2.1 ± 0.2", "12 288", "—", ""}));
  CHECK(is_right({"nan", "−inf", "3"}));
  CHECK_FALSE(is_right({"1", "two"}));
  CHECK_FALSE(is_right({"3D", "2D"}));
  CHECK_FALSE(is_right({"—", ""}));
  CHECK_FALSE(is_right({"e", "ä"}));
}

TEST_CASE("the page asks for nothing outside of itself and needs no script") {
  const std::string html = to_html(small_report());
  const Markup page(html);
  CHECK(html.find("http") == std::string::npos);
  CHECK(html.find("url(") == std::string::npos);
  CHECK(html.find("@import") == std::string::npos);
  for (const MarkupElement& element : page.elements()) {
    CHECK((element.name != "script" && element.name != "link" && element.name != "iframe"));
    for (const auto& attribute : element.attributes) {
      CHECK(!attribute.first.starts_with("on"));
      if (attribute.first == "src") CHECK(attribute.second.starts_with("data:"));
      if (attribute.first == "href") CHECK(attribute.second.starts_with("#"));
    }
  }
  CHECK(page.named("html").front().attribute("lang") == "en");
  CHECK(html.find("<meta charset=\"utf-8\">") != std::string::npos);
  CHECK(html.find("@media print") != std::string::npos);
  CHECK(html.find("prefers-color-scheme: dark") != std::string::npos);
}

TEST_CASE("every text in the page is escaped, wherever it stands") {
  const std::string nasty = "</title></style><script>alert(1)</script>&\"'\x07\xff";
  const std::string clean = "</title></style><script>alert(1)</script>&\"' ?";
  const Report report = report_of(nasty);
  const std::string html = to_html(report);
  const Markup page(html);
  CHECK(page.named("script").empty());
  CHECK(count_of(html, "<script") == 0);
  CHECK(page.named("h1").front().text == clean);
  CHECK(page.named("dt").front().text == clean);
  CHECK(page.named("dd").front().text == clean);
  CHECK(page.of_class("question").front().text == clean);
  CHECK(page.of_class("evidence").front().text == clean);
  CHECK(page.of_class("by").front().text == clean);
  CHECK(page.named("td").back().text == clean);
  CHECK(page.named("img").front().attribute("alt") == clean);
  CHECK(page.named("figcaption").front().text == "Figure 1.1 — " + clean);
}

TEST_CASE("chapters of the same name, or of none, have links of their own") {
  Report report{"", "", {}, {{"a", "1"}, {"a", "2"}, {"", "3"}, {"summary", "4"}, {"ä b", "5"}, {"a-2", "6"}}};
  report.chapters[0].claims.push_back({"claim"});  // without any there is no summary
  std::vector<std::string> anchors;
  const Markup page(to_html(report));
  for (const MarkupElement& element : page.elements()) {
    if (!element.attribute("id").empty()) anchors.push_back(element.attribute("id"));
  }
  CHECK(anchors == Texts{"summary", "a", "a-2", "chapter", "summary-2", "---b", "a-2-2"});
}

TEST_CASE("a report without anything is a page, and JSON") {
  CHECK_NOTHROW(Markup(to_html({})));
  const Json json = Json::parse(to_json({}));
  CHECK(json["title"] == "");
  CHECK(json["facts"] == Json::object());
  CHECK(json["chapters"] == Json::array());
}

TEST_CASE("JSON has the data of the report") {
  Report report = small_report();
  Plot& plot = std::get<Plot>(report.chapters[0].blocks[1]);
  plot.series[0].y[1] = std::numeric_limits<double>::quiet_NaN();
  plot.series[0].y[2] = -std::numeric_limits<double>::infinity();
  plot.guides = {{2.5, "middle", true}};
  plot.x.is_logarithmic = true;
  plot.x.max = 9;
  const std::string text = to_json(report);
  CHECK(text.starts_with("{\n  \"title\": \"Experiments\",\n"));
  const Json json = Json::parse(text);
  CHECK(json["introduction"] == "First.\n\nSecond.");
  CHECK(json["facts"] == Json{{"machine", "a small one"}, {"date", "2024-05-06"}});
  REQUIRE(json["chapters"].size() == 2);
  const Json& chapter = json["chapters"][0];
  CHECK(chapter["name"] == "damping");
  CHECK(chapter["title"] == "Damping by iterations");
  CHECK(chapter["question"] == "Does it hang still?");
  CHECK(chapter["seconds"] == 12.3);
  CHECK(chapter["claims"].size() == 3);
  CHECK(chapter["claims"][1] ==
        Json{{"text", "Ten are enough"}, {"by", "paper"}, {"verdict", "does not hold"}, {"evidence", "they are not"}});
  CHECK(chapter["claims"][0]["verdict"] == "holds");
  CHECK(chapter["claims"][2]["verdict"] == "reported");
  CHECK(chapter["paragraphs"] == Json::array({"What was seen."}));
  REQUIRE(chapter["plots"].size() == 2);
  const Json& first = chapter["plots"][0];
  CHECK(first["title"] == "speed");
  CHECK(first["caption"] == "speeds over time");
  CHECK(first["x"] == Json{{"label", "time [s]"}, {"logarithmic", true}, {"max", 9.0}});
  CHECK(first["y"] == Json{{"label", "speed [m/s]"}, {"logarithmic", false}});
  CHECK(first["series"][0]["name"] == "measured");
  CHECK(first["series"][0]["x"] == Json::array({0.0, 1.0, 2.0}));
  CHECK(first["series"][0]["y"] == Json::array({3.0, nullptr, nullptr}));
  CHECK(first["guides"][0] == Json{{"value", 2.5}, {"label", "middle"}, {"axis", "x"}});
  CHECK(chapter["tables"][0]["columns"] == Json::array({"scene", "time [ms]"}));
  CHECK(chapter["tables"][0]["rows"][1] == Json::array({"rope", "−0.25e-3"}));
  CHECK(chapter["pictures"] == Json::array({Json{{"caption", "the curtain"}, {"width", 8}, {"height", 4}}}));
}

TEST_CASE("JSON takes texts that are not UTF-8 and times that are not finite") {
  Report report = report_of("a\xff");
  report.chapters[0].seconds = std::numeric_limits<double>::infinity();
  const Json json = Json::parse(to_json(report));
  CHECK(json["title"] == "a\uFFFD");
  CHECK(json["facts"]["a\uFFFD"] == "a\uFFFD");
  CHECK(json["chapters"][0]["seconds"].is_null());
  CHECK(json["chapters"][1]["seconds"] == 1.0);
  CHECK(Markup(to_html(report)).of_class("took").size() == 1);
}

}  // namespace test_report
