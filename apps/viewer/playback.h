#pragma once
// A recorded run, played at its own times.
#include <map>

#include "render/scalar_fields.h"
#include "viewer/view_source.h"

namespace pliant_viewer {

class Playback final : public ViewSource {
 public:
  Playback(pliant_render::RunFrames frames, pliant::ViewSettings appearance, bool is_playing);

  const std::string& name() const override { return frames_.name(); }
  const pliant::ViewSettings& appearance() const override { return appearance_; }
  bool refresh(Clock::time_point now) override;
  Seconds time_to_news(Clock::time_point now) const override;
  const pliant_render::ClipFrame& frame() const override { return frame_; }
  std::shared_ptr<const pliant_render::RenderMesh> render_mesh() const override { return render_mesh_; }
  std::uint64_t restarts() const override { return 0; }
  bool knows(pliant::ColorBy color) const override { return pliant_render::is_known_of_runs(color); }
  void show(pliant::ColorBy color) override;
  pliant::ColorBy color() const override { return color_; }
  std::optional<std::array<float, 2>> range() const override;
  std::optional<pliant_render::Bounds> known_bounds() const override { return bounds_; }
  bool is_playing() const override { return is_playing_; }
  void play(bool on) override;
  void step(int direction) override;
  void restart(bool keep_values) override;
  double speed() const override { return speed_; }
  void hold_at(std::optional<double> time) override;
  std::uint64_t cuts() const override { return cuts_; }
  const pliant_plot::MeasuredRun* measured() const override { return measured_ ? &*measured_ : nullptr; }
  void draw_panel(const std::string& selected_collider) override;

  /// What the run has measured, for plots.
  void set_measured(pliant_plot::MeasuredRun measured) { measured_ = std::move(measured); }

  std::size_t count() const { return frames_.count(); }
  std::size_t place() const { return place_; }
  pliant::Real time(std::size_t i) const { return frames_.time(i); }
  void go_to(std::size_t frame);
  void set_speed(double speed);
  void set_looping(bool on) { is_looping_ = on; }

 private:
  /// The current time of the run [s].
  double run_time(Clock::time_point now) const;

  std::optional<pliant_plot::MeasuredRun> measured_;
  pliant_render::RunFrames frames_;
  pliant::ViewSettings appearance_;
  std::shared_ptr<const pliant_render::RenderMesh> render_mesh_;
  pliant_render::Bounds bounds_;
  pliant_render::ClipFrame frame_;
  std::map<pliant::ColorBy, std::array<float, 2>> ranges_;
  pliant::ColorBy color_;
  bool is_playing_;
  bool is_looping_ = true;
  double speed_ = 1;
  std::optional<double> hold_;  // time of the frame that is the last one for now [s]
  std::uint64_t cuts_ = 0;
  std::size_t place_ = 0;
  bool is_stale_ = true;
  bool has_begun_ = false;
  Clock::time_point began_;  // when the frame at began_at_ was shown
  double began_at_;          // [s]
};

}  // namespace pliant_viewer
