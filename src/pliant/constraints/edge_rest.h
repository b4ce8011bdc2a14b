#pragma once
// Rest data that both kinds of edge constraint need.
#include "pliant/constraints/constraint_set.h"

namespace pliant {

/// The edges of the body's elements.
Stencils mesh_edges(const BodyView& body);

/// The lengths given, or those of the rest positions [m], > 0. Throws Error(input) that names the edge otherwise.
std::vector<Real> rest_lengths(std::string_view type, const BodyView& body, const Stencils& edges, const Values& given);

}  // namespace pliant
