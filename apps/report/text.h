#pragma once
// Text in pages and figures: any bytes made harmless, and how wide they will be.
#include <string>
#include <string_view>
#include <vector>

namespace pliant_report {

/// The text for XML and HTML, between tags and in quoted attributes: control characters become blanks, what XML does
/// not know becomes '?', and the characters of markup become references.
std::string escaped(std::string_view text);

/// How wide the text will be [units] in a sans-serif face of 13 units: an estimate for faces that are not known here,
/// rather too wide than too narrow. Bold letters are taken to be 8 % wider.
double text_width(std::string_view text, bool is_bold = false);

/// The text in lines of at most this width [units], broken at blanks; a word that is wider is cut. At least one line.
std::vector<std::string> wrapped(std::string_view text, double width, bool is_bold = false);

/// The text, or as much of its start as has room in this width [units] together with "…".
std::string shortened(std::string_view text, double width);

}  // namespace pliant_report
