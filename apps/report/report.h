#pragma once
// A report: chapters of text, claims, plots, pictures and tables, as one page of HTML and as JSON.
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "report/plot.h"

namespace pliant_report {

/// `reported`: measured, and there is nothing that it should have been.
enum class Verdict { holds, fails, reported };

/// Something that was said, and what was measured of it.
struct Claim {
  std::string text;  ///< "More iterations damp less"
  std::string by{};  ///< who says so: "thesis, Sec. 6.2"
  Verdict verdict = Verdict::reported;
  std::string evidence{};  ///< the figures behind the verdict: "222, 283 and 284 m/s"
};

struct Paragraph {
  std::string text;
};

/// Cells as they are to be read. Numbers stand to the right, texts to the left.
struct Table {
  std::string caption;
  std::vector<std::string> columns;  ///< with units
  std::vector<std::vector<std::string>> rows{};
};

struct Picture {
  std::string caption;
  std::string png;  ///< the file's bytes
  int width = 0;    ///< [pixels]
  int height = 0;
};

using Block = std::variant<Paragraph, Plot, Table, Picture>;

struct Chapter {
  std::string name;        ///< short, of letters and dashes: "damping"; its anchor in the page
  std::string title;       ///< "Damping by the number of iterations"
  std::string question{};  ///< what is tried, how, and what is measured: one or a few sentences
  std::vector<Claim> claims{};
  std::vector<Block> blocks{};
  double seconds = 0;  ///< that it took
};

struct Report {
  std::string title;
  std::string introduction{};
  std::vector<std::pair<std::string, std::string>> facts{};  ///< machine, versions, date: name and value
  std::vector<Chapter> chapters{};
  /// What claims and figures refer to: how they call it, and what it is.
  std::vector<std::pair<std::string, std::string>> sources{};
};

/// How many claims of a report have this verdict.
int count(const Report& report, Verdict verdict);

/// One page with everything in it: it asks for no other file, works without a network, prints, and follows the
/// reader's light or dark scheme. First the facts and a table of all claims with links, then the chapters.
std::string to_html(const Report& report);

/// A file of its own for every figure and table of a report.
struct FigureFile {
  std::string name;  ///< "damping-2.svg" is Figure 4.2 where damping is the fourth chapter
  std::string content;
};

/// Plots as SVG with their numbers as CSV, pictures as PNG; tables as CSV: "damping-table-1.csv".
std::vector<FigureFile> figure_files(const Report& report);

/// The same as data: facts, chapters, claims, series of plots, tables; pictures by caption and size alone.
std::string to_json(const Report& report);

}  // namespace pliant_report
