#include <string_view>

#include "report/html_parts.h"

namespace pliant_report {
namespace {

constexpr std::string_view html_rules = R"(:root {
  color-scheme: light dark;
  --ground: #ffffff; --text: #1f2429; --soft: #5a636d; --line: #dcdfe3; --panel: #f6f7f8; --link: #14509e;
  --holds: #12704f; --fails: #a83226; --reported: #5a636d;
}
@media screen and (prefers-color-scheme: dark) {
  .scroll { --shade: rgb(255 255 255 / .25); }
  :root {
    --ground: #15181c; --text: #e2e6ea; --soft: #a3abb4; --line: #333940; --panel: #1c2025; --link: #86b7f5;
    --holds: #55c99c; --fails: #ff8a78; --reported: #a3abb4;
  }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; text-size-adjust: 100%; scroll-padding-top: 1rem; }
body {
  margin: 0; background: var(--ground); color: var(--text); overflow-wrap: break-word;
  font: 1rem/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif;
}
main { max-width: 47.5rem; margin: 0 auto; padding: 2.5rem 1.25rem 4rem; }
h1 { font-size: 2rem; line-height: 1.2; letter-spacing: -0.012em; margin: 0 0 1rem; }
h2 { font-size: 1.375rem; line-height: 1.3; letter-spacing: -0.006em; margin: 0 0 0.75rem; text-wrap: balance; }
h2.small { font-size: 0.8125rem; letter-spacing: 0.04em; text-transform: uppercase; color: var(--soft); margin: 0 0 0.4rem; }
p { margin: 0 0 0.9rem; }
a { color: var(--link); text-decoration: none; }
a:hover { text-decoration: underline; }
a:focus-visible, .scroll:focus-visible { outline: 2px solid var(--link); outline-offset: 2px; }
.introduction { font-size: 1.0625rem; }
.facts { margin: 1.5rem 0 0; padding: 0.5rem 0; border: solid var(--line); border-width: 1px 0; font-size: 0.875rem; }
.facts div { display: flex; gap: 1rem; padding: 0.1rem 0; }
.facts dt { flex: 0 0 9rem; color: var(--soft); }
.facts dd { flex: 1; min-width: 0; margin: 0; }
nav { margin: 2rem 0; }
nav ol { margin: 0; padding: 0 0 0 1.6rem; columns: 2; column-gap: 2.5rem; }
nav li { padding: 0.1rem 0; break-inside: avoid; }
nav li::marker { color: var(--soft); font-variant-numeric: tabular-nums; }
.tally { font-size: 1.0625rem; font-weight: 600; }
.chapter { margin-top: 3.25rem; padding-top: 1.75rem; border-top: 1px solid var(--line); }
.anchor { color: inherit; }
.count { color: var(--soft); font-weight: 400; margin-right: 0.7em; }
.question { color: var(--soft); }
.verdict { white-space: nowrap; font-size: 0.875rem; font-weight: 600; }
.verdict svg { fill: currentColor; vertical-align: -0.14em; margin-right: 0.4em; }
.verdict .sign { fill: none; stroke: var(--ground); stroke-width: 1.8; stroke-linecap: round; stroke-linejoin: round; }
.verdict .ring { fill: none; stroke: currentColor; stroke-width: 2; }
.holds { color: var(--holds); }
.fails { color: var(--fails); }
.reported { color: var(--reported); }
.by { color: var(--soft); font-size: 0.875rem; }
.claims { list-style: none; margin: 1.25rem 0 1.75rem; padding: 0; border-bottom: 1px solid var(--line); }
.claims li { display: flex; gap: 1rem; padding: 0.6rem 0; border-top: 1px solid var(--line); break-inside: avoid; }
.claims li { align-items: baseline; }
.claims .judged { flex: 0 0 8.25rem; }
.claims .judged + div { flex: 1; min-width: 0; }
.claims p { margin: 0; }
.claims .by::before { content: "— "; }
.claims .evidence { color: var(--soft); font-size: 0.9375rem; margin-top: 0.15rem; }
.scroll {
  overflow-x: auto; --shade: rgb(31 36 41 / .28);
  background:
    linear-gradient(to right, var(--ground) 45%, transparent) left / 2.5rem 100% no-repeat local,
    linear-gradient(to left, var(--ground) 45%, transparent) right / 2.5rem 100% no-repeat local,
    linear-gradient(to right, var(--shade), transparent) left / .9rem 100% no-repeat scroll,
    linear-gradient(to left, var(--shade), transparent) right / .9rem 100% no-repeat scroll;
}
.sideways { color: var(--soft); font-size: 0.8125rem; margin: 0 0 0.3rem; }
table { border-collapse: collapse; font-size: 0.875rem; line-height: 1.45; min-width: 100%; }
th, td { padding: 0.35rem 0.75rem; text-align: left; vertical-align: baseline; border-bottom: 1px solid var(--line); }
th:first-child, td:first-child { padding-left: 0.25rem; }
th:last-child, td:last-child { padding-right: 0.25rem; }
th { font-weight: 600; }
thead th { border-top: 1px solid var(--soft); border-bottom: 1px solid var(--soft); }
tbody:last-child tr:last-child td { border-bottom-color: var(--soft); }
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
th.number { white-space: normal; }
.summary [scope=rowgroup] { padding-top: 1.1rem; }
.summary .judged { width: 8.5rem; }
.summary .by { width: 10rem; }
figure { margin: 1.75rem 0; break-inside: avoid; }
figcaption { font-size: 0.875rem; line-height: 1.45; color: var(--soft); margin-top: 0.4rem; max-width: 42rem; }
figcaption b { color: var(--text); }
.table figcaption { margin: 0 0 0.5rem; }
figure .plot { display: block; width: 100.94%; height: auto; min-width: 30rem; margin-left: -0.94%; }
img { display: block; max-width: 100%; height: auto; border-radius: 3px; }
@media screen and (prefers-color-scheme: dark) { img { filter: brightness(.8); } }
.picture img { width: 100%; }
@media screen and (min-width: 60rem) {
  .picture { width: min(calc(100vw - 3rem), 76rem); margin-left: calc(50% - min(calc(50vw - 1.5rem), 38rem)); }
  .picture figcaption { margin-left: auto; margin-right: auto; }
}
.sources dt { font-weight: 600; margin-top: 0.6rem; }
.sources dd { margin: 0; }
.took { color: var(--soft); font-size: 0.8125rem; margin: 1.5rem 0 0; }
@media (max-width: 36rem) {
  main { padding: 1.5rem 1rem 3rem; }
  h1 { font-size: 1.625rem; }
  nav ol { columns: 1; }
  .facts div, .claims li { display: block; }
  .summary .judged, .summary .by { width: auto; }
  figure .plot { width: 100%; margin-left: 0; }
}
@media print {
  @page { margin: 18mm 17mm; }
  body { font-size: 10pt; }
  main { max-width: none; padding: 0; }
  a { color: inherit; text-decoration: none; }
  h1, h2, .table figcaption, .question { break-after: avoid; }
  p { orphans: 3; widows: 3; }
  .chapter { margin-top: 2rem; padding-top: 1rem; }
  tr, .question { break-inside: avoid; }
  thead { display: table-header-group; }
  .scroll { overflow: visible; background: none; }
  .sideways { display: none !important; }
  figure .plot { min-width: 0; width: 150mm; margin-left: -1.4mm; }
  img { max-height: 120mm; width: auto; }
  .verdict, .verdict svg { print-color-adjust: exact; }
}
)";

}  // namespace

std::string page_style() {
  return std::string(html_rules) + plot_style();
}

}  // namespace pliant_report
