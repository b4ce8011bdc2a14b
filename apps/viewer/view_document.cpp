#include "viewer/view_document.h"

#include "viewer/json_of.h"

namespace pliant_viewer {

void write_view(const pliant::ViewSettings& view, pliant::SceneDocument& document) {
  const Json changed = json_of(view);
  const Json all = all_options(view);
  for (const auto& [name, value] : all.items()) {
    const std::string path = "view." + name;
    if (value.is_null() || (value.is_object() && value.empty())) {
      document.remove(path);
    } else if (changed.contains(name) || !document.get(path).empty()) {
      document.set(path, value.dump());
    }
  }
}

}  // namespace pliant_viewer
