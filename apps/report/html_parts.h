#pragma once
// Parts of the page that to_html() is made of.
#include <string>
#include <string_view>
#include <vector>

#include "report/report.h"

namespace pliant_report {

/// The element with the text in it, escaped; nothing where the text is empty. `tag` may have attributes: "p class=..."
std::string element(std::string_view tag, std::string_view text);

/// "holds", "does not hold", "reported"
std::string_view word(Verdict verdict);

/// The verdict as a shape, a color and a word.
std::string badge(Verdict verdict);

/// "41 claims: 36 hold, 3 do not, 2 only reported"
std::string tally(const std::vector<Claim>& claims);

/// Anchors of the chapters: their names, made fit for links and different from each other.
std::vector<std::string> anchors(const std::vector<Chapter>& chapters);

/// A chapter with everything in it; `number` counts from 1.
std::string chapter_section(const Chapter& chapter, std::size_t number, std::string_view anchor);

/// The style sheet of the page, that of plots among it.
std::string page_style();

}  // namespace pliant_report
