#include "viewer/window.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <thread>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "pliant/core/error.h"

namespace pliant_viewer {
namespace {

bool is_glfw_ours = false;  // to be ended: no program around this one had begun with it

constexpr const char* way_out = "`pliant render` makes pictures and films without a window";

void end_glfw() {
  if (std::exchange(is_glfw_ours, false)) glfwTerminate();
}

std::string last_error() {
  const char* text = nullptr;
  return glfwGetError(&text) == GLFW_NO_ERROR || text == nullptr ? std::string("no reason is known")
                                                                 : std::string(text);
}

bool has_display() {
  const auto is_set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

Window& window_of(GLFWwindow* handle) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
}

bool is_shift_down(GLFWwindow* handle) {
  return glfwGetKey(handle, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ||
         glfwGetKey(handle, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
}

bool is_control_down(GLFWwindow* handle) {
  return glfwGetKey(handle, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
         glfwGetKey(handle, GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
}

}  // namespace

int spare_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

void limit_software_driver() {
  setenv("LP_NUM_THREADS", std::to_string(spare_threads()).c_str(), 0);
}

void Window::require_display() {
  glfwGetError(nullptr);
  const bool is_ready = glfwGetTimerFrequency() > 0;
  if (glfwInit() == GLFW_TRUE) {
    is_glfw_ours = is_glfw_ours || !is_ready;
    return;
  }
  const std::string reason = last_error();
  pliant::fail_input(has_display() ? "no window can be opened (" + reason + "); " + way_out
                                   : std::string("there is no display for a window; ") + way_out);
}

Window::Window(const std::string& title, int width, int height) {
  require_display();
  int area_x = 0, area_y = 0, area_width = 0, area_height = 0;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
    glfwGetMonitorWorkarea(monitor, &area_x, &area_y, &area_width, &area_height);
    if (area_width > 0) width = std::min(width, area_width);
    if (area_height > 0) height = std::min(height, area_height);
  }
  glfwDefaultWindowHints();  // whatever a program has set
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  glfwDefaultWindowHints();
  if (window_ == nullptr) {
    const std::string reason = last_error();
    end_glfw();
    pliant::fail_input("OpenGL: the display has no OpenGL 3.3 (" + reason +
                       "); install libgl1-mesa-dri, which draws with the processor, or: " + way_out);
  }
  former_context_ = glfwGetCurrentContext();
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowSizeLimits(window_, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
  driver_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  install_callbacks();
}

Window::~Window() {
  glfwDestroyWindow(window_);
  if (former_context_ != nullptr) glfwMakeContextCurrent(former_context_);
  end_glfw();
}

/// Where the mouse was when an event came that does not say so.
Vec2f Window::cursor() const {
  if (cursor_) return *cursor_;
  double x = 0, y = 0;
  glfwGetCursorPos(window_, &x, &y);
  return {static_cast<float>(x), static_cast<float>(y)};
}

void Window::install_callbacks() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetCursorPosCallback(window_, [](GLFWwindow* handle, double x, double y) {
    Window& window = window_of(handle);
    window.touched_ = true;
    window.cursor_ = Vec2f(static_cast<float>(x), static_cast<float>(y));
    window.mouse_.push_back({MouseEvent::Kind::move, MouseButton::left, *window.cursor_, 0, is_shift_down(handle),
                             is_control_down(handle)});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* handle, int button, int action, int modifiers) {
    Window& window = window_of(handle);
    window.touched_ = true;
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    const auto which = button == GLFW_MOUSE_BUTTON_LEFT    ? MouseButton::left
                       : button == GLFW_MOUSE_BUTTON_RIGHT ? MouseButton::right
                                                           : MouseButton::middle;
    window.mouse_.push_back({action == GLFW_PRESS ? MouseEvent::Kind::press : MouseEvent::Kind::release, which,
                             window.cursor(), 0, (modifiers & GLFW_MOD_SHIFT) != 0,
                             (modifiers & GLFW_MOD_CONTROL) != 0});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* handle, double, double y) {
    Window& window = window_of(handle);
    window.touched_ = true;
    window.mouse_.push_back({MouseEvent::Kind::wheel, MouseButton::left, window.cursor(), static_cast<float>(y),
                             is_shift_down(handle), is_control_down(handle)});
  });
  install_key_callbacks();
  glfwSetDropCallback(window_, [](GLFWwindow* handle, int count, const char** files) {
    Window& window = window_of(handle);
    window.touched_ = true;
    window.dropped_.insert(window.dropped_.end(), files, files + count);
  });
  const auto touch = [](GLFWwindow* handle) { window_of(handle).touched_ = true; };
  glfwSetWindowRefreshCallback(window_, touch);
  glfwSetWindowCloseCallback(window_, touch);
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* handle, int, int) { window_of(handle).touched_ = true; });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* handle, int) { window_of(handle).touched_ = true; });
}

void Window::install_key_callbacks() {
  glfwSetKeyCallback(window_, [](GLFWwindow* handle, int key, int scancode, int action, int modifiers) {
    Window& window = window_of(handle);
    window.touched_ = true;
    if (key == GLFW_KEY_Q && action == GLFW_PRESS && (modifiers & GLFW_MOD_CONTROL) != 0) {
      glfwSetWindowShouldClose(handle, GLFW_TRUE);
    }
    const auto kind = action == GLFW_PRESS    ? KeyEvent::Kind::press
                      : action == GLFW_REPEAT ? KeyEvent::Kind::repeat
                                              : KeyEvent::Kind::release;
    window.keys_.push_back({kind, key, scancode, modifiers});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* handle, unsigned int character) {
    Window& window = window_of(handle);
    window.touched_ = true;
    window.keys_.push_back({.kind = KeyEvent::Kind::character, .character = character});
  });
}

bool Window::wants_to_close() const {
  return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::hide() {
  glfwHideWindow(window_);
  glfwPollEvents();
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

Vec2f Window::size() const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return {static_cast<float>(std::max(width, 1)), static_cast<float>(std::max(height, 1))};
}

std::array<int, 2> Window::framebuffer_size() const {
  std::array<int, 2> size{0, 0};
  glfwGetFramebufferSize(window_, size.data(), &size[1]);
  return size;
}

float Window::content_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  const float scale = std::max(x, y);
  return scale > 0.5F && scale < 8 ? scale : 1;
}

bool Window::is_visible() const {
  const auto [width, height] = framebuffer_size();
  return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_FALSE && width > 0 && height > 0;
}

bool Window::is_software() const {
  constexpr std::array software = {"llvmpipe", "softpipe", "SwiftShader", "SWR"};
  return std::ranges::any_of(software, [this](const char* name) { return driver_.find(name) != std::string::npos; });
}

void Window::wait(double seconds) {
  if (seconds > 0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
}

void Window::wake() {
  glfwPostEmptyEvent();
}

std::vector<MouseEvent> Window::take_mouse_events() {
  return std::exchange(mouse_, {});
}

std::vector<KeyEvent> Window::take_key_events() {
  return std::exchange(keys_, {});
}

std::vector<std::string> Window::take_dropped_files() {
  return std::exchange(dropped_, {});
}

bool Window::was_touched() {
  return std::exchange(touched_, false);
}

void Window::swap() {
  glfwSwapBuffers(window_);
}

}  // namespace pliant_viewer
