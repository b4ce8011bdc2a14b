#include "viewer/viewer.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include <fmt/format.h>
#include <imgui.h>

#include "pliant/core/error.h"
#include "pliant/core/stopwatch.h"
#include "render/camera_path.h"
#include "render/choose_direction.h"
#include "viewer/gizmos.h"
#include "viewer/live_scene.h"

namespace pliant_viewer {
namespace {

using pliant_render::Bounds;
using pliant_render::Viewpoint;

constexpr double most_frames_a_second = 60;
constexpr double idle_turn = 0.25;  // [s]

/// Around all frames where they are known, else around the first and room for motion, whose direction is not known yet.
Bounds first_bounds(const ViewSource& source, const pliant::ViewSettings& appearance) {
  if (const auto known = source.known_bounds()) return *known;
  Bounds bounds = bounds_of(source.frame().content, appearance);
  if (bounds.is_empty()) bounds.add(Vec3f::Zero());
  const Vec3f room = Vec3f::Constant(0.12F * bounds.radius());
  bounds.add(bounds.low - room);
  bounds.add(bounds.high + room);
  return bounds;
}

/// As the scene has it at the start; from there on the mouse moves it.
Viewpoint first_viewpoint(const ViewSource& source, const pliant::ViewSettings& appearance, const Vec2f& size) {
  const Bounds bounds = first_bounds(source, appearance);
  const float aspect = size.x() / size.y();
  const pliant_render::FrameContent frame = visible_part(source.frame().content, appearance);
  const pliant::Camera camera =
      choose_direction(appearance.camera, *source.render_mesh(), std::span(&frame, 1), bounds, aspect);
  return pliant_render::CameraPath(camera, bounds, aspect).at(source.frame().time);
}

/// A magnitude that few values exceed, so that single vertices beside pins do not take the whole range of colors.
float large_value(std::vector<float> values) {
  constexpr std::size_t one_of = 50;
  if (values.empty()) return 0;
  for (float& value : values) value = std::isfinite(value) ? std::abs(value) : 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(values.size() - 1 - values.size() / one_of);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

Viewer::Viewer(Window& window, ViewSource& source, ViewerOptions options)
    : window_(window),
      source_(source),
      appearance_(options.appearance),
      samples_(options.samples.value_or(window.is_software() ? 1 : 4)),
      picture_folder_(std::move(options.picture_folder)),
      saved_scene_(std::make_shared<std::filesystem::path>()),
      settings_file_(std::move(options.settings_file)),
      settings_(read_window_settings(settings_file_)),
      ui_(window, appearance_.background, settings_),
      camera_(first_viewpoint(source, appearance_, picture_size()), appearance_.camera.up.cast<float>()),
      first_camera_(camera_),
      interaction_(source.live() != nullptr ? source.live()->suggested_pull() : 1),
      frame_interval_(1 / most_frames_a_second),
      sees_nothing_(source.render_mesh()->vertex_count == 0),
      open_(std::move(options.open)),
      saved_(std::move(options.saved)),
      looked_(std::move(options.looked)),
      scene_panel_(std::move(options.scenes), options.chooses_scene) {
  if (!source.knows(appearance_.color)) appearance_.color = pliant::ColorBy::none;
  if (appearance_.color != source.appearance().color) source_.show(appearance_.color);
  if (!window.is_software()) film_panel_.choices.quality = FilmQuality::fine;
  if (!options.greeting.empty()) say(std::move(options.greeting));
  update_bounds();
  place_screen();
}

void Viewer::run(const std::function<bool()>& shall_end) {
  while (!window_.wants_to_close() && !shall_end() && !is_over_) turn(idle_turn);
  if (!is_over_) window_.hide();
  tell_look();
}

bool Viewer::turn(double most_wait) {
  const Clock::time_point now = Clock::now();
  const double news = source_.time_to_news(now).count();
  const double pause = frame_interval_ - Seconds(now - last_draw_).count();
  if (draws_left_ > 0 || news <= 0) {
    // Frames come evenly, and the processor is left to the simulation in between.
    if (pause > 0) std::this_thread::sleep_for(Seconds(std::min(pause, most_wait)));
    window_.wait(0);
  } else {
    window_.wait(std::clamp(news, 0.0, most_wait));
  }
  if (window_.was_touched()) draws_left_ = 3;
  take_input();
  take_dropped_files();
  open_what_waits();
  const Seconds reading_time(std::max(4.0, static_cast<double>(message_.size()) / 15));
  if (!message_.empty() && Clock::now() - last_message_ > reading_time) {
    message_.clear();
    draws_left_ = 1;
  }
  // A message about a slow step counts its seconds.
  const LiveScene* live = source_.live();
  if (live != nullptr && live->step_age() > Seconds(1) && Clock::now() - last_draw_ > Seconds(0.5)) draws_left_ = 1;
  if (source_.refresh(Clock::now())) is_frame_new_ = true;
  handles_.flush(mouse_view());  // which may have waited for that
  if (live != nullptr && std::exchange(rebuilds_, live->shown().rebuilds) != live->shown().rebuilds) {
    if (interaction_.collider_goal()) interaction_.cancel();  // colliders may have other numbers now
  }
  if (live != nullptr && live->shown().messages != messages_) {
    messages_ = live->shown().messages;
    say(live->shown().message);
  }
  if (source_.restarts() != restarts_) {
    restarts_ = source_.restarts();
    interaction_.cancel();
    handles_.cancel();
    brush_.cancel();
    select_.restart(source_.frame().content.positions.size());
    has_ground_ = false;
  }
  brush_.flush(mouse_view());
  if (!is_frame_new_ && draws_left_ == 0 && !wants_picture_) return false;
  if (draws_left_ == 0 && !wants_picture_ && waits_for_film()) return false;
  draws_left_ = std::max(draws_left_ - 1, 0);
  if (!window_.is_visible()) {
    std::this_thread::sleep_for(Seconds(frame_interval_));  // a hidden window is not drawn
    return false;
  }
  draw();
  return true;
}

void Viewer::say(std::string message) {
  message_ = std::move(message);
  last_message_ = Clock::now();
  draws_left_ = 2;
}

void Viewer::update_render_mesh() {
  if (source_.render_mesh() == render_mesh_) return;
  const auto before = std::exchange(render_mesh_, source_.render_mesh());
  const bool is_same = before != nullptr && have_same_shape(*before, *render_mesh_);
  if (is_same) {
    renderer_->set_looks(render_mesh_->looks);
  } else {
    renderer_.emplace(*render_mesh_);
  }
  if (!renderer_->texture_error().empty()) say(renderer_->texture_error());
  if (is_same) return;
  if (sees_nothing_ && render_mesh_->vertex_count > 0) {
    sees_nothing_ = false;
    camera_ = OrbitCamera(first_viewpoint(source_, appearance_, picture_size()), appearance_.camera.up.cast<float>());
    first_camera_ = camera_;
    has_ground_ = false;
  }
  select_.restart(static_cast<std::size_t>(render_mesh_->vertex_count));
  quality_.forget();
  is_frame_new_ = true;
}

void Viewer::update_bounds() {
  bounds_ = bounds_of(source_.frame().content, appearance_);
  if (appearance_.ground_height) {
    ground_height_ = static_cast<float>(*appearance_.ground_height);
    return;
  }
  if (const auto known = source_.known_bounds()) {
    ground_height_ = known->low.z() - 0.03F * known->radius();
    return;
  }
  // A little below everything, and lower as something falls.
  if (bounds_.is_empty()) return;
  const float below = bounds_.low.z() - 0.03F * bounds_.radius();
  ground_height_ = has_ground_ ? std::min(ground_height_, below) : bounds_.low.z() - 0.10F * bounds_.radius();
  has_ground_ = true;
}

float Viewer::panel_width() const {
  constexpr float width = 316, least_window = 640;  // a smaller window shows the picture alone
  const float unit = ui_.style().unit;
  return is_panel_open_ && window_.size().x() >= least_window * unit ? width * unit : 0;
}

Vec2f Viewer::picture_size() const {
  const Vec2f size = window_.size();
  return {size.x() - panel_width(), size.y()};
}

void Viewer::place_screen() {
  if (!appearance_.camera.keyframes.empty() && camera_.is_like(first_camera_)) {  // until someone moves it
    camera_ = OrbitCamera(first_viewpoint(source_, appearance_, picture_size()), appearance_.camera.up.cast<float>());
    first_camera_ = camera_;
  }
  screen_.size = picture_size();
  const bool has_legend = pliant_render::make_legend(appearance_, range_, static_cast<int>(screen_.size.x()),
                                                     static_cast<int>(screen_.size.y()))
                              .has_value();
  const float right = has_legend ? pliant_render::legend_width(static_cast<int>(screen_.size.y())) : 0;
  screen_.viewpoint = camera_.viewpoint(bounds_, right / screen_.size.x());
}

std::array<float, 2> Viewer::color_range() {
  if (appearance_.color_range) {
    return {static_cast<float>((*appearance_.color_range)[0]), static_cast<float>((*appearance_.color_range)[1])};
  }
  if (const auto known = source_.range()) return *known;
  return auto_range_.update(source_.color(), large_value(source_.frame().content.values), Clock::now());
}

void Viewer::draw() {
  last_draw_ = Clock::now();
  update_render_mesh();
  const bool is_finer = renderer_->set_subdivision(appearance_.subdivision);
  if (is_frame_new_ || is_finer || shown_colliders_ != appearance_.colliders) {
    update_bounds();
    range_ = color_range();
    if (appearance_.colliders) {
      renderer_->set_frame(source_.frame().content, source_.color());
    } else {
      renderer_->set_frame(visible_part(source_.frame().content, appearance_), source_.color());
    }
    is_frame_new_ = false;
    shown_colliders_ = appearance_.colliders;
  }
  place_screen();
  update_selection();
  const auto [full_width, height] = window_.framebuffer_size();
  const int width =
      static_cast<int>(std::lround(static_cast<float>(full_width) * screen_.size.x() / window_.size().x()));
  if (width <= 0 || height <= 0) return;
  if (wants_picture_) write_picture(width, height);
  film();
  ui_.set_up(settings_);
  ui_.begin();
  draw_annotations();
  const pliant_render::AnnotationCanvas canvas = ui_.canvas(screen_.size);
  canvas.list.PushClipRect({0, 0}, {canvas.width, canvas.height});
  draw_hand(canvas);
  canvas.list.PopClipRect();
  if (film_) draw_film_mark(*film_, canvas, ui_.style().unit);
  draw_panels();
  draw_measured_picture(width, height);
  fill_panel(width, full_width - width, height);
  ui_.end();
  window_.swap();
  frames_.add({Clock::now()});
  ++frame_count_;
}

pliant_render::DrawOptions Viewer::draw_options(int height) const {
  const LiveScene* live = source_.live();
  return {.viewpoint = screen_.viewpoint,
          .range = range_,
          .ground_height = ground_height_,
          .scale = static_cast<float>(height) / 720,
          .markers = appearance_.markers.value_or(true),
          .selection = true,
          .lit_collider = lit_collider_,
          .selected_collider = live == nullptr ? std::nullopt : handles_.collider.number(live->shown()),
          .quality = quality_.choose(appearance_.quality)};
}

/// Where the processor draws, pictures are waited for, to see whether they take too long.
void Viewer::draw_measured_picture(int width, int height) {
  if (measured_size_ != std::array{width, height}) quality_.forget();
  measured_size_ = {width, height};
  const pliant_render::DrawOptions options = draw_options(height);
  const pliant::Stopwatch watch;
  draw_picture(options, width, height);
  if (!window_.is_software() || options.quality == pliant::Quality::low) return;
  glFinish();
  quality_.add(watch.seconds());
}

/// Draws into the window's framebuffer, through a multisampled one where several samples per pixel are wanted.
void Viewer::draw_picture(const pliant_render::DrawOptions& options, int width, int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  if (samples_ <= 1) {
    target_.reset();
    renderer_->draw(appearance_, options, width, height);
    return;
  }
  if (!target_ || target_->width() != width || target_->height() != height || target_samples_ != samples_) {
    target_.reset();
    try {
      target_.emplace(width, height, samples_);
      target_samples_ = samples_;
    } catch (const pliant::Error& error) {
      say(error.what());
      samples_ = 1;
      glBindFramebuffer(GL_FRAMEBUFFER, 0);
      renderer_->draw(appearance_, options, width, height);
      return;
    }
  }
  target_->begin();
  renderer_->draw(appearance_, options, width, height);
  target_->resolve();
  target_->show();
}

/// Fills the area of the panel; faster than ImGui, which samples a texture for every pixel.
void Viewer::fill_panel(int left, int width, int height) const {
  if (width <= 0) return;
  const Vec3f color = ui_.panel_color();
  glEnable(GL_SCISSOR_TEST);
  glScissor(left, 0, width, height);
  glClearColor(color.x(), color.y(), color.z(), 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
  glViewport(0, 0, left + width, height);
}

void Viewer::draw_annotations() {
  const pliant_render::AnnotationCanvas canvas = ui_.canvas(screen_.size);
  const auto legend =
      pliant_render::make_legend(appearance_, range_, static_cast<int>(canvas.width), static_cast<int>(canvas.height));
  canvas.list.PushClipRect({0, 0}, {canvas.width, canvas.height});
  if (interaction_.pull()) {
    const std::vector<Vec3f>& positions = source_.frame().content.positions;
    draw_spring(screen_, interaction_.pull()->point.position(positions), interaction_.pull()->target, ui_.style().unit,
                canvas.list);
  }
  canvas.list.PopClipRect();
  if (legend) draw_legend(*legend, canvas);
  if (source_.frame().wind && appearance_.wind_arrow) draw_wind(*source_.frame().wind, screen_.viewpoint, canvas);
}

/// Draws the picture and its annotations without panels, and saves it.
void Viewer::write_picture(int width, int height) {
  wants_picture_ = false;
  ui_.begin();
  draw_annotations();
  pliant_render::DrawOptions options = draw_options(height);
  options.selection = false;
  options.lit_collider.reset();
  options.selected_collider.reset();
  draw_picture(options, width, height);
  ui_.end();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glReadBuffer(GL_BACK);
  try {
    const pliant_render::Image image = pliant_render::read_picture(width, height);
    std::filesystem::path file;
    for (int number = 1; file.empty() || std::filesystem::exists(file); ++number) {
      file = picture_folder_ / fmt::format("pliant-{:04}.png", number);
    }
    write_png(file, image);
    say("saved " + file.lexically_normal().string());
  } catch (const std::exception& error) {
    say(error.what());
  }
}

}  // namespace pliant_viewer
