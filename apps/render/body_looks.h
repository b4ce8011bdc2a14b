#pragma once
// How what the appearance of a body says lies on it.
#include <array>
#include <string>

#include "pliant/core/types.h"
#include "pliant_io/scene/body_appearance.h"

namespace pliant_render {

/// Where patterns laid by places at rest begin, in fields before the origin: what is flat does not lie between two
/// layers of fields.
inline constexpr pliant::Real off_the_edge = 0.37;

/// The axes of the body at rest, from the one along which it is longest; those along which it is flat come last.
std::array<Eigen::Index, 3> axes_by_length(const pliant::Positions& rest);

/// What the appearance says, never `automatic`. material: the name of the body's, empty where it has none.
pliant::Finish finish_of(const pliant::BodyAppearance& appearance, const std::string& material, bool is_sheet);

}  // namespace pliant_render
