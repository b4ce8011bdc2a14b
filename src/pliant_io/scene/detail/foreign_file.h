#pragma once
#include <filesystem>
#include <string_view>

namespace pliant {

/// Refuses what is given for a scene and is another kind of file: a picture, a document, a text. One that ends in
/// `.json` or begins as JSON is left to the parser, which tells the line of a slip. Throws Error(input) that says what
/// the file looks like, and which can be opened.
void refuse_foreign_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace pliant
