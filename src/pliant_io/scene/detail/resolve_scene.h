#pragma once
// A scene as one document: its own text on those that it includes, with the values that were set over them.
#include <deque>

#include "pliant_io/scene/detail/json_node.h"
#include "pliant_io/scene/detail/scene_files.h"

namespace pliant {

struct ResolvedScene {
  std::deque<Origin> origins;  ///< of the document, which refers to them; each time a text is included it has its own
  Document document;
  std::vector<std::string> warnings = {};  ///< of keys that have their old names
};

/// Parses the first text of `source` and all that it includes. Texts that `source` does not have are read from their
/// files, or are built-in scenes, and are added to it.
/// @throws Error(input) as load_scene does, for all but the meaning of the values.
ResolvedScene resolve_scene(SceneSource& source, SceneFiles& files);

/// Refuses a version of the format that this program does not read; `root` is a whole text.
void check_scene_version(const Node& root);

}  // namespace pliant
