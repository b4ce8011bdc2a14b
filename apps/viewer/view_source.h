#pragma once
// What a window shows: a simulated scene or a recorded run.
#include <memory>

#include "render/clip.h"
#include "viewer/history.h"
#include "viewer/pacer.h"

namespace pliant_viewer {

class LiveScene;

class ViewSource {
 public:
  virtual ~ViewSource() = default;

  virtual const std::string& name() const = 0;
  virtual const pliant::ViewSettings& appearance() const = 0;

  /// Takes over the newest frame; returns whether it differs from the one before.
  virtual bool refresh(Clock::time_point now) = 0;
  /// Time until refresh() will return true, where that is known; Seconds::max() otherwise.
  virtual Seconds time_to_news(Clock::time_point now) const = 0;
  virtual const pliant_render::ClipFrame& frame() const = 0;
  /// A new pointer whenever the mesh has changed.
  virtual std::shared_ptr<const pliant_render::RenderMesh> render_mesh() const = 0;
  /// Number of restarts so far.
  virtual std::uint64_t restarts() const = 0;

  virtual bool knows(pliant::ColorBy color) const = 0;
  virtual void show(pliant::ColorBy color) = 0;
  /// What the values of the current frame mean; follows show() a little later.
  virtual pliant::ColorBy color() const = 0;
  /// The ends of the color map, if they are known for all frames.
  virtual std::optional<std::array<float, 2>> range() const { return {}; }

  /// The box around all frames, if they are known.
  virtual std::optional<pliant_render::Bounds> known_bounds() const { return {}; }

  virtual bool is_playing() const = 0;
  virtual void play(bool on) = 0;
  /// One step or frame forward, or backward where that is possible.
  virtual void step(int direction) = 0;
  /// Whether a step that was asked for has not been taken yet.
  virtual bool is_stepping() const { return false; }
  /// Starts over; `keep_values`: with the values set on the panel.
  virtual void restart(bool keep_values) = 0;

  /// Simulated seconds that are to go by in a second; 1 where that is left to the machine.
  virtual double speed() const { return 1; }
  /// Shows nothing later than the first moment at or behind this time [s] until the next call; none: time goes on.
  virtual void hold_at(std::optional<double> time) = 0;
  /// How often time has not gone on evenly so far: restarts, jumps.
  virtual std::uint64_t cuts() const { return restarts(); }

  /// What was measured so far, for plots over time; null where nothing is known.
  virtual const pliant_plot::MeasuredRun* measured() const { return nullptr; }
  /// Changes with what was measured.
  virtual std::uint64_t measured_version() const { return 0; }
  /// Asks for what is to be measured after every step from now on.
  virtual void measure(const Measuring&) {}

  /// Draws this source's part of the panel, with more about the collider of that name.
  virtual void draw_panel(const std::string& selected_collider) = 0;
  /// The collider whose name was clicked in it since the last call; "": none.
  virtual std::string take_clicked_collider() { return {}; }
  /// Whether that is open where forces are.
  virtual bool shows_forces() const { return false; }
  /// The scene that can be pulled and pinned; null for a recorded run.
  virtual LiveScene* live() { return nullptr; }
};

}  // namespace pliant_viewer
