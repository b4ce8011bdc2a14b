#pragma once
// What the scenes are made of.
#include "tests/pairs/pair_scene.h"

namespace pliant_tests {

/// Vertices a side of so many in all: the root of count / share, at least 4.
pliant::Index side_of(pliant::Index count, pliant::Real share = 1);

/// n × rows vertices, `width` [m] along the first axis, edges of one length; rows = 0: n.
pliant::Mesh sheet_mesh(pliant::Index n, pliant::Real width, const pliant::Vec3& corner,
                        pliant::Plane plane = pliant::Plane::xy, pliant::Index rows = 0);

/// The vertices at the border of a sheet of n × n.
std::vector<pliant::Index> border_of(pliant::Index n);

/// A cube of tetrahedra about the origin.
pliant::Mesh cube_mesh(pliant::Index cells, pliant::Real size);
/// The same, almost a ball: a ball proper would leave the tetrahedra at the cube's edges flat.
pliant::Mesh ball_mesh(pliant::Index cells, pliant::Real size);

/// The contact distance that a mesh has by itself [m].
pliant::Real usual_distance(const pliant::Mesh& mesh);

/// Moves the mesh up or down so that its lowest vertex is at z [m].
void put_lowest_at(pliant::Mesh& mesh, pliant::Real z);

/// Bodies with their constraints. The velocity [m/s] is that of all vertices.
pliant::BodyId add_cloth(pliant::Simulation& simulation, const pliant::Mesh& mesh,
                         const pliant::Vec3& velocity = pliant::Vec3::Zero());
pliant::BodyId add_rubber(pliant::Simulation& simulation, const pliant::Mesh& mesh, pliant::Real stiffness,
                          const pliant::Vec3& velocity = pliant::Vec3::Zero());
pliant::BodyId add_rope(pliant::Simulation& simulation, const pliant::Mesh& mesh,
                        const pliant::Vec3& velocity = pliant::Vec3::Zero());

/// Down with the speed that was asked for.
pliant::Vec3 falling(const PairOptions& options);

/// An empty simulation with the settings and, unless `gravity` is zero, gravity [m/s²].
pliant::Simulation empty_simulation(const PairOptions& options,
                                    const pliant::Vec3& gravity = pliant::Vec3(0, 0, -9.81));

/// A vertex in the middle of a body goes round a circle of 0.6 m across, once a second, pulled with a stiffness [N/m].
void add_drag(PairScene& scene, std::size_t body, pliant::Real stiffness);

/// Contact and the drag as they were asked for. Call it when all bodies are there and `move` is set.
void finish(PairScene& scene, const PairOptions& options);

}  // namespace pliant_tests
