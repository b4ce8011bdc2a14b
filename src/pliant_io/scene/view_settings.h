#pragma once
// How a scene is shown, in a window or a film.
#include <array>
#include <optional>

#include "pliant_io/scene/body_appearance.h"
#include "pliant_io/scene/camera.h"

namespace pliant {

/// What the color of a surface tells.
enum class ColorBy { none, stretch, energy, speed, gap, contact_force };
constexpr std::array<std::string_view, 6> choice_names(ColorBy) {
  return {"none", "stretch", "energy", "speed", "gap", "contact_force"};
}

/// Surfaces with a normal that turns from face to face, or with one for each face.
enum class Shading { smooth, flat };
constexpr std::array<std::string_view, 2> choice_names(Shading) {
  return {"smooth", "flat"};
}

/// How much light is followed: `low` leaves out the shadows of bodies on bodies, and how much of the sky they see.
enum class Quality { automatic, low, high };
constexpr std::array<std::string_view, 3> choice_names(Quality) {
  return {"automatic", "low", "high"};
}

/// The tones of a surface's two sides.
struct BodyTones {
  Color front;  ///< of the side that normals point from
  Color back;   ///< of the other side
};

/// What bodies have in turn where a scene gives them no tones; a body that is the only free one has the first ones.
inline constexpr std::array<BodyTones, 7> body_tones = {{{{0.82, 0.33, 0.24}, {0.95, 0.77, 0.55}},
                                                         {{0.24, 0.44, 0.62}, {0.65, 0.78, 0.87}},
                                                         {{0.86, 0.66, 0.28}, {0.96, 0.88, 0.66}},
                                                         {{0.38, 0.57, 0.42}, {0.73, 0.84, 0.69}},
                                                         {{0.56, 0.36, 0.54}, {0.83, 0.73, 0.83}},
                                                         {{0.22, 0.56, 0.57}, {0.66, 0.84, 0.83}},
                                                         {{0.58, 0.43, 0.33}, {0.85, 0.75, 0.65}}}};

struct ViewSettings {
  Camera camera{};                                   ///< where the picture is taken from
  Color background{0.93, 0.94, 0.95};                ///< behind everything
  ColorBy color = ColorBy::none;                     ///< none: two tones, front and back
  std::optional<std::array<Real, 2>> color_range{};  ///< low, high, in the unit of `color`; none: those of all frames
  bool legend = true;                                ///< show the color map and its range
  bool wind_arrow = true;                            ///< show the wind by an arrow and its speed
  /// Of the side that normals point from, and of the other, of all bodies without an appearance of their own; none of
  /// both: of several free bodies each has tones of its own, see body_tones
  std::optional<Color> front{}, back{};
  Shading shading = Shading::smooth;     ///< smooth, or each face by itself
  Index subdivision = 0;                 ///< times that triangles are cut into four to be drawn smoother, 0 to 3
  bool wireframe = false;                ///< draw the edges of the elements too
  bool colliders = true;                 ///< draw them; hidden ones act all the same
  std::optional<bool> markers{};         ///< on pinned vertices and test forces; none: in windows, not in films
  bool ground = true;                    ///< draw a plane below the bodies
  std::optional<Real> ground_height{};   ///< z of that plane [m]; none: a little below everything
  bool shadow = true;                    ///< on the ground, and of bodies on bodies
  Quality quality = Quality::automatic;  ///< automatic: high, and low in a window that would be slow
  Vec3 light{-0.5, -0.8, 1.6};           ///< direction that the light comes from, of any length but zero
  std::array<Index, 2> size{1280, 720};  ///< width and height of the picture [pixels], 16 to 8192

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"camera", "", "where the picture is taken from"}, self.camera);
    field(OptionInfo{"background", "", "behind everything"}, self.background);
    field(
        OptionInfo{"color", "",
                   "of the bodies by `stretch`, `energy`, `speed`, `gap` or `contact_force`, or in two tones: `none`"},
        self.color);
    field(OptionInfo{"color_range", "", "values at the two ends of the color map; default: those of all frames"},
          self.color_range);
    field(OptionInfo{"legend", "", "show the color map and its range"}, self.legend);
    field(OptionInfo{"wind_arrow", "", "show the wind by an arrow and its speed"}, self.wind_arrow);
    field(OptionInfo{"front", "",
                     "tone of the side that normals point from, of bodies without an `appearance`; default: of several "
                     "bodies one each"},
          self.front);
    field(OptionInfo{"back", "", "tone of the other side, likewise"}, self.back);
    field(OptionInfo{"shading", "", "`smooth`, or `flat`: each face by itself"}, self.shading);
    field(
        OptionInfo{"subdivision", "",
                   "times that each triangle is cut into four to be drawn smoother than it is simulated", Range{0, 3}},
        self.subdivision);
    field(OptionInfo{"wireframe", "", "draw the edges of the elements too"}, self.wireframe);
    field(OptionInfo{"colliders", "", "draw them; hidden ones act all the same"}, self.colliders);
    field(OptionInfo{"markers", "", "mark pinned vertices, and those under a test force; default: in a window only"},
          self.markers);
    field(OptionInfo{"ground", "", "draw a plane below the bodies"}, self.ground);
    field(OptionInfo{"ground_height", "m", "of that plane; default: a little below everything"}, self.ground_height);
    field(OptionInfo{"shadow", "", "on the ground, and of bodies on bodies"}, self.shadow);
    field(OptionInfo{"quality", "",
                     "`high`, or `low`: no shadows of bodies on bodies, no soft darkening where little of the sky is "
                     "seen; `automatic`: high, and low in a window that would be slow"},
          self.quality);
    field(OptionInfo{"light", "", "direction that the light comes from, of any length but zero"}, self.light);
    field(OptionInfo{"size", "pixels", "width and height of the picture", Range{16, 8192}}, self.size);
  }
};

}  // namespace pliant
