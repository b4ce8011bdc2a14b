#pragma once
// Vertices of a mesh by what scene files say of them.
#include <string_view>

#include "pliant/core/options.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

/// The vertices that a selection of a scene means, `{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}}` or `"boundary"`, in
/// JSON; docs/scenes/selections.md lists the forms. Maps must be the mesh's own. `name` is what messages call the text.
/// @pre check_mesh(mesh).
/// @throws Error (input) with the place in the text, also when no vertex is meant
Selection select(std::string_view json, const Mesh& mesh, std::string_view name);

}  // namespace pliant
