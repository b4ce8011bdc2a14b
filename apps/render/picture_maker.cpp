#include "render/picture_maker.h"

namespace pliant_render {

PictureMaker::PictureMaker(RenderMesh render_mesh, PictureOptions options)
    : options_(std::move(options)),
      target_(options_.appearance.size[0], options_.appearance.size[1], options_.samples),
      legend_(make_legend(options_.appearance, options_.range, target_.width(), target_.height())),
      camera_(options_.appearance.camera, options_.bounds,
              static_cast<float>(target_.width()) / static_cast<float>(target_.height()),
              legend_ ? legend_width(target_.height()) / static_cast<float>(target_.width()) : 0),
      renderer_(std::move(render_mesh)) {
  renderer_.set_subdivision(options_.appearance.subdivision);
}

Image PictureMaker::draw(const FrameContent& frame, const std::optional<WindAnnotation>& wind, pliant::Real time) {
  PassClock* const clock = options_.clock;
  if (clock != nullptr) clock->begin();
  DrawOptions options;
  options.clock = clock;
  options.viewpoint = camera_.at(time);
  options.range = options_.range;
  options.quality = options_.appearance.quality;
  options.ground_height = options_.ground_height;
  const int width = target_.factor() * target_.width(), height = target_.factor() * target_.height();
  options.scale = static_cast<float>(height) / 720;
  options.pixel = static_cast<float>(target_.factor());
  options.markers = options_.appearance.markers.value_or(false);
  if (options_.appearance.colliders || frame.colliders.empty()) {
    renderer_.set_frame(frame, options_.appearance.color);
  } else {
    renderer_.set_frame(visible_part(frame, options_.appearance), options_.appearance.color);
  }
  if (clock != nullptr) clock->end("vertices");
  target_.begin();
  renderer_.draw(options_.appearance, options, width, height);
  target_.resolve();
  if (clock != nullptr) clock->end("samples to pixels");
  const std::optional<WindAnnotation> shown_wind = options_.appearance.wind_arrow ? wind : std::nullopt;
  overlay_.draw(options_.appearance, options.viewpoint, legend_, shown_wind, target_.width(), target_.height());
  Image image = target_.read();
  if (clock != nullptr) clock->end("text, and reading");
  return image;
}

}  // namespace pliant_render
