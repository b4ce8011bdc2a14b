#pragma once
// Attachment: vertices of one body tied to points of another one, or of the same: seams, patches, lines, hinges.
//
//       x ●~~~~~~○ y = Σ bⱼ xⱼ      z = x − y      p = z · min(1, L/‖z‖)      E = w/2 ‖z − p‖²
//              / | \                                                            = w/2 (‖z‖ − L)² beyond L
//             ●--|--●               w = k, of a seam k times the length that the tie stands for
//
// Ties are threads that bear no pressure: L = 0 joins the points. The rows sum to zero and p is along z, so ties keep
// momentum and angular momentum, whatever they are tied to. Drawn together, L goes from the distance at the start to
// its end over a time, the same for all ties, at constant speed; where it is follows from the time alone.
//
// Which points belong together follows from the rest positions; how far they are apart, from where they are when the
// attachment is made. A tie that is then as short as rounding has that as its L, so that it has no force.
//
// Source: rows as in Bouaziz et al. 2014, Sec. 5 (closeness, between two points that move).
#include <algorithm>
#include <cmath>

#include "pliant/constraints/batch.h"
#include "pliant/constraints/constraint_set.h"
#include "pliant/mesh/seam.h"

namespace pliant {

enum class BodyId : Index;

/// Which points a vertex is tied to.
enum class AttachmentMode {
  nearest_vertex,  ///< the nearest vertex
  nearest_face,    ///< the nearest point of a triangle
  seam,            ///< vertex by vertex along two chains
  seam_by_length,  ///< as far along, of chains of any number of vertices
};
constexpr std::array<std::string_view, 4> choice_names(AttachmentMode) {
  return {"nearest_vertex", "nearest_face", "seam", "seam_by_length"};
}
constexpr bool is_seam(AttachmentMode mode) {
  return mode == AttachmentMode::seam || mode == AttachmentMode::seam_by_length;
}

struct Attachment {
  static constexpr ConstraintInfo info{"attachment", "x − Σ bⱼ xⱼ", "the vectors of length 0 to L",
                                       "½ w (‖z‖ − L)² beyond L, w = k or k·l", "Bouaziz et al. 2014, Sec. 5"};
  /// k where none is given [N/m], and of a seam [N/m²].
  static constexpr Real usual_stiffness = 1e3;
  static constexpr Real usual_seam_stiffness = 1e5;

  /// Vertices that are tied.
  Selection on{};
  /// The body that they are tied to, which may be the same, and what of it: the vertices, and the triangles whose
  /// corners are all among them.
  BodyId to{};
  Selection to_on{};
  AttachmentMode mode = AttachmentMode::nearest_vertex;
  /// Of seams.
  SeamDirection direction = SeamDirection::nearest;
  /// k [N/m] of each tie, of a seam [N/m²]: for each meter, however many vertices it has. Default: 1e3, of a seam 1e5.
  Values stiffness{};
  /// L [m], ≥ 0.
  Real length = 0;
  /// L of each tie is how far apart its points are when the attachment is made, in place of `length`.
  bool keep_distance = false;
  /// In which L goes from that distance to its end [s], ≥ 0; 0: at once.
  Real closing_time = 0;

  /// All but the bodies and what of them is tied, which scene files give by name.
  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"mode", "", "what a vertex is tied to: see the page of attachments"}, self.mode);
    field(OptionInfo{"direction", "", "of a seam: `nearest` brings its points nearer, `opposite` is the other way"},
          self.direction);
    field(OptionInfo{"stiffness", "N/m or N/m²", "of each tie; of seams for each meter. Default: 1e3, of seams 1e5",
                     positive},
          self.stiffness);
    field(OptionInfo{"length", "m", "up to which a tie is slack; 0: the points are joined", not_negative}, self.length);
    field(OptionInfo{"keep_distance", "", "ties are as long as their points are apart at the start"},
          self.keep_distance);
    field(OptionInfo{"closing_time", "s", "in which ties shorten from the distance at the start; 0: at once",
                     not_negative},
          self.closing_time);
  }
};

struct AttachmentProjection {
  static constexpr std::string_view name = "attachment";
  static constexpr int vertices = dynamic_vertices;
  static constexpr int rows = 1;
  static constexpr int fields = 5;  // L now, at the end and at the start [m]; start and duration of the closing [s]
  static constexpr bool translation_invariant = true;
  static constexpr bool rotation_invariant = true;
  static void project(const Real* field, const Real* z, Real* p) {
    const Real length = std::sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
    const Real scale = length > field[0] ? field[0] / length : 1;
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = scale * z[axis];
  }
  static Real end_length(const Real* field) { return field[1]; }
  static Real length_at(Real time, const Real* field) {
    const Real elapsed = time - field[3];
    const bool is_closed = elapsed >= field[4] * (1 - 1e-9);
    return is_closed ? field[1] : field[2] + (field[1] - field[2]) * (std::max<Real>(elapsed, 0) / field[4]);
  }
  /// L as it is at the end of a step, from one time to another [s]; whether it has been another one at the beginning.
  static bool go_to(Real from, Real to, Real* field) {
    field[0] = length_at(to, field);
    return field[0] != length_at(from, field);
  }
};

/// Throws Error(input), naming the bodies and the remedy, on seams whose sides are no chains, or of unequal numbers of
/// vertices; on triangles asked for where there are none; on a vertex tied to itself or to a face of its own; on an
/// index out of range, a list of the wrong length.
ConstraintSet build(const BodyView& from, const BodyView& to, const Attachment& options);

}  // namespace pliant
