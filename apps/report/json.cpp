#include <cmath>

#include <nlohmann/json.hpp>

#include "report/html_parts.h"
#include "report/report.h"

namespace pliant_report {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// JSON has no number that is not finite.
OrderedJson number(double value) {
  return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}

OrderedJson numbers(const std::vector<double>& values) {
  OrderedJson list = OrderedJson::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

OrderedJson axis_json(const Axis& axis) {
  OrderedJson json = {{"label", axis.label}, {"logarithmic", axis.is_logarithmic}};
  if (axis.min) json["min"] = number(*axis.min);
  if (axis.max) json["max"] = number(*axis.max);
  return json;
}

OrderedJson plot_json(const Plot& plot) {
  OrderedJson series = OrderedJson::array();
  for (const Series& each : plot.series) {
    series.push_back({{"name", each.name}, {"x", numbers(each.x)}, {"y", numbers(each.y)}});
    if (each.low.empty() || each.high.empty()) continue;
    series.back()["low"] = numbers(each.low);
    series.back()["high"] = numbers(each.high);
  }
  OrderedJson guides = OrderedJson::array();
  for (const Guide& guide : plot.guides) {
    guides.push_back({{"value", number(guide.value)}, {"label", guide.label}, {"axis", guide.is_vertical ? "x" : "y"}});
  }
  return {{"title", plot.title},    {"caption", plot.caption}, {"x", axis_json(plot.x)},
          {"y", axis_json(plot.y)}, {"series", series},        {"guides", guides}};
}

OrderedJson claims_json(const std::vector<Claim>& claims) {
  OrderedJson list = OrderedJson::array();
  for (const Claim& claim : claims) {
    list.push_back(
        {{"text", claim.text}, {"by", claim.by}, {"verdict", word(claim.verdict)}, {"evidence", claim.evidence}});
  }
  return list;
}

/// Sorts the blocks of a chapter by what they are.
struct JsonBlocks {
  OrderedJson paragraphs = OrderedJson::array();
  OrderedJson plots = OrderedJson::array();
  OrderedJson tables = OrderedJson::array();
  OrderedJson pictures = OrderedJson::array();

  void operator()(const Paragraph& paragraph) { paragraphs.push_back(paragraph.text); }
  void operator()(const Plot& plot) { plots.push_back(plot_json(plot)); }
  void operator()(const Table& table) {
    tables.push_back({{"caption", table.caption}, {"columns", table.columns}, {"rows", table.rows}});
  }
  void operator()(const Picture& picture) {
    pictures.push_back({{"caption", picture.caption}, {"width", picture.width}, {"height", picture.height}});
  }
};

OrderedJson chapter_json(const Chapter& chapter) {
  JsonBlocks blocks;
  for (const Block& block : chapter.blocks) std::visit(blocks, block);
  return {{"name", chapter.name},
          {"title", chapter.title},
          {"question", chapter.question},
          {"seconds", number(chapter.seconds)},
          {"claims", claims_json(chapter.claims)},
          {"paragraphs", std::move(blocks.paragraphs)},
          {"plots", std::move(blocks.plots)},
          {"tables", std::move(blocks.tables)},
          {"pictures", std::move(blocks.pictures)}};
}

}  // namespace

std::string to_json(const Report& report) {
  OrderedJson facts = OrderedJson::object();
  for (const auto& [name, value] : report.facts) facts[name] = value;
  OrderedJson chapters = OrderedJson::array();
  for (const Chapter& chapter : report.chapters) chapters.push_back(chapter_json(chapter));
  OrderedJson sources = OrderedJson::object();
  for (const auto& [name, text] : report.sources) sources[name] = text;
  const OrderedJson json = {{"title", report.title},
                            {"introduction", report.introduction},
                            {"facts", std::move(facts)},
                            {"sources", std::move(sources)},
                            {"chapters", std::move(chapters)}};
  // Texts may hold bytes that are not UTF-8; they must not cost the report.
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + '\n';
}

}  // namespace pliant_report
