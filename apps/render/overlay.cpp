#include "render/overlay.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace pliant_render {
namespace {

constexpr float font_pixels = 64;  // of the atlas; drawn at the size that a picture wants

/// Makes a context the current one for a while; a window may have one of its own.
class Current {
 public:
  explicit Current(ImGuiContext* context) : before_(ImGui::GetCurrentContext()) { ImGui::SetCurrentContext(context); }
  ~Current() { ImGui::SetCurrentContext(before_); }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

 private:
  ImGuiContext* before_;
};

/// Without making it the current one.
ImGuiContext* make_context() {
  const Current unchanged(ImGui::GetCurrentContext());
  return ImGui::CreateContext();
}

}  // namespace

Overlay::Overlay() : context_(make_context()) {
  const Current current(context_);
  ImGui::GetIO().IniFilename = nullptr;
  font_ = load_font(font_pixels);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Overlay::~Overlay() {
  {
    const Current current(context_);
    ImGui_ImplOpenGL3_Shutdown();
  }
  ImGui::DestroyContext(context_);
}

void Overlay::draw(const pliant::ViewSettings& appearance, const Viewpoint& viewpoint,
                   const std::optional<Legend>& legend, const std::optional<WindAnnotation>& wind, int width,
                   int height, const std::function<void(const AnnotationCanvas&)>& draw_more) {
  if (!legend && !wind && draw_more == nullptr) return;
  const Current current(context_);
  ImGui::GetIO().DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  const AnnotationCanvas canvas{*ImGui::GetBackgroundDrawList(), *font_, ink_on(appearance.background),
                                static_cast<float>(width), static_cast<float>(height)};
  if (draw_more != nullptr) draw_more(canvas);
  if (legend) draw_legend(*legend, canvas);
  if (wind) draw_wind(*wind, viewpoint, canvas);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace pliant_render
