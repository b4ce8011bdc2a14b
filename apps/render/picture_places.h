#pragma once
// Patterns and textures as pictures with texture coordinates, for programs that know no pattern: they lie where the
// renderer draws them.
#include "pliant/mesh/mesh.h"
#include "pliant_io/scene/body_appearance.h"
#include "render/image.h"

namespace pliant_render {

/// Two fields each way, the lower left one in the color of the base; for repeating. pattern: not none
Image pattern_image(pliant::Pattern pattern, const pliant::Color& base, const pliant::Color& second);

/// Whether pattern or texture go by the texture coordinates of the mesh.
bool lies_by_coordinates(const pliant::BodyAppearance& appearance, const pliant::Mesh& mesh);

/// Gives the polygons of a mesh the texture coordinates by which the picture of its appearance repeats on it: of
/// pattern_image(), or of the texture with this width and height.
///
/// By places at rest a face takes the two axes, in the order of axes_by_length(), other than the one that its normal at
/// rest is most along, as if it were laid on a box. The fields of a checker along that third axis are those of the
/// middle of the face. Stripes need the first axis alone. rest: one place for each vertex
void lay_picture(pliant::Mesh& mesh, const pliant::Positions& rest, const pliant::BodyAppearance& appearance,
                 std::array<int, 2> size);

}  // namespace pliant_render
