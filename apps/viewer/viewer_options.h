#pragma once
// What the window is opened with.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pliant_io/scene/view_settings.h"
#include "render/image.h"
#include "viewer/panels/scene_panel.h"

namespace pliant_viewer {

struct ViewerOptions {
  pliant::ViewSettings appearance;  ///< initial appearance; its size is ignored in favor of the window's
  std::optional<int> samples{};     ///< per pixel; default: 4 on a graphics card, 1 where the processor draws
  std::filesystem::path picture_folder = ".";  ///< where pictures and scenes are saved
  /// Opens what was dropped onto the window, typed, or chosen, a file, a folder of a run or the name of a scene, to be
  /// shown once run() has returned; returns "", or what is wrong with it. None: nothing can be opened.
  std::function<std::string(const std::string&)> open = {};
  /// Told of every scene and session that was saved, on the thread of the scene.
  std::function<void(const std::filesystem::path&)> saved = {};
  std::vector<OpenableScene> scenes = {};  ///< to choose from
  bool chooses_scene = false;              ///< begin with the list of them
  std::string greeting = {};               ///< shown at first
  /// Told how the scene looked, as large as a recent picture, when run() ends.
  std::function<void(const pliant_render::Image&)> looked = {};
  std::filesystem::path settings_file = {};  ///< of the window, see window_settings.h; none: they are kept nowhere
};

}  // namespace pliant_viewer
