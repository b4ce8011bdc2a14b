#pragma once
// A desktop window with OpenGL, and the input events it receives.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "render/gl_objects.h"

struct GLFWwindow;

namespace pliant_viewer {

using pliant_render::Vec2f;

enum class MouseButton { left, right, middle };

/// Mouse events come in the order in which they happened, each with its place.
struct MouseEvent {
  enum class Kind { press, release, move, wheel };
  Kind kind = Kind::move;
  MouseButton button = MouseButton::left;  ///< for press and release
  Vec2f place = {0, 0};                    ///< from the upper left corner, in window units
  float wheel = 0;                         ///< notches, positive away from the user
  bool shift = false;
  bool control = false;
};

/// What happened at the keyboard, in the order in which it did. A key that writes something is followed by a character.
struct KeyEvent {
  enum class Kind { press, repeat, release, character };
  Kind kind = Kind::press;
  int key = 0;                 ///< GLFW_KEY_..., unless it is a character
  int scancode = 0;            ///< of the key, as GLFW gives it
  int modifiers = 0;           ///< GLFW_MOD_... that were down
  unsigned int character = 0;  ///< its code point
};

/// How many threads a simulation has beside a driver that draws with the processor: both leave one to the other.
int spare_threads();
/// Tells such a driver, unless its user has said something else; to be called before the first window.
void limit_software_driver();

class Window {
 public:
  /// @throws pliant::Error (input) if there is no display
  static void require_display();
  /// Opens a window of at most this size.
  /// @throws pliant::Error (input) if there is no display, or none with OpenGL 3.3.
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return window_; }
  /// Whether the user has closed the window: by its button, or by Ctrl + Q, whatever else has the keyboard.
  bool wants_to_close() const;
  /// Takes the window off the screen, which may have to wait for a step before its program ends.
  void hide();
  void set_title(const std::string& title);

  Vec2f size() const;                           ///< in window units, as the mouse is measured
  std::array<int, 2> framebuffer_size() const;  ///< in pixels; 0 while it is minimized
  float content_scale() const;                  ///< of fonts, from the settings of the desktop
  bool is_visible() const;

  /// The name of the OpenGL driver, and whether it draws with the processor.
  const std::string& driver() const { return driver_; }
  bool is_software() const;

  /// Waits until an event arrives, wake() is called or the time [s] is over.
  void wait(double seconds);
  /// Ends a wait; may be called from any thread.
  static void wake();
  /// Events since the last call; was_touched() reports any event at all, such as resizing.
  std::vector<MouseEvent> take_mouse_events();
  std::vector<KeyEvent> take_key_events();
  /// Where the mouse is, by the last event.
  Vec2f cursor() const;
  /// Files that were dropped onto the window since the last call.
  std::vector<std::string> take_dropped_files();
  bool was_touched();
  void swap();
  /// Queues key events, and leaves them to nobody else; to be called again by whoever has let others set callbacks.
  void install_key_callbacks();

 private:
  void install_callbacks();

  GLFWwindow* window_ = nullptr;
  GLFWwindow* former_context_ = nullptr;  // that was current, if the program has one
  std::string driver_;
  std::vector<MouseEvent> mouse_;
  std::optional<Vec2f> cursor_;  // by the last event: it may be elsewhere by now
  std::vector<KeyEvent> keys_;
  std::vector<std::string> dropped_;
  bool touched_ = true;
};

}  // namespace pliant_viewer
