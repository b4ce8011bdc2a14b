// The controls of a run that is played: where it stands, and how fast it goes.
#include <fmt/format.h>
#include <imgui.h>

#include "viewer/panels/number_slider.h"
#include "viewer/panels/panel_style.h"
#include "viewer/playback.h"

namespace pliant_viewer {

void Playback::draw_panel(const std::string&) {
  row_label("time", "");
  wrapped_text(fmt::format("{:.2f} of {:.2f} s", time(place_), time(count() - 1)));
  row_label("frame", "");
  ImGui::TextUnformatted(fmt::format("{} of {}", place_ + 1, count()).c_str());
  row_label("speed", "seconds of the run in a second");
  double speed = speed_;
  constexpr double slowest = 0.01, fastest = 10;
  if (number_slider("##speed", speed,
                    {.low = slowest, .high = fastest, .unit = "×", .is_logarithmic = true, .least = slowest}) &&
      speed > 0) {
    set_speed(speed);
  }
  row_label("at the end", "");
  ImGui::Checkbox("begin again", &is_looping_);
}

}  // namespace pliant_viewer
