#pragma once
// A window of the desktop with OpenGL in it, and what people do in it.
#include <array>
#include <string>
#include <vector>

#include "render/gl_objects.h"

struct GLFWwindow;

namespace pliant_viewer {

using pliant_render::Vec2f;

enum class MouseButton { left, right, middle };

/// In the order in which they happened, with the places at which they did.
struct MouseEvent {
  enum class Kind { press, release, move, wheel };
  Kind kind = Kind::move;
  MouseButton button = MouseButton::left;  ///< of press and release
  Vec2f place = {0, 0};                    ///< from the upper left corner, in the units of the window
  float wheel = 0;                         ///< notches, away from the user positive
  bool shift = false;
};

/// A key that was pressed, or is held and repeats itself.
struct KeyEvent {
  int key = 0;  ///< GLFW_KEY_...
  bool shift = false;
  bool control = false;
  bool is_repeated = false;
};

class Window {
 public:
  /// @throws pliant::Error (input): there is no display
  static void require_display();
  /// Opens a window of this size at most. Throws Error(input) where there is no display, or no OpenGL 3.3 in it.
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return window_; }
  bool wants_to_close() const;
  void close();

  Vec2f size() const;                           ///< in units of the mouse
  std::array<int, 2> framebuffer_size() const;  ///< in pixels; 0 while it is minimized
  float content_scale() const;                  ///< of letters, as the desktop is set
  bool is_visible() const;

  /// What the driver calls itself, and whether the processor draws.
  const std::string& driver() const { return driver_; }
  bool is_software() const;

  /// Waits until something happens, wake() is called or the time [s] is over.
  void wait(double seconds);
  /// Ends a wait; from any thread.
  static void wake();
  /// What has happened since the last call; `was_touched`: anything at all, as resizing.
  std::vector<MouseEvent> take_mouse_events();
  std::vector<KeyEvent> take_key_events();
  bool was_touched();
  void swap();

 private:
  void install_callbacks();

  GLFWwindow* window_ = nullptr;
  std::string driver_;
  std::vector<MouseEvent> mouse_;
  std::vector<KeyEvent> keys_;
  bool touched_ = true;
};

}  // namespace pliant_viewer
